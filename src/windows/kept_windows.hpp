#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "windows/entered_triangle.hpp"

namespace plexway::detail::windows {

/// All windows that had their turn in a solve, by the halfedge that they entered by: what distances
/// inside triangles are read from.
template <class Real>
class KeptWindows {
 public:
  void start(std::size_t halfedges) {
    first_.assign(halfedges, none);
    windows_.clear();
  }
  void take(Index halfedge, const Beam<Real>& beam, Real sigma, Index source) {
    windows_.push_back({beam, sigma, source, first_[halfedge]});
    first_[halfedge] = static_cast<Index>(windows_.size() - 1);
  }

  /// How a point is seen: over the foot, a place of the edge.
  struct Sight {
    double distance = std::numeric_limits<double>::infinity(), foot = 0;
    Index source = none;
  };
  /// The nearest window on a halfedge as seen from (x, h) in the triangle that it enters. Where no
  /// ray leads there the way goes around the end of the light, so it always is the length of one.
  [[nodiscard]] Sight nearest(Index halfedge, double x, double h) const {
    Sight best;
    for (Index n = first_[halfedge]; n != none; n = windows_[n].next) {
      const Kept& w = windows_[n];
      const double sx = static_cast<double>(w.beam.x), sh = static_cast<double>(w.beam.h);
      const double sum = sh + h;
      const double foot =
          std::clamp(sum > 0 ? sx + (x - sx) * (sh / sum) : x, static_cast<double>(w.beam.begin),
                     static_cast<double>(w.beam.end));
      const double d =
          static_cast<double>(w.sigma) + std::hypot(foot - sx, sh) + std::hypot(x - foot, h);
      if (d < best.distance) best = {d, foot, w.source};
    }
    return best;
  }

  [[nodiscard]] std::size_t bytes() const {
    return first_.capacity() * sizeof(Index) + windows_.capacity() * sizeof(Kept);
  }

 private:
  struct Kept {
    Beam<Real> beam;
    Real sigma;
    Index source, next;
  };
  std::vector<Index> first_;
  std::vector<Kept> windows_;
};

}  // namespace plexway::detail::windows
