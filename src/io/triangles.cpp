#include <plexway/io/triangles.hpp>

#include "by_extension.hpp"

namespace plexway::io {
namespace {

using TriangleParser = Triangles (*)(std::string_view, std::string_view);

constexpr std::array<std::string_view, 10> triangle_suffixes = {
    ".obj", ".off", ".ply", ".stl", ".gii",
    // FreeSurfer's files have no extension; these stand behind lh. and rh.
    ".white", ".pial", ".inflated", ".sphere", ".orig"};
constexpr std::array<TriangleParser, 10> triangle_parsers = {
    parse_obj,        parse_off,        parse_ply,        parse_stl,        parse_gifti,
    parse_freesurfer, parse_freesurfer, parse_freesurfer, parse_freesurfer, parse_freesurfer};

}  // namespace

std::span<const std::string_view> triangle_extensions() { return triangle_suffixes; }

Triangles read_triangles(const std::filesystem::path& file) {
  return read_by_extension<Triangles>(file, triangle_suffixes, triangle_parsers);
}

}  // namespace plexway::io
