#include <plexway/io/edges.hpp>

#include "by_extension.hpp"

namespace plexway::io {
namespace {

using EdgeParser = Edges (*)(std::string_view, std::string_view);

constexpr std::array<std::string_view, 2> edge_suffixes = {".obj", ".edges"};
constexpr std::array<EdgeParser, 2> edge_parsers = {parse_obj_lines, parse_edge_list};

}  // namespace

std::span<const std::string_view> edge_extensions() { return edge_suffixes; }

Edges read_edges(const std::filesystem::path& file) {
  return read_by_extension<Edges>(file, edge_suffixes, edge_parsers);
}

}  // namespace plexway::io
