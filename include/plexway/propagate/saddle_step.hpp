#pragma once

#include <cmath>
#include <limits>

#include <plexway/complex/triangle_record.hpp>
#include <plexway/kernel/hinge.hpp>
#include <plexway/propagate/saddle_label.hpp>

/// One update under Visibility::saddles, hinge by hinge. saddle_step_lanes.hpp does the common case
/// of both hinges of a triangle at once; this is the rule it must agree with.
///
/// A label is a virtual source S with at most one limit on each side: the saddle that its line of
/// sight passes most closely. What lies beyond a limit is in its shadow, where the path bends at
/// that limit. S itself is given up for the limit only when a whole hinge lies in shadow: until
/// then both the lit part and the shadow are known, which a label that bends as soon as one probe
/// is in shadow (GSP 2021) cannot say.
namespace plexway {

/// A label under way to the next triangle: posed on the hinge between, plain numbers.
template <class Real>
struct PosedSaddles {
  using Kernel = kernel::HingeKernel<Real, 1>;
  using Point = typename Kernel::HingePoint;
  Point source, limit[2];  ///< limits: left, right
  Real sigma;
};

/// The hinge as the triangle beyond sees it.
template <class Real>
struct SaddleHinge {
  Real length;
  typename PosedSaddles<Real>::Point apex;  ///< of the triangle beyond
  bool saddle[2];                           ///< may paths bend at the left, the right end?
  int pivot;  ///< 0 or 1: the end shared with the edge the path came in by, or -1 for neither
};

namespace detail {

/// The K = 1 kernel measures x in lengths here: an axis of length 1.
template <class Real>
inline constexpr typename kernel::HingeKernel<Real, 1>::HingePose unit_pose = {
    {Real(0), Real(1)}, {Real(1)}, {Real(1)}, {Real(1)}};

template <class Real>
Real distance(const typename PosedSaddles<Real>::Point& a,
              const typename PosedSaddles<Real>::Point& b) {  // on the same side
  return kernel::sqrt((a.x[0] - b.x[0]) * (a.x[0] - b.x[0]) + (a.h - b.h) * (a.h - b.h));
}

/// From S, is q (beyond the hinge) to the left of p (on S's side)? Positive if so.
template <class Real>
Real left_of(const typename PosedSaddles<Real>::Point& S,
             const typename PosedSaddles<Real>::Point& p,
             const typename PosedSaddles<Real>::Point& q) {
  return (p.x[0] - S.x[0]) * (S.h + q.h) - (S.h - p.h) * (q.x[0] - S.x[0]);
}

/// What rounding may do to a coordinate of S posed on the hinge.
template <class Real>
Real rounding(const typename PosedSaddles<Real>::Point& S, Real length) {
  return Real(64) * std::numeric_limits<Real>::epsilon() *
         (std::abs(S.x[0]) + std::abs(S.h) + length);
}

/// Does this limit hide the whole hinge? `turn` is its left_of for the hinge's far end, positive if
/// hidden. Where the limit is that very end, turn is 0 but for rounding, and all else is hidden.
template <class Real>
bool hides_hinge(const PosedSaddles<Real>& label, int side, Real length, Real turn) {
  const auto &S = label.source, &limit = label.limit[side];
  return turn > -length * rounding<Real>(S, length) && (limit.x[0] != S.x[0] || limit.h != S.h);
}

template <class Real>
void give_up_source(PosedSaddles<Real>& label, const typename PosedSaddles<Real>::Point& bend) {
  label.sigma += distance<Real>(label.source, bend);
  label.source = label.limit[0] = label.limit[1] = bend;
}

}  // namespace detail

/// Length of the path from the source's beginning to q in the triangle beyond the hinge: straight,
/// or bent at a limit it would pass on the wrong side, then at an end of the hinge it would miss.
template <class Real>
Real path_length(const PosedSaddles<Real>& label, Real length,
                 const typename PosedSaddles<Real>::Point& q) {
  using Kernel = typename PosedSaddles<Real>::Kernel;
  typename PosedSaddles<Real>::Point from = label.source;
  Real walked = label.sigma;
  const bool left = detail::left_of<Real>(from, label.limit[0], q) > 0;
  const bool right = detail::left_of<Real>(from, label.limit[1], q) < 0;
  if (left || right) {
    walked += detail::distance<Real>(from, label.limit[left ? 0 : 1]);
    from = label.limit[left ? 0 : 1];
  }
  const auto c = Kernel::crossing(from, q);
  if (c.x[0] < 0 || c.x[0] > length * c.w) {
    const typename PosedSaddles<Real>::Point end = {{c.x[0] < 0 ? Real(0) : length}, Real(0)};
    walked += detail::distance<Real>(from, end);
    from = end;
  }
  return walked + kernel::sqrt(Kernel::distance_squared(detail::unit_pose<Real>, from, q));
}

/// Takes a label over the hinge: gives the source up where the whole hinge is in shadow, then lets
/// the hinge's saddles narrow the limits. Returns the distance of the centre of the triangle
/// beyond, or +inf where S lies behind the hinge and no path can bend around the pivot
/// (`last_resort` turns around it nevertheless, so that nothing stays unreached).
template <class Real>
Real cross_hinge(PosedSaddles<Real>& label, const SaddleHinge<Real>& hinge, bool last_resort) {
  using Point = typename PosedSaddles<Real>::Point;
  const Point end[2] = {{{Real(0)}, Real(0)}, {{hinge.length}, Real(0)}};
  for (int bends = 0; bends < 3; ++bends) {
    Point& S = label.source;
    if (S.h < -detail::rounding<Real>(S, hinge.length) && hinge.pivot >= 0) {
      // The strip has turned by more than half a circle around the pivot. (An S in the line of the
      // hinge, at the pivot for one, is not behind it.)
      const Point& limit = label.limit[hinge.pivot];
      const Real turn = detail::left_of<Real>(S, limit, end[hinge.pivot]);
      if (bends < 2 && (hinge.pivot == 0 ? turn > 0 : turn < 0)) {
        detail::give_up_source<Real>(label, Point(limit));
        continue;
      }
      if (!last_resort && !hinge.saddle[hinge.pivot]) return std::numeric_limits<Real>::infinity();
      detail::give_up_source<Real>(label, end[hinge.pivot]);
      break;
    }
    const bool left = detail::hides_hinge<Real>(label, 0, hinge.length,
                                                detail::left_of<Real>(S, label.limit[0], end[1]));
    const bool right = detail::hides_hinge<Real>(label, 1, hinge.length,
                                                 -detail::left_of<Real>(S, label.limit[1], end[0]));
    if (!left && !right) break;
    detail::give_up_source<Real>(label, Point(label.limit[left ? 0 : 1]));
  }
  if (hinge.saddle[0] && !(detail::left_of<Real>(label.source, label.limit[0], end[0]) > 0))
    label.limit[0] = end[0];
  if (hinge.saddle[1] && !(detail::left_of<Real>(label.source, label.limit[1], end[1]) < 0))
    label.limit[1] = end[1];
  const Point centre = {{(hinge.length + hinge.apex.x[0]) * Real(1. / 3)},
                        hinge.apex.h * Real(1. / 3)};
  return path_length<Real>(label, hinge.length, centre);
}

}  // namespace plexway
