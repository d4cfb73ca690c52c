#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include <plexway/apps/path.hpp>
#include <plexway/complex/triangle_mesh.hpp>
#include <plexway/source/point_source.hpp>

#include "apps/solved.hpp"
#include "apps/straighten.hpp"
#include "apps/strip.hpp"
#include "apps/surface_labels.hpp"
#include "apps/surface_shape.hpp"

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

  /// The shortest of the ways that the labels around the point lead. Empty where none does.
  [[nodiscard]] Path trace(const PointSource& point, const TraceOptions& options) const;

 private:
  /// A way from a point to a source: strips that meet in vertices.
  struct Way {
    std::vector<Strip> legs;
    Index source = none;
    std::vector<Index> bends = {};  ///< vertices, as far as they are known before it is pulled
  };
  /// A triangle, a corner of it, and a direction there, as an angle from the edge of that number.
  struct Heading {
    Index face;
    std::size_t corner;
    double angle;
  };

  [[nodiscard]] std::optional<std::array<double, 3>> source_in(Index f, Index number) const;
  bool see(const Strip& begin, Way& way) const;
  enum class Seen { vertex, source, nothing };
  Seen look(Strip& leg, Heading& at, Index number) const;
  bool follow(Strip leg, Way& way) const;
  [[nodiscard]] std::optional<Crossing> back_from(Index f) const;
  /// At a vertex where fans meet, a corner from where a path leads on.
  [[nodiscard]] Index beyond_pinch(Index vertex) const;

  bool follow_windows(Index f, std::array<double, 3> at, Way& way) const;
  bool descend(Index f, const std::array<double, 3>& b, bool blindly, Way& way) const;
  [[nodiscard]] std::optional<Heading> side(Index v, Index w) const;
  void add(Way& way, Strip& leg, Heading& at, const Heading& to) const;

  struct Traced;
  void search_windows(Index f, const std::array<double, 3>& b, const TraceOptions& options,
                      Traced& best) const;
  [[nodiscard]] Way joined(std::vector<Strip> strips, Index source) const;

  struct Traced {
    std::vector<Strip> legs;
    std::vector<PulledStrip> pulled;
    double length = 0;
    Index source = none;
    std::size_t windows = 0;  // looked at
    bool capped = false;      // and there were more
  };
  [[nodiscard]] Traced straighten(Way way) const;
  [[nodiscard]] Path to_path(const Traced& traced) const;

  const TriangleMesh<Real>& mesh_;
  const Solved<Real>& solved_;
  SurfaceShape<Real> shape_;
  SurfaceLabels<Real> labels_;
  Straightener<Real> straightener_;
};

}  // namespace plexway
