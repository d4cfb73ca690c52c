#include "fuzz_cells.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return fuzz::check_cells(plexway::io::parse_gltf, data, size);
}
