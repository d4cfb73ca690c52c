#pragma once

#include <cmath>
#include <cstddef>

#include <plexway/complex/detail/triangle_record.hpp>

namespace plexway::windows {

/// A source seen from an edge: at (x, -h), `begin` to `end` of the edge in its light.
template <class Real>
struct Beam {
  Real x, h, begin, end;

  /// The same measured from the edge's other end.
  [[nodiscard]] Beam mirrored(Real length) const {
    return {length - x, h, length - end, length - begin};
  }
};

/// A direction in a corner: along the edge that starts there, and off it. Of any length.
template <class Real>
struct Towards {
  Real along, off;
};

/// A triangle as light sees it that comes in over edge AB; P is its apex. Light leaves over the
/// left edge AP or the right edge BP. Left is measured from A and right from B, so that each is the
/// mirror image of the other.
template <class Real>
struct EnteredTriangle {
  std::size_t in, before, after;  ///< AB, and its neighbours AP and BP
  Index a, b, p;                  ///< vertices
  Real width, left, right;        ///< lengths of AB, AP, BP
  Real cos_a, sin_a, cos_b, sin_b;
  Real apex_x, apex_h;  ///< P from A, along AB and off it

  EnteredTriangle() = default;
  template <class Stored>
  EnteredTriangle(const TriangleRecord<Stored>& t, std::size_t edge) {
    enter(t, edge);
  }

  template <class Stored>
  [[gnu::always_inline]] void enter(const TriangleRecord<Stored>& t, std::size_t edge) {
    in = edge;
    before = edge_before(edge);
    after = edge_after(edge);
    a = t.corner[in];
    b = t.corner[after];
    p = t.corner[before];
    width = t.length[in];
    left = t.length[before];
    right = t.length[after];
    cos_a = t.cosine[in];
    sin_a = t.sine(in);
    cos_b = t.cosine[after];
    sin_b = t.sine(after);
    // From the nearer end: thin triangles keep their short edge that way.
    const bool from_a = left <= right;
    apex_x = from_a ? left * cos_a : width - right * cos_b;
    apex_h = from_a ? left * sin_a : right * sin_b;
  }

  /// Where the ray from S to P crosses AB.
  [[nodiscard, gnu::always_inline]] Real foot(Real x, Real h) const {
    return x + (apex_x - x) * (h / (h + apex_h));
  }

  /// From P back to (x, -h).
  [[nodiscard, gnu::always_inline]] Towards<Real> towards(Real x, Real h) const {
    const Real dx = apex_x - x, dy = apex_h + h;
    return {apex_h * dy + apex_x * dx, apex_x * dy - apex_h * dx};
  }

  /// S as the left edge sees it, measured from A; the right edge's is that of `width - x` and B.
  [[nodiscard, gnu::always_inline]] Beam<Real> seen_left(Real x, Real h) const {
    return {cos_a * x - sin_a * h, sin_a * x + cos_a * h, 0, left};
  }
  [[nodiscard, gnu::always_inline]] Beam<Real> seen_right(Real x, Real h) const {
    const Real u = width - x;
    return {cos_b * u - sin_b * h, sin_b * u + cos_b * h, 0, right};
  }

  /// Where the ray from S through a point of AB meets the left edge, from A; in [0, left].
  [[nodiscard, gnu::always_inline]] Real onto_left(Real x, Real h, Real point) const {
    return onto(point, x - point, h, cos_a, sin_a, left);
  }
  /// Likewise the right edge, from B.
  [[nodiscard, gnu::always_inline]] Real onto_right(Real x, Real h, Real point) const {
    return onto(width - point, point - x, h, cos_b, sin_b, right);
  }

 private:
  /// `back`: how far S lies behind the point, seen from the pivot.
  static Real onto(Real point, Real back, Real h, Real cosine, Real sine, Real length) {
    const Real below = sine * back + cosine * h;
    const Real t = point * h / below;
    return below > 0 && t < length ? t : length;
  }
};

}  // namespace plexway::windows
