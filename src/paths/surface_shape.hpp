#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include <plexway/solid/detail/tet_record.hpp>
#include <plexway/surface/triangle_mesh.hpp>

#include "complexes/common/geometry.hpp"

namespace plexway::detail {

/// The triangles of a surface in double, in the caller's unit: from coordinates where there are
/// some, else from the lengths and angles that propagation uses. Triangles and corners have the
/// numbers inside.
template <class Real>
class SurfaceShape {
 public:
  using Position = std::array<double, 3>;

  /// `outer` leads from the vertices inside to the caller's.
  SurfaceShape(const TriangleMesh<Real>& mesh, std::span<const Position> positions,
               std::span<const Index> outer)
      : triangles_(mesh.triangles().data()),
        sentinel_(static_cast<Index>(mesh.face_count())),
        unit_(mesh.unit()),
        positions_(positions),
        outer_(outer) {}

  [[nodiscard]] bool embedded() const { return !positions_.empty(); }
  [[nodiscard]] Index sentinel() const { return sentinel_; }
  [[nodiscard]] const TriangleRecord<Real>& triangle(Index f) const { return triangles_[f]; }

  /// Corner i of f. Only if embedded.
  [[nodiscard]] Vector3<double> corner(Index f, std::size_t i) const {
    const Position& p = positions_[outer_[triangles_[f].corner[i]]];
    return {p[0], p[1], p[2]};
  }

  [[nodiscard]] double length(Index f, std::size_t edge) const {
    if (!embedded()) return static_cast<double>(triangles_[f].length[edge]) * unit_;
    return norm(corner(f, edge_after(edge)) - corner(f, edge));
  }

  /// The apex over an edge: x along it from its first corner, y off it.
  [[nodiscard]] Vector2 apex(Index f, std::size_t edge) const {
    const Vector2 recorded = {static_cast<double>(triangles_[f].apex_x(edge)) * unit_,
                              static_cast<double>(triangles_[f].apex_h(edge)) * unit_};
    if (!embedded()) return recorded;
    const Vector3<double> a = corner(f, edge);
    const Vector3<double> e = corner(f, edge_after(edge)) - a, p = corner(f, edge_before(edge)) - a;
    const double l = norm(e);
    if (!(l > 0)) return recorded;
    return {dot(e, p) / l, norm(cross(e, p)) / l};
  }

  /// At corner i, as the propagation has it: without area, that of the limit.
  [[nodiscard]] double angle(Index f, std::size_t i) const {
    return std::atan2(static_cast<double>(triangles_[f].sine(i)),
                      static_cast<double>(triangles_[f].cosine[i]));
  }

  /// A point of f in a plane of its own: corner 0 at the origin, corner 1 on the x axis.
  [[nodiscard]] Vector2 in_plane(Index f, const std::array<double, 3>& b) const {
    return Vector2{b[1] * length(f, 0), 0} + b[2] * apex(f, 0);
  }

  [[nodiscard]] Vector3<double> place(Index f, const std::array<double, 3>& b) const {
    return b[0] * corner(f, 0) + b[1] * corner(f, 1) + b[2] * corner(f, 2);
  }

  /// Between two points of f.
  [[nodiscard]] double distance(Index f, const std::array<double, 3>& a,
                                const std::array<double, 3>& b) const {
    if (embedded()) return norm(place(f, b) - place(f, a));
    return norm(in_plane(f, b) - in_plane(f, a));
  }

  /// Angle at corner i of f from its edge i to a point of f, in [0, angle(f, i)].
  [[nodiscard]] double angle_to(Index f, std::size_t i, const std::array<double, 3>& b) const {
    // From corner i, coordinates along edge i and of the corner before are what counts.
    const Vector2 p = Vector2{b[edge_after(i)] * length(f, i), 0} + b[edge_before(i)] * apex(f, i);
    return std::clamp(std::atan2(p.y, p.x), 0., angle(f, i));
  }

 private:
  const TriangleRecord<Real>* triangles_;
  Index sentinel_;
  double unit_;
  std::span<const Position> positions_;
  std::span<const Index> outer_;
};

}  // namespace plexway::detail
