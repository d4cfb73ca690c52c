#include "fuzz_reader.hpp"
#include "io/readers.hpp"

PLEXWAY_FUZZER(medit)(const std::uint8_t* data, std::size_t size) {
  fuzz::check_reader(plexway::io::parse_medit_cells, data, size);
  return fuzz::check_reader(plexway::io::parse_medit, data, size);
}
