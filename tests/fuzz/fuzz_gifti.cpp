// GIfTI: a surface, and the same bytes as labels.

#include "fuzz_reader.hpp"

PLEXWAY_FUZZER(gifti)(const std::uint8_t* data, std::size_t size) {
  fuzz::check_reader(plexway::io::parse_gifti, data, size);
  const fuzz::MemoryFile file(data, size);
  return fuzz::check_input(file.name(), [&] { (void)plexway::io::read_gifti_labels(file.name()); });
}
