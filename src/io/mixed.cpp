#include <plexway/io/mixed.hpp>

#include "by_extension.hpp"

namespace plexway::io {
namespace {

using MixedParser = Mixed (*)(std::string_view, std::string_view);
constexpr std::array<std::string_view, 3> mixed_suffixes = {".msh", ".vtu", ".vtk"};
constexpr std::array<MixedParser, 3> mixed_parsers = {parse_gmsh_mixed, parse_vtu_mixed,
                                                      parse_vtk_mixed};

constexpr std::array<std::string_view, 6> all_extensions = {".msh", ".vtu", ".vtk",
                                                            ".vtp", ".glb", ".gltf"};
constexpr std::array<MixedParser, 6> all_parsers = {
    parse_gmsh_cells, parse_vtu_cells, parse_vtk_cells, parse_vtu_cells, parse_gltf, parse_gltf};

}  // namespace

std::span<const std::string_view> mixed_extensions() { return mixed_suffixes; }

Mixed read_mixed(const std::filesystem::path& file) {
  return read_by_extension<Mixed>(file, mixed_suffixes, mixed_parsers);
}

std::span<const std::string_view> cell_extensions() { return all_extensions; }

Mixed read_cells(const std::filesystem::path& file) {
  return read_by_extension<Mixed>(file, all_extensions, all_parsers);
}

}  // namespace plexway::io
