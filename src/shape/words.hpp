#pragma once

#include <array>
#include <cstddef>
#include <cstdio>
#include <string>
#include <string_view>

namespace plexway::detail {

/// "triangle" for "triangles"; knows "vertices" and "tetrahedra" too.
std::string singular(std::string_view plural);
/// "1 triangle", "2 triangles"; the plural is given.
std::string counted(std::size_t count, std::string_view plural);
/// Four significant digits, for people: "0.01234", "1.235e-07", "inf".
std::string short_number(double value);
/// "1.23 s", "4.5 ms".
std::string short_time(double seconds);

/// Seventeen digits, from which the same number is read.
inline std::string exact_number(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.17g", value);
  return text.data();
}

}  // namespace plexway::detail
