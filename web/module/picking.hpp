#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include <plexway/shape/shape.hpp>
#include <plexway/source/point_source.hpp>

#include "drawing.hpp"

namespace plexway::web {

/// What a ray meets first.
struct Hit {
  bool found = false;
  PointSource source;
  std::array<double, 3> at = {0, 0, 0};  ///< in the drawing's coordinates
  Index nearest_vertex = none;
  // Between which vertices it lies, and how much of each.
  std::array<Index, 3> vertices = {none, none, none};
  std::array<double, 3> share = {0, 0, 0};
};

/// Coordinates are the drawing's; `slack` is how far from points and edges the ray may pass, as a
/// share of the way to them. Cost: linear; 10 ns a triangle.
Hit pick(const AnyShape& shape, const Drawing& drawing, const std::array<double, 3>& from,
         const std::array<double, 3>& direction, double slack);

/// A field at a vertex each, there.
double interpolated(const Hit& hit, std::span<const float> values);

/// The edges of a shape's simplices, of a cloud those to its neighbours, as a wireframe.
AnyShape edges_of(const AnyShape& shape);

/// Where Dijkstra's algorithm starts for these sources: at the corners around each, with their
/// distances from it.
std::vector<PointSource> corners_of(const AnyShape& shape, std::span<const PointSource> sources);

/// What the command-line tool's --source takes for it.
std::string argument_of(const AnyShape& shape, const PointSource& source);

/// Where a plane cuts a solid: x, y, z, distance of each corner of triangles.
struct Section {
  std::vector<float> numbers;
};
Section section_of(const AnyShape& shape, const Drawing& drawing,
                   const std::array<double, 3>& normal, double offset,
                   std::span<const float> distance);

}  // namespace plexway::web
