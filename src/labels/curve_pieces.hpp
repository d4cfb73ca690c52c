#pragma once

#include <algorithm>
#include <array>
#include <complex>
#include <cstddef>
#include <span>
#include <vector>

#include <plexway/source/point_source.hpp>
#include <plexway/surface/triangle_mesh.hpp>

namespace plexway::detail {

/// A point of the plane of a triangle: corner 0 at the origin, edge 0 on the real axis, the rest
/// above it.
using Plane = std::complex<double>;

template <class Real>
std::array<Plane, 3> corners_of(const TriangleRecord<Real>& t) {
  const double second = static_cast<double>(t.length[2]);
  return {
      0, static_cast<double>(t.length[0]),
      Plane{second * static_cast<double>(t.cosine[0]), second * static_cast<double>(t.sine(0))}};
}

inline double cross(const Plane& a, const Plane& b) { return (std::conj(a) * b).imag(); }
inline double dot(const Plane& a, const Plane& b) { return (std::conj(a) * b).real(); }

/// A straight piece of a curve, in one triangle.
struct CurvePiece {
  Index face;
  std::size_t edge;  ///< along this edge, or 3
  Plane from, to;    ///< in the triangle's plane
  std::size_t end;   ///< the point of the curve that `to` is

  [[nodiscard]] double length() const { return std::abs(to - from); }
  [[nodiscard]] Plane direction() const { return (to - from) / length(); }
};

/// The point of a piece that is nearest to another one of its plane.
inline Plane nearest_point(const CurvePiece& piece, const Plane& p) {
  const double s = dot(piece.direction(), p - piece.from);
  return piece.from + std::clamp(s, 0., piece.length()) * piece.direction();
}

/// A curve cut into pieces. Throws UsageError where two points in a row share no triangle.
template <class Real>
std::vector<CurvePiece> cut_curve(const TriangleMesh<Real>& mesh,
                                  std::span<const PointSource> points);

/// Which points of a curve, beside its light, count as sources of their own: its ends, those at
/// vertices, and those where it bends, for beyond a bend neither piece lights anything.
template <class Real>
std::vector<bool> shows_as_point(const TriangleMesh<Real>& mesh,
                                 std::span<const PointSource> points,
                                 std::span<const CurvePiece> pieces);

/// Does the curve run straight on from one piece to the next, as seen from its left (side 0) or
/// right (side 1)? That is: has it pi of surface there.
template <class Real>
bool runs_straight(const TriangleMesh<Real>& mesh, const CurvePiece& piece, const CurvePiece& next,
                   int side);

/// Where a piece ends in its triangle: at corner i (i), inside edge e (3 + e), or inside (6).
template <class Real>
std::size_t place_of(const TriangleRecord<Real>& t, const Plane& p);

}  // namespace plexway::detail
