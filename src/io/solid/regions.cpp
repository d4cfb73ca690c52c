#include <plexway/io/regions.hpp>

#include "io/opened_file.hpp"
#include "region_parsers.hpp"

namespace plexway::io {
Regions read_regions(const std::filesystem::path& path) {
  const OpenedFile file(path);
  const std::string& extension = file.extension();
  const auto parse = extension == ".msh"   ? parse_gmsh_regions
                     : extension == ".vtu" ? parse_vtu_regions
                     : extension == ".vtk" ? parse_vtk_regions
                                           : nullptr;
  if (parse == nullptr)
    throw InputError(file.name() + ": regions are read from .msh, .vtu and .vtk");
  return parse(file.bytes(), file.name());
}

}  // namespace plexway::io
