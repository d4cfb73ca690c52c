#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <plexway/common/ids.hpp>
#include <plexway/source/point_source.hpp>
#include <plexway/surface/triangle_mesh.hpp>

#include "labels/curve_seeds.hpp"
#include "windows/entered_triangle.hpp"
#include "windows/merge.hpp"

namespace plexway::detail::windows {
/// Parallel light that a straight line sends over an edge of a triangle. Numbers and unit inside.
struct LineLight {
  Index face, edge;
  bool into;          ///< from the edge into the triangle; else out of it, over the edge
  Beam<double> beam;  ///< measured from the edge's first corner
  double sigma;       ///< at that corner, as a window has it
  Index number;       ///< of the source

  [[nodiscard]] Window<double> window() const {
    Window<double> w = {beam, sigma, 0, 0, 0};
    w.begin_at(beam.begin);
    w.end_at(beam.end);
    return w;
  }
};

/// A corner of a triangle that a line passes.
struct CornerBesideLine {
  Index face, corner;
  double distance;
  Towards<double> back;  ///< to the nearest point of the line
  Index number;
};

/// What windows from curves and triangles start with. Light of a straight piece is parallel within
/// the strip over it, to both sides; strips of pieces that go straight on lie beside each other.
/// Ends and bends are points.
struct CurveLights {
  std::vector<LineLight> lights;
  std::vector<CornerBesideLine> corners;

  /// A curve as propagation number `number`; its offset in the caller's unit.
  template <class Real>
  void add_curve(const TriangleMesh<Real>& mesh, std::span<const CurvePiece> pieces, double offset,
                 Index number);
  /// All of one triangle, by its caller's number: out over its edges.
  template <class Real>
  void add_face(const TriangleMesh<Real>& mesh, Index face, double offset, Index number);
};

/// What windows start from.
struct WindowSources {
  std::span<const PointSource> points;
  /// Of each point, where points alone do not count from 0.
  std::span<const Index> numbers = {};
  std::span<const LineLight> lights = {};
  std::span<const CornerBesideLine> corners = {};
  bool labels = false;  ///< is there more than one number?

  WindowSources() = default;
  WindowSources(std::span<const PointSource> only_points)
      : points(only_points), labels(only_points.size() > 1) {}

  [[nodiscard]] Index number(std::size_t point) const {
    return numbers.empty() ? static_cast<Index>(point) : numbers[point];
  }
  [[nodiscard]] bool only_points() const { return lights.empty() && corners.empty(); }
};

}  // namespace plexway::detail::windows
