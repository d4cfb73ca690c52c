#include "fuzz_edges.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return fuzz::check_edge_reader(plexway::io::parse_edge_list, data, size);
}
