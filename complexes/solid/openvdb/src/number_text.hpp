#pragma once

#include <array>
#include <cstdio>
#include <string>

namespace plexway::openvdb {

/// As messages show numbers: of any size, six digits.
inline std::string text_of(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%g", value);
  return text.data();
}

}  // namespace plexway::openvdb
