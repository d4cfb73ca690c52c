// FreeSurfer's annotations: a label for each vertex, or an InputError of one line.

#include <vector>

#include "fuzz_reader.hpp"
#include "io/surface/freesurfer_labels.hpp"

PLEXWAY_FUZZER(annotation)(const std::uint8_t* data, std::size_t size) {
  return fuzz::check_input("input", [&] {
    const auto labels = plexway::io::parse_freesurfer_annotation(
        {reinterpret_cast<const char*>(data), size}, "input");
    fuzz::require(8 * labels.size() < size, "no more vertices than bytes");
  });
}
