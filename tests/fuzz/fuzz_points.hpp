#pragma once

#include <plexway/io/points.hpp>

#include "fuzz_reader.hpp"

namespace fuzz {

/// What every reader of clouds promises for any bytes: finite points, as many normals or none, or
/// an InputError of one line that starts with the file's name.
template <class Parser>
int check_points(Parser parse, const std::uint8_t* data, std::size_t size) {
  try {
    const auto points = parse({reinterpret_cast<const char*>(data), size}, "input");
    require(!points.positions.empty(), "a cloud has points");
    require(points.positions.size() <= size, "no more points than the file has bytes");
    require(points.normals.empty() || points.normals.size() == points.positions.size(),
            "normals are none or one a point");
    for (const auto* rows : {&points.positions, &points.normals})
      for (const auto& row : *rows)
        for (const double c : row) require(std::isfinite(c), "coordinates are finite");
  } catch (const plexway::InputError& error) {
    const std::string_view message = error.what();
    require(message.starts_with("input:"), "a message names the file");
    for (const char c : message) require(c >= ' ' && c <= '~', "a message is one printable line");
  }
  return 0;
}

}  // namespace fuzz
