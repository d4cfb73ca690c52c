#pragma once

#include <array>
#include <optional>
#include <vector>

#include <plexway/paths/path.hpp>
#include <plexway/source/point_source.hpp>
#include <plexway/surface/triangle_mesh.hpp>

#include "fields/surface_labels.hpp"
#include "paths/solved.hpp"
#include "paths/strip.hpp"
#include "paths/strip_paths.hpp"
#include "paths/surface_shape.hpp"

namespace plexway::detail {

/// Barycentric coordinates by the corners inside: a triangle that runs backwards there has them in
/// the order 0 2 1.
inline std::array<double, 3> inside(const std::array<double, 4>& b, bool turned) {
  return {b[0], turned ? b[2] : b[1], turned ? b[1] : b[2]};
}

/// Paths on a solved surface.
///
/// A way back is a strip of triangles, or several where it passes a vertex that fans only touch in.
/// After windows it is found by them, from triangle to triangle. Else down over the vertices'
/// distances, along edges; and where that, pulled straight, is 1 % longer than the field promises,
/// the shortest way along edges, which the path is then no longer than. From there windows look for
/// the shortest of all.
template <class Real>
class SurfaceTrace {
 public:
  SurfaceTrace(const TriangleMesh<Real>& mesh, const Solved<Real>& solved);

  /// The shortest way from a point. No source where none leads.
  [[nodiscard]] PulledWay find(const PointSource& point, const TraceOptions& options) const;
  /// The same as a path.
  [[nodiscard]] Path trace(const PointSource& point, const TraceOptions& options) const {
    const PulledWay way = find(point, options);
    return way.source == none ? Path() : strips_.to_path(way, solved_.drawn);
  }

 private:
  /// Of a vertex (inside). A search leaves labels only.
  [[nodiscard]] double distance(Index v) const;
  /// Of a point, by a corner: what the field promises.
  [[nodiscard]] double promise(Index f, const std::array<double, 3>& b) const;
  bool follow_windows(Index f, std::array<double, 3> at, StripWay& way) const;
  bool descend(Index f, const std::array<double, 3>& b, bool blindly, StripWay& way) const;
  [[nodiscard]] std::optional<Heading> side(Index v, Index w) const;

  void search_windows(Index f, const std::array<double, 3>& b, const TraceOptions& options,
                      PulledWay& best) const;

  const TriangleMesh<Real>& mesh_;
  const Solved<Real>& solved_;
  StripPaths<Real> strips_;
  const SurfaceShape<Real>& shape_;
  SurfaceLabels<Real> labels_;
  mutable std::vector<Index> corners_;  // around one vertex
};

}  // namespace plexway::detail
