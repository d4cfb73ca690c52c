#include "fuzz_reader.hpp"

PLEXWAY_FUZZER(vtu)(const std::uint8_t* data, std::size_t size) {
  fuzz::check_reader(plexway::io::parse_vtu_cells, data, size);
  return fuzz::check_reader(plexway::io::parse_vtu, data, size);
}
