#pragma once

#include <array>
#include <span>

#include <plexway/source/point_source.hpp>
#include <plexway/surface/triangle_mesh.hpp>

#include "executors/gl/seeds.hpp"
#include "labels/workspace_state.hpp"

namespace plexway::gl {

/// shaders/surface.glsl says what is in it.
struct SurfaceLabel {
  std::array<float, 4> x;
  float h;
  GLuint via;
  std::array<float, 2> limit_h;
};

/// As the serial rule computes them.
struct SurfaceSeeds : SeedsOf<SurfaceLabel> {
  /// Sources of one field.
  void add(const TriangleMesh<float>& mesh, std::span<const PointSource> sources, std::size_t field,
           WorkspaceState<float>& workspace);
};

}  // namespace plexway::gl
