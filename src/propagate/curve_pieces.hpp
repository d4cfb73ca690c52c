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
  std::size_t end;   ///< the point of the curve that `to` is

  [[nodiscard]] double length() const { return std::abs(to - from); }
  [[nodiscard]] Plane direction() const { return (to - from) / length(); }
};

inline double cross(const Plane& a, const Plane& b) { return (std::conj(a) * b).imag(); }
inline double dot(const Plane& a, const Plane& b) { return (std::conj(a) * b).real(); }

/// A curve cut into pieces. Throws UsageError where two points in a row share no triangle.
std::vector<CurvePiece> cut_curve(const TriangleMesh<double>& mesh,
                                  std::span<const PointSource> points);

/// Which points of a curve, beside its light, count as sources of their own: its ends, those at
/// vertices, and those where it bends, for beyond a bend neither piece lights anything.
std::vector<bool> shows_as_point(const TriangleMesh<double>& mesh,
                                 std::span<const PointSource> points,
                                 std::span<const CurvePiece> pieces);

/// Does the curve run straight on from one piece to the next, as seen from its left (side 0) or
/// right (side 1)? That is: has it pi of surface there.
bool runs_straight(const TriangleMesh<double>& mesh, const CurvePiece& piece,
                   const CurvePiece& next, int side);

/// Where a piece ends in its triangle: at corner i (i), inside edge e (3 + e), or inside (6).
std::size_t place_of(const TriangleRecord<double>& t, const Plane& p);

}  // namespace plexway
