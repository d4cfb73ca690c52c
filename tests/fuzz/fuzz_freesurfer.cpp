#include "fuzz_reader.hpp"

PLEXWAY_FUZZER(freesurfer)(const std::uint8_t* data, std::size_t size) {
  return fuzz::check_reader(plexway::io::parse_freesurfer, data, size);
}
