#include "fuzz_points.hpp"

PLEXWAY_FUZZER(las)(const std::uint8_t* data, std::size_t size) {
  return fuzz::check_points(plexway::io::parse_las, data, size);
}
