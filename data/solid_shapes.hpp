#pragma once

// The sample solid and the sample wireframe.

#include <map>
#include <vector>

#include "shapes.hpp"

namespace samples {

/// A block of n^3 cells a unit around the corner of an L: [0, 2] x [0, 2] x [0, 1] without the unit
/// cube at x, y > 1. Each cell is cut into the six tetrahedra around its diagonal. Paths bend at
/// the edge x = y = 1.
inline Shape elbow_solid() {
  constexpr Index n = 4;
  Shape shape;
  std::map<std::array<Index, 3>, Index> number;
  const auto vertex = [&](std::array<Index, 3> at) {
    const auto [found, is_new] = number.try_emplace(at, 0);
    if (is_new) found->second = shape.add({1.0 * at[0] / n, 1.0 * at[1] / n, 1.0 * at[2] / n});
    return found->second;
  };
  constexpr std::array<std::array<int, 3>, 6> orders = {
      {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
  for (Index i = 0; i < 2 * n; ++i)
    for (Index j = 0; j < 2 * n; ++j)
      for (Index k = 0; k < n; ++k) {
        if (i >= n && j >= n) continue;
        for (std::size_t o = 0; o < 6; ++o) {
          // From the cell's first corner to its last, one axis after the other.
          std::array<Index, 3> at = {i, j, k};
          std::array<Index, 4> tet = {vertex(at)};
          for (std::size_t step = 0; step < 3; ++step) {
            ++at[static_cast<std::size_t>(orders[o][step])];
            tet[step + 1] = vertex(at);
          }
          if (o >= 3) std::swap(tet[2], tet[3]);  // the odd orders are left-handed
          shape.tets.push_back(tet);
        }
      }
  return shape;
}

/// The surface of the same block, as coarse as it can be.
inline Shape elbow() {
  Shape shape;
  const std::vector<std::array<double, 2>> outline = {{0, 0}, {2, 0}, {2, 1},
                                                      {1, 1}, {1, 2}, {0, 2}};
  const auto n = static_cast<Index>(outline.size());
  for (const double z : {0.0, 1.0})
    for (const auto& [x, y] : outline) shape.add({x, y, z});
  for (Index i = 0; i < n; ++i) {
    const Index next = (i + 1) % n;
    shape.faces.push_back({i, next, next + n});
    shape.faces.push_back({i, next + n, i + n});
  }
  for (const auto& [a, b, c] :
       std::vector<std::array<Index, 3>>{{0, 1, 2}, {0, 2, 3}, {0, 3, 5}, {3, 4, 5}}) {
    shape.faces.push_back({a, c, b});
    shape.faces.push_back({a + n, b + n, c + n});
  }
  return shape;
}

/// A tree of vessels: each branch is a line of a few edges that wavers and parts in two at its end.
inline Shape vessels() {
  constexpr int generations = 7;
  constexpr int edges_a_branch = 6;
  Shape shape;
  Noise noise(3);
  struct Tip {
    Index at;
    Point along;
  };
  std::vector<Tip> tips = {{shape.add({0, 0, 0}), {0, 0, 1}}};
  double length = 1;
  for (int generation = 0; generation < generations; ++generation) {
    std::vector<Tip> next;
    for (const Tip& tip : tips) {
      const int branches = generation == 0 ? 1 : 2;
      const Point any = {noise(), noise(), noise()};
      const Point side = unit(cross(tip.along, any));
      for (int branch = 0; branch < branches; ++branch) {
        const double sign = branches == 1 ? 0 : 2 * branch - 1;
        Point along = unit(tip.along + (0.7 * sign) * side);
        Index from = tip.at;
        for (int e = 0; e < edges_a_branch; ++e) {
          along = unit(along + 0.15 * Point{noise(), noise(), noise()});
          const Index to = shape.add(shape.points[from] + (length / edges_a_branch) * along);
          shape.lines.push_back({from, to});
          from = to;
        }
        next.push_back({from, along});
      }
    }
    tips = std::move(next);
    length *= 0.78;
  }
  return shape;
}

}  // namespace samples
