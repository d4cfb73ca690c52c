#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace plexway::render {

/// A point or a direction in space.
using Point = std::array<double, 3>;
using Colour = std::array<std::uint8_t, 3>;  ///< sRGB

/// A part of a domain and what is known at its vertices. Any number of kinds of simplices at once;
/// positions without any are a cloud. Everything is referred to and must outlive the picture's
/// call.
struct Part {
  std::span<const Point> positions;  ///< finite
  /// Simplices of each kind, of vertices < positions.size(); empty where there are none.
  std::span<const std::array<std::uint32_t, 2>> edges = {};
  /// Likewise.
  std::span<const std::array<std::uint32_t, 3>> triangles = {};
  /// Likewise.
  std::span<const std::array<std::uint32_t, 4>> tets = {};
  /// One a vertex, of any length, or none: the side that the discs of a cloud face.
  std::span<const Point> normals = {};
  /// One a vertex, or none: then the part has one colour. What is not finite was not reached.
  std::span<const double> value = {};
  /// Of a cloud, one a vertex, or none: how `value` grows, by length. With it discs are coloured
  /// linearly and have isolines. What is not finite counts as 0.
  std::span<const Point> slope = {};
  /// One a vertex, or none: which cell it is in, negative where in none. Each cell has a colour of
  /// its own, and `value`, the distance from the cell's source, says where borders run inside of
  /// triangles.
  std::span<const std::int32_t> label = {};
  std::optional<Colour> colour = {};  ///< of a part without values
  bool ghost = false;                 ///< only a veil: one sees what lies inside
  bool whole = false;                 ///< the clip plane does not cut it
};

/// Balls at points, with a colour or with values.
struct Dots {
  /// Finite, in the scene's unit.
  std::vector<Point> positions;
  std::vector<double> value = {};  ///< one a point, or none
  /// Of points without values.
  Colour colour = {213, 70, 46};
  double size = 1;  ///< 1 is as thick as looks right for a sample
};

/// Everything in one picture. The lengths of all parts are in one unit.
struct Scene {
  /// The domain, in as many parts as are shown differently.
  std::vector<Part> parts;
  std::vector<std::vector<Point>> paths;  ///< polylines, drawn as tubes
  std::vector<Point> sources;             ///< red balls
  std::vector<Point> targets;             ///< white balls
  /// Balls besides.
  std::vector<Dots> dots;
};

}  // namespace plexway::render
