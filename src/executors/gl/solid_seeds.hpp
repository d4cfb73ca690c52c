#pragma once

#include <array>
#include <span>
#include <vector>

#include <plexway/complex/tet_mesh.hpp>
#include <plexway/propagate/solid_label.hpp>
#include <plexway/source/point_source.hpp>

#include "executors/gl/vertex_offer.hpp"
#include "executors/gl/workspace.hpp"

namespace plexway::gl {

/// shaders/solid.glsl says what is in it.
struct SolidCell {
  std::array<float, 3> place;
  float sigma;
  GLuint hinge, ring;
  std::array<GLuint, SolidLabel<float>::limits> limit;
  GLuint path, source;
};

/// Labels that the serial rule has computed and that wait on the device, and distances of the
/// vertices next to sources. Field by field.
struct SolidSeeds {
  std::vector<Waiting> waiting;
  std::vector<SolidCell> labels;
  std::vector<VertexOffer> offers;

  void clear();
  /// Sources of one field.
  void add(const TetMesh<float>& mesh, std::span<const PointSource> sources, std::size_t field,
           Workspace<float>& workspace);
  /// What passes the vertices and edges of one field where tetrahedra only touch, given what is
  /// known of all tetrahedra: bits of distances, and labels.
  void add_pinches(const TetMesh<float>& mesh, const PropagateOptions& options, std::size_t field,
                   std::span<const GLuint> best, std::span<const SolidCell> known,
                   Workspace<float>& workspace);
};

}  // namespace plexway::gl
