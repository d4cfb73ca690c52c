#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <plexway/complex/triangle_mesh.hpp>
#include <plexway/source/point_source.hpp>

#include "propagate/curve_seeds.hpp"

namespace plexway {

/// A straight piece of a curve, in one triangle.
struct CurvePiece {
  Index face;
  std::size_t edge;  ///< along this edge, or 3
  Plane from, to;    ///< in the triangle's plane

  [[nodiscard]] double length() const { return std::abs(to - from); }
  [[nodiscard]] Plane direction() const { return (to - from) / length(); }
};

inline double cross(const Plane& a, const Plane& b) { return (std::conj(a) * b).imag(); }
inline double dot(const Plane& a, const Plane& b) { return (std::conj(a) * b).real(); }

template <class Real>
std::array<Plane, 3> corners_of(const TriangleRecord<Real>& t) {
  return {0, static_cast<double>(t.length[0]),
          Plane{static_cast<double>(t.apex_x(0)), static_cast<double>(t.apex_h(0))}};
}

/// A curve cut into pieces. Throws UsageError where two points in a row share no triangle.
template <class Real>
std::vector<CurvePiece> cut_curve(const TriangleMesh<Real>& mesh,
                                  std::span<const PointSource> points);

/// Does the curve run straight on from one piece to the next, as seen from its left (side 0) or
/// right (side 1)? That is: has it pi of surface there.
template <class Real>
bool runs_straight(const TriangleMesh<Real>& mesh, const CurvePiece& piece, const CurvePiece& next,
                   int side);

/// Where a piece ends in its triangle: at corner i (i), inside edge e (3 + e), or inside (6).
template <class Real>
std::size_t place_of(const TriangleRecord<Real>& t, const Plane& p);

}  // namespace plexway
