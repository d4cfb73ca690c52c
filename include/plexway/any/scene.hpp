#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <plexway/any/shape.hpp>
#include <plexway/render/scene.hpp>
#include <plexway/source/source.hpp>

namespace plexway {

/// What a picture shows of a domain: values at its vertices, and marks beside it.
struct SceneContent {
  std::span<const double> distance = {};     ///< one a vertex, or none
  std::span<const std::int32_t> label = {};  ///< one a vertex, or none: then colours show cells
  ///@{
  /// Balls in red and in white, and smaller ones.
  std::vector<std::array<double, 3>> sources, targets, dots;
  ///@}
  /// Tubes along these lines.
  std::vector<std::vector<std::array<double, 3>>> paths;
  bool look_inside = false;  ///< solids become ghosts

  /// Marks a source: points as balls, lines and the rims of triangles as tubes, sets of up to 200
  /// vertices as dots. Balls show by themselves: the distance is 0 there. A domain without
  /// positions has no place for any.
  void mark(const AnyShape& shape, const Source& source);
};

/// A domain of any kind as render::picture takes it.
class ShapeScene {
 public:
  /// Refers to `shape` and to the spans of `content`, which must stay. Throws UsageError for a
  /// domain without positions, or of simplices alone. Cost: linear; of a cloud without normals,
  /// that of estimating them.
  ShapeScene(const AnyShape& shape, const SceneContent& content);
  /// What is inside refers to itself.
  ShapeScene(const ShapeScene&) = delete;
  /// Likewise.
  ShapeScene& operator=(const ShapeScene&) = delete;

  /// The scene.
  [[nodiscard]] const render::Scene& scene() const { return scene_; }

 private:
  std::vector<std::array<double, 3>> normals_;
  render::Scene scene_;
};

}  // namespace plexway
