#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <plexway/paths/path.hpp>
#include <plexway/source/point_source.hpp>
#include <plexway/surface/intrinsic_delaunay.hpp>
#include <plexway/surface/triangle_mesh.hpp>

#include "paths/strip.hpp"
#include "paths/surface_shape.hpp"

namespace plexway::detail {

/// A way from a point to a source: strips that meet in vertices.
struct StripWay {
  std::vector<Strip> legs;
  Index source = none;
};

/// The same, pulled.
struct PulledWay {
  std::vector<Strip> legs;
  std::vector<PulledStrip> pulled;
  double length = 0;
  Index source = none;
  std::size_t windows = 0;  ///< looked at
  bool capped = false;      ///< and there were more
};

/// A straight line in a triangle, numbers inside.
struct StraightPiece {
  Index face;
  std::array<double, 3> from, to;
};

/// A triangle, a corner of it, and a direction there, as an angle from the edge of that number.
struct Heading {
  Index face;
  std::size_t corner;
  double angle;
};

/// What ways of strips become paths with.
template <class Real>
class StripPaths {
 public:
  using Position = std::array<double, 3>;

  /// Lengths are those between `positions`, one a vertex in the caller's order, or if there are
  /// none, the mesh's. `outer` leads from the vertices inside to the caller's.
  StripPaths(const TriangleMesh<Real>& mesh, std::span<const Position> positions,
             std::span<const Index> outer)
      : mesh_(mesh),
        positions_(positions),
        outer_(outer),
        shape_(mesh, positions, outer),
        straightener_(mesh_, shape_) {}
  StripPaths(const StripPaths&) = delete;
  StripPaths& operator=(const StripPaths&) = delete;

  [[nodiscard]] const SurfaceShape<Real>& shape() const { return shape_; }

  /// Turns at a vertex from one direction to another; where no triangles lead around, one leg ends
  /// and the next begins.
  void add(StripWay& way, Strip& leg, Heading& at, const Heading& to) const;
  /// One way of strips that meet in vertices.
  [[nodiscard]] StripWay joined(std::vector<Strip> strips, Index source) const;
  /// Locally shortest.
  [[nodiscard]] PulledWay straighten(StripWay way) const;
  /// Its straight lines, each in a triangle, those of no length left out; never empty.
  [[nodiscard]] static std::vector<StraightPiece> pieces(const PulledWay& way);
  /// `drawn` are the positions of a surface with lengths of its own.
  [[nodiscard]] Path to_path(const PulledWay& way, std::span<const Position> drawn = {}) const;

 private:
  const TriangleMesh<Real>& mesh_;
  std::span<const Position> positions_;
  std::span<const Index> outer_;
  SurfaceShape<Real> shape_;
  Straightener<Real> straightener_;
};

extern template class StripPaths<float>;
extern template class StripPaths<double>;

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
