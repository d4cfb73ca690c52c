#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "complexes/test_meshes.hpp"

/// Shortest ways among triangles in a plane by brute force: whoever sees whom, and Dijkstra.
namespace plexway::testing {

/// Of a surface in the plane z = 0 without folds, with any walls, holes and slits, in generic
/// position: no three vertices on a line but for those of straight walls. Quadratic in the vertices
/// times the walls.
class PlaneWays {
 public:
  explicit PlaneWays(const Surface& surface) : surface_(surface) {
    std::map<std::pair<Index, Index>, int> count;
    for (const Face& f : surface.faces)
      for (std::size_t i = 0; i < 3; ++i) ++count[std::minmax(f[i], f[(i + 1) % 3])];
    std::vector<char> rim(surface.positions.size(), 0);
    for (const auto& [edge, n] : count) {
      if (n != 1) continue;
      walls_.push_back({edge.first, edge.second});
      rim[edge.first] = rim[edge.second] = 1;
    }
    edges_ = std::move(count);
    for (Index v = 0; v < rim.size(); ++v)
      if (rim[v] != 0) stops_.push_back(v);
  }

  /// One a vertex; +inf where no way leads.
  [[nodiscard]] std::vector<double> from(Index source) const {
    const std::size_t n = surface_.positions.size();
    std::vector<double> best(n, std::numeric_limits<double>::infinity());
    std::vector<char> done(n, 0);
    best[source] = 0;
    for (Index at = source; at != none;) {
      done[at] = 1;
      for (Index v = 0; v < n; ++v)
        if (done[v] == 0 && best[at] + length(at, v) < best[v] && sees(at, v))
          best[v] = best[at] + length(at, v);
      at = none;
      for (const Index v : stops_)
        if (done[v] == 0 && std::isfinite(best[v]) && (at == none || best[v] < best[at])) at = v;
    }
    return best;
  }

  [[nodiscard]] double length(Index a, Index b) const {
    const Position &p = surface_.positions[a], &q = surface_.positions[b];
    return std::hypot(p[0] - q[0], p[1] - q[1]);
  }

 private:
  using Point = std::array<double, 2>;

  [[nodiscard]] Point at(Index v) const {
    return {surface_.positions[v][0], surface_.positions[v][1]};
  }
  // Twice the area of a triangle, > 0 where it turns left.
  static double turn(const Point& a, const Point& b, const Point& c) {
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  }
  static bool apart(double a, double b) {
    constexpr double close = 1e-13;
    return (a > close && b < -close) || (a < -close && b > close);
  }

  // No wall is crossed, and what lies between is floor.
  [[nodiscard]] bool sees(Index from, Index to) const {
    if (edges_.contains(std::minmax(from, to))) return true;
    const Point a = at(from), b = at(to);
    for (const auto& [u, v] : walls_) {
      if (u == from || u == to || v == from || v == to) continue;
      const Point p = at(u), q = at(v);
      if (apart(turn(a, b, p), turn(a, b, q)) && apart(turn(p, q, a), turn(p, q, b))) return false;
    }
    const Point middle = {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2};
    return std::any_of(surface_.faces.begin(), surface_.faces.end(), [&](const Face& f) {
      const double side = turn(at(f[0]), at(f[1]), at(f[2])) > 0 ? 1 : -1;
      for (std::size_t i = 0; i < 3; ++i)
        if (side * turn(at(f[i]), at(f[(i + 1) % 3]), middle) < -1e-13) return false;
      return true;
    });
  }

  const Surface& surface_;
  std::map<std::pair<Index, Index>, int> edges_;
  std::vector<std::array<Index, 2>> walls_;
  std::vector<Index> stops_;  // where a way may bend
};

}  // namespace plexway::testing
