#include "fuzz_reader.hpp"

PLEXWAY_FUZZER(vtk)(const std::uint8_t* data, std::size_t size) {
  fuzz::check_reader(plexway::io::parse_vtk_cells, data, size);
  return fuzz::check_reader(plexway::io::parse_vtk, data, size);
}
