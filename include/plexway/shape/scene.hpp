#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <plexway/fields/fine_field.hpp>
#include <plexway/render/picture.hpp>
#include <plexway/shape/shape.hpp>
#include <plexway/source/source.hpp>

namespace plexway {

/// What a picture shows of a domain: values at its vertices, and marks beside it.
struct SceneContent {
  std::span<const double> distance = {};     ///< one a vertex, or none
  std::span<const std::int32_t> label = {};  ///< one a vertex, or none: then colours show cells
  /// Of a surface that is coloured by `distance`: triangles on which that is nearer to linear
  /// (fine_field of shape/isolines.hpp), or null. It must stay as well.
  const FineField* fine = nullptr;
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
  /// Whether all points of a surface or a solid lie in a line: its edges are drawn, there is no
  /// area.
  [[nodiscard]] bool is_line() const { return is_line_; }

 private:
  std::vector<std::array<double, 3>> normals_, slopes_;
  io::Edges lines_;
  bool is_line_ = false;
  render::Scene scene_;
};

}  // namespace plexway
