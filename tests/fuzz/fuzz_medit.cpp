#include "fuzz_tets.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return fuzz::check_tets(plexway::io::parse_medit, data, size);
}
