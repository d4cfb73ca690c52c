#include "fuzz_cells.hpp"
#include "fuzz_tets.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::check_cells(plexway::io::parse_vtk_cells, data, size);
  return fuzz::check_tets(plexway::io::parse_vtk, data, size);
}
