#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include <plexway/common/ids.hpp>

namespace samples {

/// A flat strip `edges` cells of size 1 long and `rows` wide, its vertices moved at random by up to
/// .2, on the boundary along it: convex, so distances are straight lines.
class LongStrip {
 public:
  using Index = plexway::Index;

  LongStrip(Index edges, Index rows, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    const auto off = [&] { return .4 * (static_cast<double>(random() >> 11) * 0x1p-53 - .5); };
    for (Index i = 0; i <= edges; ++i)
      for (Index j = 0; j <= rows; ++j) {
        const bool ends = i == 0 || i == edges, side = j == 0 || j == rows;
        places_.push_back({i + (ends ? 0 : off()), j + (side ? 0 : off())});
      }
    for (Index i = 0; i < edges; ++i)
      for (Index j = 0; j < rows; ++j) {
        const Index a = i * (rows + 1) + j, b = a + rows + 1;
        faces.push_back({a, b, a + 1});
        faces.push_back({b, b + 1, a + 1});
      }
  }

  std::vector<std::array<Index, 3>> faces;

  [[nodiscard]] Index vertices() const { return static_cast<Index>(places_.size()); }
  [[nodiscard]] double between(Index v, Index w) const {
    return std::hypot(places_[v][0] - places_[w][0], places_[v][1] - places_[w][1]);
  }
  [[nodiscard]] std::vector<std::array<double, 3>> lengths() const {
    std::vector<std::array<double, 3>> all;
    for (const auto& [a, b, c] : faces)
      all.push_back({between(a, b), between(b, c), between(c, a)});
    return all;
  }
  [[nodiscard]] std::vector<std::array<double, 3>> in_plane() const {
    std::vector<std::array<double, 3>> points;
    for (const auto& [x, y] : places_) points.push_back({x, y, 0});
    return points;
  }
  /// Wound up on a cylinder: edges become chords, shorter by 4e-8 at most.
  [[nodiscard]] std::vector<std::array<double, 3>> wound() const {
    constexpr double radius = 1000, rise = .1;
    std::vector<std::array<double, 3>> points;
    for (const auto& [x, y] : places_) {
      const double u = x * std::sqrt(1 - rise * rise) - y * rise;
      points.push_back({radius * std::cos(u / radius), radius * std::sin(u / radius),
                        x * rise + y * std::sqrt(1 - rise * rise)});
    }
    return points;
  }

 private:
  std::vector<std::array<double, 2>> places_;
};

}  // namespace samples
