#include "fuzz_edges.hpp"

PLEXWAY_FUZZER(edge_list)(const std::uint8_t* data, std::size_t size) {
  return fuzz::check_edge_reader(plexway::io::parse_edge_list, data, size);
}
