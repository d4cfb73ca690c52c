#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <plexway/surface/triangle_mesh.hpp>

#include "complexes/test_meshes.hpp"

namespace plexway::testing {

/// A cone of total angle `theta` around vertex 0, unrolled: ring i at radius (i + 1) / rings.
/// Given by lengths, so that theta may exceed a full turn.
template <class Real>
struct Cone {
  Index rings, around;
  double theta;
  std::vector<double> radius{0}, angle{0};
  std::vector<Face> faces;

  Cone(Index r, Index a, double t) : rings(r), around(a), theta(t) {
    for (Index i = 0; i < rings; ++i)
      for (Index j = 0; j < around; ++j) {
        radius.push_back(double(i + 1) / rings);
        angle.push_back(theta * j / around);
      }
    for (Index j = 0; j < around; ++j) {
      const Index k = (j + 1) % around;
      faces.push_back({0, 1 + j, 1 + k});
      for (Index i = 0; i + 1 < rings; ++i) {
        const Index a0 = 1 + i * around + j, b0 = 1 + i * around + k;
        faces.push_back({a0, a0 + around, b0 + around});
        faces.push_back({a0, b0 + around, b0});
      }
    }
  }
  [[nodiscard]] double distance(Index v, Index w) const {
    double turn = std::abs(angle[v] - angle[w]);
    turn = std::min(turn, theta - turn);
    if (turn >= std::numbers::pi || v == 0 || w == 0) return radius[v] + radius[w];
    const double p = radius[v] - radius[w] * std::cos(turn), q = radius[w] * std::sin(turn);
    return std::hypot(p, q);
  }
  [[nodiscard]] TriangleMesh<Real> mesh() const {
    std::vector<std::array<double, 3>> lengths;
    for (const Face& f : faces)
      lengths.push_back({distance(f[0], f[1]), distance(f[1], f[2]), distance(f[2], f[0])});
    return TriangleMesh<Real>(radius.size(), faces, lengths);
  }
};

}  // namespace plexway::testing
