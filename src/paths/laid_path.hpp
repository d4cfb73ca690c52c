#pragma once

#include <array>
#include <span>
#include <vector>

#include <plexway/paths/path.hpp>
#include <plexway/source/point_source.hpp>
#include <plexway/surface/intrinsic_delaunay.hpp>
#include <plexway/surface/triangle_mesh.hpp>

#include "paths/strip_paths.hpp"

namespace plexway {

/// A straight line in a triangle of `mesh`, which is delaunay.mesh(), as lines in those of the
/// input, in order. Numbers inside.
template <class Real>
[[nodiscard]] std::vector<StraightPiece> laid_on(const TriangleMesh<Real>& input,
                                                 const IntrinsicDelaunay& delaunay,
                                                 const TriangleMesh<Real>& mesh,
                                                 const StraightPiece& line);

/// Lays paths of an intrinsic Delaunay triangulation on the triangles of its input.
///
/// Each straight line in one of its triangles is a row of lines in those of the input, and they a
/// strip. That is pulled in the input's own lengths: so the path is as straight as these allow, and
/// crosses each edge once, though the triangulation has its lengths by rounding alone.
template <class Real>
class LaidPaths {
 public:
  /// `positions` and `outer` are those of the input, as StripPaths takes them. Refers to all.
  LaidPaths(const TriangleMesh<Real>& input, const IntrinsicDelaunay& delaunay,
            std::span<const std::array<double, 3>> positions, std::span<const Index> outer)
      : input_(input), delaunay_(delaunay), strips_(input, positions, outer) {}

  /// `way` is one of `mesh`, which is delaunay.mesh(), between two points of the input.
  [[nodiscard]] Path lay(const TriangleMesh<Real>& mesh, const PulledWay& way,
                         const PointSource& from, const PointSource& to) const;

 private:
  void go_on(std::vector<Strip>& strips, Index face) const;

  const TriangleMesh<Real>& input_;
  const IntrinsicDelaunay& delaunay_;
  StripPaths<Real> strips_;
};

extern template class LaidPaths<float>;
extern template class LaidPaths<double>;

}  // namespace plexway
