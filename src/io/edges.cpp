#include <plexway/io/edges.hpp>

#include "by_extension.hpp"

namespace plexway::io {
namespace {

using Parser = Edges (*)(std::string_view, std::string_view);

constexpr std::array<std::string_view, 2> extensions = {".obj", ".edges"};
constexpr std::array<Parser, 2> parsers = {parse_obj_lines, parse_edge_list};

}  // namespace

std::span<const std::string_view> edge_extensions() { return extensions; }

Edges read_edges(const std::filesystem::path& file) {
  return read_by_extension<Edges>(file, extensions, parsers);
}

}  // namespace plexway::io
