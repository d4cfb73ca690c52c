#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

#include <plexway/complex/triangle_record.hpp>

#include "propagate/windows/fan_walk.hpp"
#include "propagate/windows/vertex_angles.hpp"

namespace plexway::windows {

/// Where the shortest path to a vertex comes from: a direction in one of its corners, `along` and
/// `off` the edge that starts there, of any length. No corner: from all around, as at a source.
template <class Real>
struct Arrival {
  Index corner = none;  ///< 3 f + i
  Real along = 0, off = 0;
};

/// What a vertex lights up of the edge opposite one of its corners: from `begin` to `end`, measured
/// from the edge's first corner.
struct Lit {
  Index face, edge;
  double begin, end;
};

/// A vertex that paths bend at, as a source of its own: it lights up what lies in the shadow of the
/// path that arrived, the directions pi or more away from it on both sides.
template <class Real>
class PseudoSource {
 public:
  /// Both ends of a shadow are moved out by so many radians: more light only adds longer paths.
  static constexpr double slack = 1e-9;

  explicit PseudoSource(std::span<const TriangleRecord<Real>> triangles) : triangles_(triangles) {}

  /// Calls lit(Lit) for each corner that is lit and along(corner, edge) for each edge at the vertex
  /// within the shadow. The shadow begins `straight` radians from the arrival; pi unless light is
  /// wanted that goes astray.
  template <class OnLit, class OnEdge>
  void shine(const Arrival<double>& arrival, VertexAngles::Kind kind, double total,
             std::span<const Index> corners, double straight, OnLit&& lit, OnEdge&& along) const {
    if (arrival.corner == none || kind == VertexAngles::irregular) {
      for (const Index c : corners) shine_all(c / 3, c % 3, lit, along);
      return;
    }
    const Index f = arrival.corner / 3, i = arrival.corner % 3;
    const double from = std::atan2(arrival.off, arrival.along), width = angle(f, i);
    const double begin = straight - slack;
    if (kind == VertexAngles::inner) {
      shine_way({f, i, false}, -from, begin, total - begin, lit, along);
      return;
    }
    constexpr double open = std::numeric_limits<double>::infinity();
    shine_way({f, i, false}, -from, begin, open, lit, along);
    shine_way({f, i, true}, from - width, begin, open, lit, along);
  }

 private:
  [[nodiscard]] double angle(Index f, std::size_t i) const {
    return std::atan2(static_cast<double>(triangles_[f].sine(i)),
                      static_cast<double>(triangles_[f].cosine[i]));
  }

  template <class OnLit, class OnEdge>
  void shine_all(Index f, Index i, OnLit& lit, OnEdge& along) const {
    const Index e = static_cast<Index>(edge_after(i));
    lit(Lit{f, e, 0, static_cast<double>(triangles_[f].length[e])});
    along(FanWalk{f, i, false});
    along(FanWalk{f, i, true});
  }

  /// One way around, from an edge that is entered at angle `at` from the arrival.
  template <class OnLit, class OnEdge>
  void shine_way(FanWalk walk, double at, double begin, double end, OnLit& lit,
                 OnEdge& along) const {
    do {
      const double width = angle(walk.face, walk.corner), leave = at + width;
      if (leave > begin && at < end) {
        const Index e = static_cast<Index>(edge_after(walk.corner));
        const double length = static_cast<double>(triangles_[walk.face].length[e]);
        double low = at >= begin ? 0 : reach(walk, begin - at);
        double high = leave <= end ? length : reach(walk, end - at);
        if (walk.by_start) {
          const double first = length - high;
          high = length - low;
          low = first;
        }
        lit(Lit{walk.face, e, low, high});
      }
      if (leave >= end) return;
      at = leave;
      if (at >= begin) along(walk);
    } while (walk.step(triangles_));
  }

  /// Where a ray at `turn` from the edge that was entered meets the opposite edge, from that edge's
  /// end on.
  [[nodiscard]] double reach(const FanWalk& walk, double turn) const {
    const TriangleRecord<Real>& t = triangles_[walk.face];
    const std::size_t next = edge_after(walk.corner), other = edge_after(next);
    const std::size_t end = walk.by_start ? other : next;
    const double side = static_cast<double>(t.length[walk.entering_edge()]);
    const double length = static_cast<double>(t.length[next]);
    const double s = std::sin(turn), c = std::cos(turn);
    const double sum =
        s * static_cast<double>(t.cosine[end]) + c * static_cast<double>(t.sine(end));
    const double x = side * s / sum;
    return sum > 0 && x < length ? x : length;
  }

  std::span<const TriangleRecord<Real>> triangles_;
};

}  // namespace plexway::windows
