#include <plexway/io/mixed.hpp>

#include "by_extension.hpp"

namespace plexway::io {
namespace {

using Parser = Mixed (*)(std::string_view, std::string_view);
constexpr std::array<std::string_view, 3> extensions = {".msh", ".vtu", ".vtk"};
constexpr std::array<Parser, 3> parsers = {parse_gmsh_mixed, parse_vtu_mixed, parse_vtk_mixed};

constexpr std::array<std::string_view, 6> all_extensions = {".msh", ".vtu", ".vtk",
                                                            ".vtp", ".glb", ".gltf"};
constexpr std::array<Parser, 6> all_parsers = {parse_gmsh_cells, parse_vtu_cells, parse_vtk_cells,
                                               parse_vtu_cells,  parse_gltf,      parse_gltf};

}  // namespace

std::span<const std::string_view> mixed_extensions() { return extensions; }

Mixed read_mixed(const std::filesystem::path& file) {
  return read_by_extension<Mixed>(file, extensions, parsers);
}

std::span<const std::string_view> cell_extensions() { return all_extensions; }

Mixed read_cells(const std::filesystem::path& file) {
  return read_by_extension<Mixed>(file, all_extensions, all_parsers);
}

}  // namespace plexway::io
