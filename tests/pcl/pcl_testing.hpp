#pragma once

#include <array>
#include <cmath>
#include <cstring>
#include <random>
#include <string>
#include <vector>

#include "folder.hpp"

namespace pcl_testing {

using testing::Folder;

using Row = std::array<double, 3>;
using Rows = std::vector<Row>;

/// The header of a .pcd of three floats, unless said otherwise.
struct Header {
  std::string fields = "x y z", size = "4 4 4", type = "F F F", count = "1 1 1";
  std::string width = "3", height = "1", points = "3", data = "ascii";

  std::string text() const {
    return "# .PCD v0.7\nVERSION 0.7\nFIELDS " + fields + "\nSIZE " + size + "\nTYPE " + type +
           "\nCOUNT " + count + "\nWIDTH " + width + "\nHEIGHT " + height +
           "\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + points + "\nDATA " + data + "\n";
  }
};

template <class Number>
std::string packed(const std::vector<Number>& values) {
  std::string bytes(values.size() * sizeof(Number), '\0');
  std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

/// Points on the unit sphere, evenly scattered, always the same.
inline Rows sphere(std::size_t count, unsigned seed = 1) {
  std::mt19937_64 random(seed);
  const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  Rows points;
  for (std::size_t i = 0; i < count; ++i) {
    const double z = 2 * uniform() - 1, turn = 2 * 3.14159265358979323846 * uniform();
    const double r = std::sqrt(1 - z * z);
    points.push_back({r * std::cos(turn), r * std::sin(turn), z});
  }
  return points;
}

}  // namespace pcl_testing
