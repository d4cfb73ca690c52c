#pragma once

#include <array>
#include <span>
#include <vector>

#include <plexway/complex/triangle_mesh.hpp>
#include <plexway/source/point_source.hpp>

#include "executors/gl/vertex_offer.hpp"
#include "executors/gl/workspace.hpp"

namespace plexway::gl {

/// shaders/surface.glsl says what is in it.
struct SurfaceLabel {
  std::array<float, 4> x;
  float h;
  GLuint via;
  std::array<float, 2> limit_h;
};

/// What propagations start from, computed by the serial rule: labels of cells, and distances of the
/// vertices next to sources. Field by field.
struct SurfaceSeeds {
  std::vector<Waiting> waiting;
  std::vector<SurfaceLabel> labels;
  std::vector<VertexOffer> offers;

  void clear();
  /// Sources of one field.
  void add(const TriangleMesh<float>& mesh, std::span<const PointSource> sources, std::size_t field,
           Workspace<float>& workspace);
};

}  // namespace plexway::gl
