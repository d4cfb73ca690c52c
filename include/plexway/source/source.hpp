#pragma once

#include <variant>
#include <vector>

#include <plexway/source/point_source.hpp>

namespace plexway {

/// Vertices, all one source: the distance from the nearest of them. Caller's numbers.
struct VertexSource {
  /// At least one.
  std::vector<Index> vertices;
  /// What the field starts with at each, >= 0; empty: `offset` for all. So a field goes on from
  /// another's values.
  std::vector<double> offsets = {};
  double offset = 0;  ///< added to each, >= 0
};

/// A circle or a ball: all points whose distance from `centre` is `radius`. The distance of a point
/// is |d - radius|, d being its distance from the centre. Outside that is the distance to the rim;
/// inside as long as every shortest path from the centre can be extended to the rim.
struct BallSource {
  PointSource centre;  ///< its own offset does not count
  double radius = 0;   ///< >= 0
  double offset = 0;   ///< >= 0
};

/// A segment or a polyline on a surface or a wireframe: from point to point, straight within
/// simplices. Each point must lie in one simplex with the next; offsets of points do not count.
struct CurveSource {
  /// At least one. One that names nothing, PointSource{}, ends a line; the next begins another.
  std::vector<PointSource> points;
  double offset = 0;  ///< >= 0
};

/// All of one simplex: a triangle of a surface, an edge of a wireframe. Inside it the distance is
/// 0.
struct SimplexSource {
  /// The caller's number.
  Index simplex = none;
  double offset = 0;  ///< >= 0
};

/// Is it the end of a line of a curve?
inline bool names_nothing(const PointSource& point) {
  return point.vertex == none && point.simplex == none;
}

/// A source of a field.
///
/// Any source answers two questions: how far are the vertices of a simplex from it, and is it seen
/// through a hinge whole, clipped or not at all. A point is a virtual source. A segment is a
/// virtual source far behind it, so far that its light is parallel, with its two ends as limits of
/// that light (labels/surface/saddle_label.hpp): seen from beyond an end the path bends there. So
/// both answers are those of the step that all executors share.
using Source = std::variant<PointSource, VertexSource, BallSource, CurveSource, SimplexSource>;

}  // namespace plexway
