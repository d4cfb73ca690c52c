#include <plexway/fields/isosurfaces.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>

#include "fields/level_sets.hpp"

namespace plexway {
namespace {

using Position = std::array<double, 3>;

// What one value cuts: in each tetrahedron a triangle or a quadrilateral.
class SurfaceCut {
 public:
  SurfaceCut(std::span<const Position> positions, std::span<const double> distance, double value,
             Index number, Isosurfaces& out)
      : positions_(positions), distance_(distance), value_(value), number_(number), out_(out) {}

  void tet(const std::array<Index, 4>& corner) {
    std::array<Index, 4> below{}, above{};
    std::size_t low = 0, high = 0;
    for (const Index v : corner) {
      if (!std::isfinite(distance_[v])) return;
      // A vertex with just this value counts as above it.
      if (distance_[v] >= value_)
        above[high++] = v;
      else
        below[low++] = v;
    }
    if (low == 0 || high == 0) return;
    if (low == 1) {
      triangle(at(below[0], above[0]), at(below[0], above[1]), at(below[0], above[2]), below[0]);
    } else if (high == 1) {
      triangle(at(below[0], above[0]), at(below[1], above[0]), at(below[2], above[0]), below[0]);
    } else {
      const Index a = at(below[0], above[0]), b = at(below[0], above[1]);
      const Index c = at(below[1], above[1]), d = at(below[1], above[0]);
      triangle(a, b, c, below[0]);
      triangle(a, c, d, below[0]);
    }
  }

 private:
  // The vertex on an edge; at its upper end where that has just the value.
  Index at(Index low, Index high) {
    const double share = (value_ - distance_[low]) / (distance_[high] - distance_[low]);
    const bool at_end = distance_[high] == value_;
    const Index first = at_end ? high : std::min(low, high), second = std::max(low, high);
    const std::uint64_t edge = std::uint64_t{first} << 32 | (at_end ? high : second);
    const auto [known, is_new] = vertex_.emplace(edge, static_cast<Index>(out_.positions.size()));
    if (is_new) {
      Position p;
      for (std::size_t k = 0; k < 3; ++k)
        p[k] = at_end ? positions_[high][k]
                      : positions_[low][k] + share * (positions_[high][k] - positions_[low][k]);
      out_.positions.push_back(p);
      out_.value.push_back(number_);
    }
    return known->second;
  }

  // Clockwise as seen from `below`, which never lies in its plane.
  void triangle(Index a, Index b, Index c, Index below) {
    if (a == b || b == c || c == a) return;
    if (turn(a, b, c, positions_[below]) > 0) std::swap(b, c);
    out_.triangles.push_back({a, b, c});
  }
  [[nodiscard]] double turn(Index a, Index b, Index c, const Position& p) const {
    Position u, v, w;
    for (std::size_t k = 0; k < 3; ++k) {
      u[k] = out_.positions[b][k] - out_.positions[a][k];
      v[k] = out_.positions[c][k] - out_.positions[a][k];
      w[k] = p[k] - out_.positions[a][k];
    }
    return w[0] * (u[1] * v[2] - u[2] * v[1]) + w[1] * (u[2] * v[0] - u[0] * v[2]) +
           w[2] * (u[0] * v[1] - u[1] * v[0]);
  }

  std::span<const Position> positions_;
  std::span<const double> distance_;
  double value_;
  Index number_;
  Isosurfaces& out_;
  std::unordered_map<std::uint64_t, Index> vertex_;
};

}  // namespace

Isosurfaces isosurfaces(std::span<const Position> positions,
                        std::span<const std::array<Index, 4>> tets,
                        std::span<const double> distance, std::span<const double> values) {
  check_level_sets(positions.size(), tets, distance, values, "tetrahedron", "isosurface");
  Isosurfaces found;
  for (std::size_t n = 0; n < values.size(); ++n) {
    SurfaceCut cut(positions, distance, values[n], static_cast<Index>(n), found);
    for (const auto& tet : tets) cut.tet(tet);
  }
  return found;
}

}  // namespace plexway
