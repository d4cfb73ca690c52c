#include "fuzz_reader.hpp"
#include "io/readers.hpp"

PLEXWAY_FUZZER(freesurfer)(const std::uint8_t* data, std::size_t size) {
  fuzz::check_reader(plexway::io::parse_freesurfer_ascii, data, size);
  return fuzz::check_reader(plexway::io::parse_freesurfer, data, size);
}
