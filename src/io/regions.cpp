#include <plexway/io/regions.hpp>

#include <plexway/io/mixed.hpp>

#include "by_extension.hpp"
#include "region_parsers.hpp"

namespace plexway::io {
namespace {

using RegionParser = Regions (*)(std::string_view, std::string_view);

template <Take take>
constexpr std::array<RegionParser, 3> region_parsers = {
    [](std::string_view bytes, std::string_view name) {
      return parse_gmsh_regions(bytes, name, take);
    },
    [](std::string_view bytes, std::string_view name) {
      return parse_vtu_regions(bytes, name, take);
    },
    [](std::string_view bytes, std::string_view name) {
      return parse_vtk_regions(bytes, name, take);
    }};
constexpr std::array<std::string_view, 3> region_suffixes = {".msh", ".vtu", ".vtk"};

}  // namespace

Regions read_regions(const std::filesystem::path& file, bool mixed) {
  return mixed ? read_by_extension<Regions>(file, region_suffixes, region_parsers<Take::mixed>)
               : read_by_extension<Regions>(file, region_suffixes, region_parsers<Take::tets>);
}

}  // namespace plexway::io
