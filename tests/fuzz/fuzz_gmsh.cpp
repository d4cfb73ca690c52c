#include "fuzz_reader.hpp"

PLEXWAY_FUZZER(gmsh)(const std::uint8_t* data, std::size_t size) {
  fuzz::check_reader(plexway::io::parse_gmsh_cells, data, size);
  return fuzz::check_reader(plexway::io::parse_gmsh, data, size);
}
