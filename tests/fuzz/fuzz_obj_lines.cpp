#include "fuzz_edges.hpp"

PLEXWAY_FUZZER(obj_lines)(const std::uint8_t* data, std::size_t size) {
  return fuzz::check_edge_reader(plexway::io::parse_obj_lines, data, size);
}
