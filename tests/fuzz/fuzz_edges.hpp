#pragma once

#include <plexway/io/edges.hpp>

#include "fuzz_reader.hpp"

namespace fuzz {

/// What every reader of wireframes promises for any bytes: a sound wireframe, or an InputError of
/// one line that starts with the file's name.
template <class Parser>
int check_edge_reader(Parser parse, const std::uint8_t* data, std::size_t size) {
  try {
    const auto wires = parse({reinterpret_cast<const char*>(data), size}, "input");
    require(!wires.edges.empty(), "a wireframe has edges");
    require(wires.positions.empty() ? wires.lengths.size() == wires.edges.size()
                                    : wires.lengths.empty(),
            "edges have lengths, from the file or from positions");
    if (!wires.positions.empty())
      require(wires.positions.size() == wires.vertices, "one position a vertex");
    for (const auto& position : wires.positions)
      for (const double c : position) require(std::isfinite(c), "coordinates are finite");
    for (const double length : wires.lengths)
      require(std::isfinite(length) && length >= 0, "lengths are finite and not negative");
    for (const auto& edge : wires.edges)
      for (const auto vertex : edge) require(vertex < wires.vertices, "indices are in range");
    require(wires.vertices <= (1u << 24) + 64 * size, "no more vertices than the file is worth");
  } catch (const plexway::InputError& error) {
    const std::string_view message = error.what();
    require(message.starts_with("input:"), "a message names the file");
    for (const char c : message) require(c >= ' ' && c <= '~', "a message is one printable line");
  }
  return 0;
}

}  // namespace fuzz
