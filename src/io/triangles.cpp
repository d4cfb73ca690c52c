#include <plexway/io/triangles.hpp>

#include "by_extension.hpp"

namespace plexway::io {
namespace {

using Parser = Triangles (*)(std::string_view, std::string_view);

constexpr std::array<std::string_view, 4> extensions = {".obj", ".off", ".ply", ".stl"};
constexpr std::array<Parser, 4> parsers = {parse_obj, parse_off, parse_ply, parse_stl};

}  // namespace

std::span<const std::string_view> triangle_extensions() { return extensions; }

Triangles read_triangles(const std::filesystem::path& file) {
  return read_by_extension<Triangles>(file, extensions, parsers);
}

}  // namespace plexway::io
