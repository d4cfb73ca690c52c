#pragma once

#include <array>
#include <cstdio>
#include <string>

namespace plexway {

/// Seventeen digits, from which the same number is read.
inline std::string exact_number(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.17g", value);
  return text.data();
}

}  // namespace plexway
