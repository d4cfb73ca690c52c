#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include <plexway/surface/detail/triangle_record.hpp>

namespace plexway::detail::windows {

/// A source seen from an edge: at (x, -h), `begin` to `end` of the edge in its light. Or, where h
/// is below 0, the light of a straight line, which is parallel: it travels by (x, -h), a unit
/// vector. Turning the frame does the same to both.
template <class Real>
struct Beam {
  Real x, h, begin, end;

  [[nodiscard]] bool is_parallel() const { return h < 0; }
  /// The same measured from the edge's other end.
  [[nodiscard]] Beam mirrored(Real length) const {
    return {is_parallel() ? -x : length - x, h, length - end, length - begin};
  }
};

/// Parallel light that goes by (along, off), turned and by rounding no more a unit vector: as a
/// beam has it. Light that runs along the edge is kept from it by a rounding error.
template <class Real>
[[nodiscard]] Beam<Real> parallel(Real along, Real off, Real begin, Real end) {
  const Real size = std::sqrt(along * along + off * off);
  return {along / size, -std::max(off / size, std::numeric_limits<Real>::epsilon()), begin, end};
}

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
    const bool from_b = right < left;
    const std::size_t nearer = from_b ? after : in;
    const Real shorter = std::min(left, right);
    constexpr Real origin[2] = {0, 1}, way[2] = {1, -1};
    apex_x = origin[from_b] * width + way[from_b] * (shorter * t.cosine[nearer]);
    apex_h = shorter * t.sine(nearer);
  }

  /// From P back to the source; to (x, -h).
  [[nodiscard, gnu::always_inline]] Towards<Real> towards(const Beam<Real>& beam) const {
    return beam.is_parallel() ? back(beam.x, -beam.h) : towards(beam.x, beam.h);
  }
  [[nodiscard, gnu::always_inline]] Towards<Real> towards(Real x, Real h) const {
    return back(apex_x - x, apex_h + h);
  }

  /// The source as the left edge sees it, measured from A, or the right edge, from B; all of the
  /// edge in its light.
  [[nodiscard, gnu::always_inline]] Beam<Real> seen_left(const Beam<Real>& beam) const {
    return seen(beam.x, beam, cos_a, sin_a, left);
  }
  [[nodiscard, gnu::always_inline]] Beam<Real> seen_right(const Beam<Real>& beam) const {
    return seen(beam.is_parallel() ? -beam.x : width - beam.x, beam, cos_b, sin_b, right);
  }
  /// What parallel light that has come as far as `sigma` at A has at B.
  [[nodiscard, gnu::always_inline]] Real sigma_at_b(const Beam<Real>& beam, Real sigma) const {
    return beam.is_parallel() ? sigma + width * beam.x : sigma;
  }

  /// Where the ray through a point of AB meets the left edge, from A; in [0, left].
  [[nodiscard, gnu::always_inline]] Real onto_left(const Beam<Real>& beam, Real point) const {
    return onto(point, beam.is_parallel() ? beam.x : beam.x - point, beam.h, cos_a, sin_a, left);
  }
  /// Likewise the right edge, from B.
  [[nodiscard, gnu::always_inline]] Real onto_right(const Beam<Real>& beam, Real point) const {
    return onto(width - point, beam.is_parallel() ? -beam.x : point - beam.x, beam.h, cos_b, sin_b,
                right);
  }

 private:
  /// Back along a ray to P.
  [[nodiscard, gnu::always_inline]] Towards<Real> back(Real dx, Real dy) const {
    return {apex_h * dy + apex_x * dx, apex_x * dy - apex_h * dx};
  }
  static Beam<Real> seen(Real x, const Beam<Real>& beam, Real cosine, Real sine, Real length) {
    const Real along = cosine * x - sine * beam.h, below = sine * x + cosine * beam.h;
    if (beam.is_parallel()) return parallel(along, -below, Real(0), length);
    return {along, std::max(below, Real(0)), 0, length};
  }
  /// `behind`: how far S lies behind the point, seen from the pivot; of parallel light its
  /// direction.
  static Real onto(Real point, Real behind, Real h, Real cosine, Real sine, Real length) {
    const Real below = sine * behind + cosine * h;
    const Real t = point * h / below;
    return (h < 0 ? below < 0 : below > 0) && t < length ? t : length;
  }
};

/// The halfedge that an Across leads to, 4 f + i.
[[nodiscard]] constexpr Index halfedge_of(Index across) {
  return across >> Across::face_shift << 2 | (across & Across::edge_mask);
}

/// All triangles on the other side of edge `edge` of f, one or several: calls
/// over(across, turned). `across` leads to the triangle's own edge; `turned` says that this runs
/// the same way as the edge left, so that what was measured from the one's second corner, which is
/// otherwise the other's first, must be mirrored. The edge is no boundary.
template <class Real, class Over>
void cross_edge(std::span<const TriangleRecord<Real>> triangles, Index f, std::size_t edge,
                const Over& over) {
  Index across = triangles[f].across[edge];
  bool turned = (across & Across::flip) != 0;
  if (!(across & Across::fan)) {
    over(across, turned);
    return;
  }
  // All the way around the edge; each turn is told from the one before.
  for (;;) {
    const Index g = across >> Across::face_shift, k = across & Across::edge_mask;
    if (g == f && k == edge) return;
    over(across, turned);
    across = triangles[g].across[k];
    turned ^= !(across & Across::flip);
  }
}

/// Up to where on an edge its first vertex serves as well as a source at (x, -h) from that vertex:
/// x0 = 0, the vertex `c` farther away than the source's own sigma. Parallel light as a beam has
/// it. +inf where the vertex serves all of the edge; anything below 0, or NaN, where it serves
/// none.
///
/// From c + b <= |S - b|, squared: no root is taken. (Solving for b where |S - b| - b, which falls
/// with b, comes down to c.)
template <class Real>
[[gnu::always_inline]] inline Real served_from_end(Real x, Real h, Real c) {
  if (h < 0) [[unlikely]]  // parallel light, that much nearer than the vertex at the edge's start
    return -c / (1 - x);
  const Real sum = c + x, gain = x * x + h * h - c * c;
  if (!(sum > 0) || (c < 0 && gain < 0)) return std::numeric_limits<Real>::infinity();
  return gain / (2 * sum);
}

}  // namespace plexway::detail::windows
