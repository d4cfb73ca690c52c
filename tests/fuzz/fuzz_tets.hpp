#pragma once

#include <plexway/io/tets.hpp>

#include "fuzz_reader.hpp"

namespace fuzz {

/// What every reader of solids promises for any bytes: a sound solid, or an InputError of one line
/// that starts with the file's name.
template <class Parser>
int check_tets(Parser parse, const std::uint8_t* data, std::size_t size) {
  try {
    const auto solid = parse({reinterpret_cast<const char*>(data), size}, "input");
    require(!solid.tets.empty(), "a solid has tetrahedra");
    for (const auto& position : solid.positions)
      for (const double c : position) require(std::isfinite(c), "coordinates are finite");
    for (const auto& tet : solid.tets)
      for (const auto vertex : tet)
        require(vertex < solid.positions.size(), "indices are in range");
  } catch (const plexway::InputError& error) {
    const std::string_view message = error.what();
    require(message.starts_with("input:"), "a message names the file");
    for (const char c : message) require(c >= ' ' && c <= '~', "a message is one printable line");
  } catch (const plexway::NotBuiltError&) {
    // A build without pugixml or zlib may say so.
  }
  return 0;
}

}  // namespace fuzz
