#include "fuzz_reader.hpp"

PLEXWAY_FUZZER(gltf)(const std::uint8_t* data, std::size_t size) {
  return fuzz::check_reader(plexway::io::parse_gltf, data, size);
}
