#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "complexes/test_meshes.hpp"

namespace plexway::testing {

/// Exact distances on a small surface by another way than any of the library's: a shortest path is
/// made of straight lines from vertex to vertex. All straight lines are found by unfolding strips
/// of triangles, as long as a line fits through and is not longer than the longest that may count,
/// and the rest is shortest paths in a graph. Knows of no angles, no saddles, no windows that beat
/// each other. Any number of triangles may share an edge.
class UnfoldedLines {
 public:
  /// Lines longer than `longest` are not looked for.
  UnfoldedLines(const Surface& surface, double longest) : surface_(surface), longest_(longest) {
    for (Index f = 0; f < surface.faces.size(); ++f)
      for (std::size_t i = 0; i < 3; ++i) {
        const Index a = surface.faces[f][i], b = surface.faces[f][(i + 1) % 3];
        around_[std::minmax(a, b)].push_back({f, surface.faces[f][(i + 2) % 3]});
      }
    const std::size_t n = surface.positions.size();
    line_.assign(n, std::vector<double>(n, infinity));
    for (const Face& face : surface.faces)
      for (std::size_t i = 0; i < 3; ++i) {
        const Index a = face[i], b = face[(i + 1) % 3], v = face[(i + 2) % 3];
        for (const auto& [u, w] : {std::pair(a, b), std::pair(b, a)})
          line_[u][w] = std::min(line_[u][w], gap(u, w));
        found_ = &line_[v];
        const Index f = static_cast<Index>(&face - surface.faces.data());
        const Flat p{gap(v, a), 0};
        const Flat q = apex(p, {0, 0}, gap(b, a), gap(v, b));
        follow(f, a, b, p, q, p, q);
      }
    for (std::size_t k = 0; k < n; ++k)
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j)
          line_[i][j] = std::min(line_[i][j], line_[i][k] + line_[k][j]);
    for (std::size_t i = 0; i < n; ++i) line_[i][i] = 0;
  }

  [[nodiscard]] const std::vector<double>& from(Index vertex) const { return line_[vertex]; }

  /// From a point of a face.
  [[nodiscard]] std::vector<double> from(Index f, const std::array<double, 3>& b) {
    const Face& face = surface_.faces[f];
    std::array<Flat, 3> corner;
    corner[0] = {0, 0};
    corner[1] = {gap(face[0], face[1]), 0};
    corner[2] = apex(corner[1], corner[0], gap(face[2], face[1]), gap(face[2], face[0]));
    Flat s{0, 0};
    for (std::size_t i = 0; i < 3; ++i) s.x += b[i] * corner[i].x, s.y += b[i] * corner[i].y;
    for (Flat& c : corner) c.x -= s.x, c.y -= s.y;
    std::vector<double> straight(surface_.positions.size(), infinity);
    found_ = &straight;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      straight[face[i]] = std::hypot(corner[i].x, corner[i].y);
      follow(f, face[i], face[j], corner[i], corner[j], corner[i], corner[j]);
    }
    std::vector<double> distance = straight;
    for (std::size_t v = 0; v < distance.size(); ++v)
      for (std::size_t w = 0; w < distance.size(); ++w)
        distance[w] = std::min(distance[w], straight[v] + line_[v][w]);
    return distance;
  }

 private:
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  struct Flat {
    double x, y;
  };
  static double cross(Flat a, Flat b) { return a.x * b.y - a.y * b.x; }

  [[nodiscard]] double gap(Index v, Index w) const {
    const Position &p = surface_.positions[v], &q = surface_.positions[w];
    return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
  }
  /// The third corner, to the right of the way from `a` to `b`, that far from both.
  static Flat apex(Flat a, Flat b, double to_a, double to_b) {
    const double ex = b.x - a.x, ey = b.y - a.y, length = std::hypot(ex, ey);
    const double along = (to_a * to_a - to_b * to_b + length * length) / (2 * length);
    const double off = std::sqrt(std::max(0., to_a * to_a - along * along));
    const double x = along / length, y = off / length;
    return {a.x + ex * x + ey * y, a.y + ey * x - ex * y};
  }

  /// Over edge a b, seen from the origin at p and q (p to the right), within the rays through `low`
  /// and `high`.
  void follow(Index from, Index a, Index b, Flat p, Flat q, Flat low, Flat high) {
    const double length2 = (q.x - p.x) * (q.x - p.x) + (q.y - p.y) * (q.y - p.y);
    const double t =
        length2 > 0 ? std::clamp(-(p.x * (q.x - p.x) + p.y * (q.y - p.y)) / length2, 0., 1.) : 0;
    if (std::hypot(p.x + t * (q.x - p.x), p.y + t * (q.y - p.y)) > longest_) return;
    for (const auto& [f, v] : around_.at(std::minmax(a, b))) {
      if (f == from) continue;
      const Flat r = apex(p, q, gap(v, a), gap(v, b));
      const double above = cross(low, r), below = cross(r, high);
      if (above >= 0 && below >= 0) (*found_)[v] = std::min((*found_)[v], std::hypot(r.x, r.y));
      if (above > 0) follow(f, a, v, p, r, low, below > 0 ? r : high);
      if (below > 0) follow(f, v, b, r, q, above > 0 ? r : low, high);
    }
  }

  const Surface& surface_;
  double longest_;
  std::map<std::pair<Index, Index>, std::vector<std::pair<Index, Index>>> around_;
  std::vector<std::vector<double>> line_;
  std::vector<double>* found_ = nullptr;
};

}  // namespace plexway::testing
