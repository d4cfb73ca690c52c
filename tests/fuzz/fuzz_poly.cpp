// TetGen's .poly and .smesh, by the first byte; they are read by name.

#include "fuzz_named_file.hpp"

#ifdef PLEXWAY_HAS_TETGEN
#include <plexway/tetgen/piecewise_linear_complex.hpp>

PLEXWAY_FUZZER(poly)(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const fuzz::NamedFile file(data[0] % 2 == 0 ? ".poly" : ".smesh", data + 1, size - 1);
  // Points may be in a .node of the same name, and what is wrong there.
  const std::string name = file.name().substr(0, file.name().rfind('.'));
  return fuzz::check_input(name, [&] {
    const auto complex = plexway::tetgen::read_poly(file.name());
    fuzz::require_finite(complex.positions);
    for (const auto& facet : complex.facets)
      fuzz::require_in_range(facet.polygons, complex.positions.size());
  });
}
#else
PLEXWAY_FUZZER(poly)(const std::uint8_t*, std::size_t) { return 0; }
#endif
