#include "fuzz_reader.hpp"
#include "io/readers.hpp"

PLEXWAY_FUZZER(ply)(const std::uint8_t* data, std::size_t size) {
  fuzz::check_reader(plexway::io::parse_ply_cells, data, size);
  return fuzz::check_reader(plexway::io::parse_ply, data, size);
}
