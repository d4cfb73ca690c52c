#include <plexway/io/mixed.hpp>

#include "by_extension.hpp"

namespace plexway::io {
namespace {

using Parser = Mixed (*)(std::string_view, std::string_view);
constexpr std::array<std::string_view, 3> extensions = {".msh", ".vtu", ".vtk"};
constexpr std::array<Parser, 3> parsers = {parse_gmsh_mixed, parse_vtu_mixed, parse_vtk_mixed};

}  // namespace

std::span<const std::string_view> mixed_extensions() { return extensions; }

Mixed read_mixed(const std::filesystem::path& file) {
  return read_by_extension<Mixed>(file, extensions, parsers);
}

}  // namespace plexway::io
