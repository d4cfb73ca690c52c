#pragma once

#include <array>
#include <span>
#include <vector>

#include <plexway/paths/path.hpp>
#include <plexway/source/point_source.hpp>
#include <plexway/surface/intrinsic_delaunay.hpp>
#include <plexway/surface/triangle_mesh.hpp>

#include "paths/strip_paths.hpp"

namespace plexway::detail {

/// From the caller's corners to those inside of a triangle that may run the other way, and back.
inline std::array<double, 3> turned(const std::array<double, 3>& b, bool other_way) {
  return {b[0], b[other_way ? 2 : 1], b[other_way ? 1 : 2]};
}

/// A straight line in a triangle of `mesh`, which is delaunay.mesh(), as lines in those of the
/// input, in order. Numbers inside.
template <class Real>
[[nodiscard]] std::vector<StraightPiece> laid_on(const TriangleMesh<Real>& input,
                                                 const IntrinsicDelaunay& delaunay,
                                                 const TriangleMesh<Real>& mesh,
                                                 const StraightPiece& line);

/// Makes a strip of straight lines in triangles, one after the other, and pulls it straight: what
/// lines of an intrinsic Delaunay triangulation become in the triangles of its input, and any path
/// that is given. So the path is as straight as the surface's own lengths allow, and crosses each
/// edge once, though the lines may have been off by rounding.
template <class Real>
class LaidPaths {
 public:
  /// `positions` and `outer` as StripPaths takes them. Refers to all.
  LaidPaths(const TriangleMesh<Real>& mesh, std::span<const std::array<double, 3>> positions,
            std::span<const Index> outer)
      : mesh_(mesh), strips_(mesh, positions, outer) {}

  /// Lines by numbers inside, from one point to another by the caller's.
  [[nodiscard]] Path lay(std::span<const StraightPiece> lines, const PointSource& from,
                         const PointSource& to) const;

 private:
  void go_on(std::vector<Strip>& strips, Index face) const;

  const TriangleMesh<Real>& mesh_;
  StripPaths<Real> strips_;
};

extern template class LaidPaths<float>;
extern template class LaidPaths<double>;

}  // namespace plexway::detail
