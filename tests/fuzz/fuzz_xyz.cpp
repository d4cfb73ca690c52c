#include "fuzz_points.hpp"

PLEXWAY_FUZZER(xyz)(const std::uint8_t* data, std::size_t size) {
  return fuzz::check_points(plexway::io::parse_point_table, data, size);
}
