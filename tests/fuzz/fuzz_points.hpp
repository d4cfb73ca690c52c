#pragma once

#include <plexway/io/points.hpp>

#include "fuzz_reader.hpp"

namespace fuzz {

/// What every reader of clouds promises for any bytes: finite points, as many normals or none, or
/// an InputError.
template <class Parser>
int check_points(Parser parse, const std::uint8_t* data, std::size_t size) {
  return check_input("input", [&] {
    const auto points = parse({reinterpret_cast<const char*>(data), size}, "input");
    require(!points.positions.empty(), "a cloud has points");
    require(points.positions.size() <= size, "no more points than the file has bytes");
    require(points.normals.empty() || points.normals.size() == points.positions.size(),
            "normals are none or one a point");
    require_finite(points.positions);
    require_finite(points.normals);
  });
}

}  // namespace fuzz
