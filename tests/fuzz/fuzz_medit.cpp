#include "fuzz_reader.hpp"

PLEXWAY_FUZZER(medit)(const std::uint8_t* data, std::size_t size) {
  return fuzz::check_reader(plexway::io::parse_medit, data, size);
}
