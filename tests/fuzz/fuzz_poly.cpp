// TetGen's .poly and .smesh, by the first byte; they are read by name.

#include "fuzz_reader.hpp"

#ifdef PLEXWAY_HAS_TETGEN
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include <plexway/tetgen/piecewise_linear_complex.hpp>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const auto folder = std::filesystem::temp_directory_path();
  const std::string name = (folder / ("plexway-fuzz-" + std::to_string(::getpid()))).string() +
                           (data[0] % 2 == 0 ? ".poly" : ".smesh");
  std::ofstream(name, std::ios::binary)
      .write(reinterpret_cast<const char*>(data + 1), static_cast<std::streamsize>(size - 1));
  try {
    const auto complex = plexway::tetgen::read_poly(name);
    for (const auto& p : complex.positions)
      for (const double x : p) fuzz::require(std::isfinite(x), "coordinates are finite");
    for (const auto& facet : complex.facets)
      for (const auto& polygon : facet.polygons)
        for (const auto v : polygon)
          fuzz::require(v < complex.positions.size(), "indices are in range");
  } catch (const plexway::InputError& error) {
    const std::string_view message = error.what();
    fuzz::require(message.find("plexway-fuzz-") != message.npos, "a message names the file");
    for (const char c : message)
      fuzz::require(c >= ' ' && c <= '~', "a message is one printable line");
  }
  std::filesystem::remove(name);
  return 0;
}
#else
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t*, std::size_t) { return 0; }
#endif
