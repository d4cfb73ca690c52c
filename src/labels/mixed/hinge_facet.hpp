#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

#include <plexway/common/ids.hpp>
#include <plexway/solid/detail/tet_record.hpp>

#include "labels/mixed/hinge_fermat.hpp"

namespace plexway {

/// A hinge between two solids as crossings move on it, or an edge that they bend at.
template <class Real>
struct HingeFacet {
  using Point = Vector3<Real>;
  Point origin[2], along[2][2];  // on either side
  Point dual[2];                 // on side 0: what tells a place
  Index vertex[3] = {none, none, none};
  Index across[3] = {none, none, none};  // over the edge that vertex i is not an end of
  int dimension = 0;

  /// A place, as the piece on a side has it.
  [[nodiscard]] Point at(std::size_t side, const HingePlace<Real>& b) const {
    return origin[side] + b[0] * along[side][0] + b[1] * along[side][1];
  }
  /// Is a crossing on the rim, where no hinge goes on, pulled off it? `pull` is how the path gets
  /// shorter with its place. It moves along the rim then, in the direction `free`, or not at all.
  bool held(const HingePlace<Real>& b, const std::array<Real, 2>& pull, Real (&free)[2]) const {
    constexpr Real rim = 16 * std::numeric_limits<Real>::epsilon();
    if (dimension != 2) return false;
    const Real weight[3] = {1 - b[0] - b[1], b[0], b[1]};
    const Point &u = along[0][0], &w = along[0][1];
    const Real uu = dot(u, u), uw = dot(u, w), ww = dot(w, w);
    std::size_t by[2];
    int count = 0;
    for (std::size_t i = 0; i < 3 && count < 2; ++i) {
      if (!(weight[i] <= rim) || across[i] != none) continue;
      // Along the normal of that side.
      const Real g[2] = {i == 0 ? Real(-1) : Real(i == 1), i == 0 ? Real(-1) : Real(i == 2)};
      const Real inward = (ww * g[0] - uw * g[1]) * pull[0] + (uu * g[1] - uw * g[0]) * pull[1];
      if (inward < 0) by[count++] = i;
    }
    if (count == 0) return false;
    const auto go_along = [&](std::size_t i) {
      free[0] = i == 0 ? Real(-1) : Real(i == 2);
      free[1] = Real(i != 2);
    };
    go_along(by[0]);
    if (count == 1) return true;
    for (const std::size_t n : {0, 1}) {  // from a corner, along either side
      go_along(by[n]);
      const std::size_t other = by[1 - n];
      const Real grows = other == 0 ? -free[0] - free[1] : free[other - 1];
      if ((free[0] * pull[0] + free[1] * pull[1]) * grows > 0) return true;
    }
    free[0] = free[1] = 0;
    return true;
  }
  /// Tells of another one between the same pieces, if they share an edge.
  void link(Index number, const HingeFacet& other) {
    for (std::size_t i = 0; i < 3; ++i) {
      int shared = 0;
      for (std::size_t k = 0; k < 3; ++k)
        shared +=
            k != i && std::find(other.vertex, other.vertex + 3, vertex[k]) != other.vertex + 3;
      if (shared == 2) across[i] = number;
    }
  }
};

}  // namespace plexway
