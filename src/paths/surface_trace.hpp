#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include <plexway/paths/path.hpp>
#include <plexway/source/point_source.hpp>
#include <plexway/surface/triangle_mesh.hpp>

#include "fields/surface_labels.hpp"
#include "paths/solved.hpp"
#include "paths/strip.hpp"
#include "paths/strip_paths.hpp"
#include "paths/surface_shape.hpp"

namespace plexway {

/// Barycentric coordinates by the corners inside: a triangle that runs backwards there has them in
/// the order 0 2 1.
inline std::array<double, 3> inside(const std::array<double, 4>& b, bool turned) {
  return {b[0], turned ? b[2] : b[1], turned ? b[1] : b[2]};
}

/// Paths on a solved surface.
///
/// A way back is a strip of triangles, or several where it passes a vertex that fans only touch in.
/// After windows it is found by them, from triangle to triangle. Else in three ways, each where the
/// one before leads nowhere:
///  * by sight: straight towards the last bend that the label knows, whatever labels the triangles
///    between have by now (large ones mostly have better ones for their own centre), and on from
///    that vertex. Distances of the vertices fall, so it ends.
///  * over the edges that labels came in by. No triangle is entered twice, so it ends.
///  * down over the vertices' distances, along edges; and where all that is 1 % longer than the
///  field
///    promises, the shortest way along edges, which the path is then no longer than.
template <class Real>
class SurfaceTrace {
 public:
  SurfaceTrace(const TriangleMesh<Real>& mesh, const Solved<Real>& solved);

  /// The shortest of the ways that the labels around the point lead. No source where none does.
  [[nodiscard]] PulledWay find(const PointSource& point, const TraceOptions& options) const;
  /// The same as a path.
  [[nodiscard]] Path trace(const PointSource& point, const TraceOptions& options) const {
    const PulledWay way = find(point, options);
    return way.source == none ? Path() : strips_.to_path(way, solved_.drawn);
  }

 private:
  [[nodiscard]] std::optional<std::array<double, 3>> source_in(Index f, Index number) const;
  bool see(const Strip& begin, StripWay& way) const;
  enum class Seen { vertex, source, nothing };
  Seen look(Strip& leg, Heading& at, Index number) const;
  bool follow(Strip leg, StripWay& way) const;
  [[nodiscard]] std::optional<Crossing> back_from(Index f) const;
  /// At a vertex where fans meet, a corner from where a path leads on.
  [[nodiscard]] Index beyond_pinch(Index vertex) const;

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
};

}  // namespace plexway
