#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <string_view>

#include <plexway/error.hpp>
#include <plexway/io/triangles.hpp>

namespace fuzz {

inline void require(bool holds, std::string_view what) {
  if (holds) return;
  std::cerr << "broken promise: " << what << '\n';
  std::abort();
}

/// What every reader promises for any bytes: a sound surface, or an InputError of one line that
/// starts with the file's name.
template <class Parser>
int check_reader(Parser parse, const std::uint8_t* data, std::size_t size) {
  using plexway::InputError;
  try {
    const auto surface = parse({reinterpret_cast<const char*>(data), size}, "input");
    require(!surface.triangles.empty(), "a surface has faces");
    for (const auto& position : surface.positions)
      for (const double c : position) require(std::isfinite(c), "coordinates are finite");
    for (const auto& triangle : surface.triangles)
      for (const auto vertex : triangle)
        require(vertex < surface.positions.size(), "indices are in range");
  } catch (const InputError& error) {
    const std::string_view message = error.what();
    require(message.starts_with("input:"), "a message names the file");
    for (const char c : message) require(c >= ' ' && c <= '~', "a message is one printable line");
  }
  return 0;
}

}  // namespace fuzz
