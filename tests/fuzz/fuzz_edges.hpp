#pragma once

#include <plexway/io/edges.hpp>

#include "fuzz_reader.hpp"

namespace fuzz {

/// What every reader of wireframes promises for any bytes: a sound wireframe, or an InputError.
template <class Parser>
int check_edge_reader(Parser parse, const std::uint8_t* data, std::size_t size) {
  return check_input("input", [&] {
    const auto wires = parse({reinterpret_cast<const char*>(data), size}, "input");
    require(!wires.edges.empty() || wires.positions.empty(), "a wireframe has edges");
    require(wires.positions.empty() ? wires.lengths.size() == wires.edges.size()
                                    : wires.lengths.empty(),
            "edges have lengths, from the file or from positions");
    if (!wires.positions.empty())
      require(wires.positions.size() == wires.vertices, "one position a vertex");
    require_finite(wires.positions);
    for (const double length : wires.lengths)
      require(std::isfinite(length) && length >= 0, "lengths are finite and not negative");
    require_in_range(wires.edges, wires.vertices);
    require(wires.vertices <= (1u << 24) + 64 * size, "no more vertices than the file is worth");
  });
}

}  // namespace fuzz
