#pragma once

#include "kernel/lanes.hpp"
#include "windows/entered_triangle.hpp"
#include "windows/merge.hpp"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpsabi"  // as in kernel/lanes.hpp

namespace plexway::detail::windows {

/// A window's light through a triangle, onto both edges it may leave by, at once: lanes left near,
/// left far, right near, right far. Each edge is measured from its pivot, A or B, so that left and
/// right, near and far are one formula; near is the end on the pivot's side.
template <class Real>
struct Spread {
  using L = kernel::Lanes<Real>;
  static constexpr Real rounding = sizeof(Real) == sizeof(float) ? Real(2e-6) : Real(1e-9);

  L x, h;    ///< the source as the edge sees it, as beams have it
  L behind;  ///< h, but below 0 where the edge turns its back to the source: at edges of no length
  L length;  ///< of the edge
  L at;      ///< where the light ends on it; `length` also for rays that leave by the other edge
  L distance;

  [[gnu::always_inline]] void go(const EnteredTriangle<Real>& t, const Window<Real>& w) {
    const Beam<Real>& beam = w.beam;
    if (beam.is_parallel()) [[unlikely]] {
      go_parallel(t, w);
      return;
    }
    const Real a = t.width - beam.x;
    const L cosine(t.cos_a, t.cos_a, t.cos_b, t.cos_b), sine(t.sin_a, t.sin_a, t.sin_b, t.sin_b);
    const L source(beam.x, beam.x, a, a), off(beam.h);
    const L point(beam.begin, beam.end, t.width - beam.end, t.width - beam.begin);
    length = L(t.left, t.left, t.right, t.right);
    x = cosine * source - sine * off;
    behind = sine * source + cosine * off;
    h = max(behind, L(Real(0)));
    // Where the ray through `point` goes; it never comes down to the edge where `slope` <= 0. What
    // only rounding keeps from the apex reaches it: else the way around the light's end, as long as
    // the straight one, would make a source of the apex.
    const L slope = behind - sine * point;
    const L reached = point * off / slope;
    at = select((slope.v > 0) & (reached.v < (length * L(1 - rounding)).v), reached, length);
    measure(t, w);
  }

  /// The distances where the light ends.
  [[gnu::always_inline]] void measure(const EnteredTriangle<Real>& t, const Window<Real>& w) {
    if (w.beam.is_parallel()) [[unlikely]] {
      const Real to_b = t.sigma_at_b(w.beam, w.sigma);
      distance = at * x + L(w.sigma, w.sigma, to_b, to_b);
      return;
    }
    const L along = at - x;
    distance = sqrt(along * along + behind * behind) + L(w.sigma);
  }

  /// Does light on this side reach the apex?
  [[nodiscard]] bool left_reaches() const { return !(at[1] < length[1]); }
  [[nodiscard]] bool right_reaches() const { return !(at[3] < length[3]); }
  [[nodiscard]] bool reaches_apex() const { return left_reaches() & right_reaches(); }

  /// Which sides have light that no vertex makes needless: bits 0 left, 1 right. A side's light is
  /// needless where its pivot serves the far end as well by more than `give`, or the apex the near
  /// end.
  [[nodiscard, gnu::always_inline]] int wanted(Real to_a, Real to_b, Real to_p, L give) const {
    const L from(to_p + length[0], to_a, to_p + length[2], to_b), way(-1, 1, -1, 1);
    const L other = __builtin_shufflevector(at.v, at.v, 1, 0, 3, 2);
    const int needless = kernel::lane_bits((from + way * at < distance - give) | (at.v == other.v));
    // Bit 0 where 0 and 1 are not set, bit 1 where 2 and 3 are not: looked up, not branched on.
    return sides[needless];
  }

  /// The window on the left edge from A, on the right edge from P: as triangles across see them.
  [[nodiscard]] Window<Real> left(const Window<Real>& w) const {
    return {{x[0], h[0], at[0], at[1]}, w.sigma, distance[0], distance[1], w.error};
  }
  [[nodiscard]] Window<Real> right(const Window<Real>& w) const {
    const Real l = length[2];
    if (w.beam.is_parallel()) [[unlikely]]
      return {{-x[2], h[2], l - at[3], l - at[2]},
              distance[2] + (l - at[2]) * x[2],
              distance[3],
              distance[2],
              w.error};
    return {{l - x[2], h[2], l - at[3], l - at[2]}, w.sigma, distance[3], distance[2], w.error};
  }

 private:
  static constexpr int sides[16] = {3, 2, 2, 2, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};

  [[gnu::noinline]] void go_parallel(const EnteredTriangle<Real>& t, const Window<Real>& w) {
    const Beam<Real> to_left = t.seen_left(w.beam), to_right = t.seen_right(w.beam);
    x = L(to_left.x, to_left.x, to_right.x, to_right.x);
    h = L(to_left.h, to_left.h, to_right.h, to_right.h);
    length = L(t.left, t.left, t.right, t.right);
    const auto reached = [](Real place, Real all) {
      return place < all * (1 - rounding) ? place : all;
    };
    at = L(reached(t.onto_left(w.beam, w.beam.begin), t.left),
           reached(t.onto_left(w.beam, w.beam.end), t.left),
           reached(t.onto_right(w.beam, w.beam.end), t.right),
           reached(t.onto_right(w.beam, w.beam.begin), t.right));
    measure(t, w);
  }
};

}  // namespace plexway::detail::windows

#pragma GCC diagnostic pop
