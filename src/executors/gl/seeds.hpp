#pragma once

#include <GL/glcorearb.h>
#include <array>
#include <span>
#include <vector>

#include <plexway/solid/tet_mesh.hpp>
#include <plexway/solve/options.hpp>
#include <plexway/source/point_source.hpp>
#include <plexway/surface/triangle_mesh.hpp>

#include "executors/gl/front.hpp"
#include "labels/workspace_state.hpp"

namespace plexway::detail::gl {
/// What a source itself offers to a vertex (shaders/claim.comp).
struct VertexOffer {
  GLuint vertex, distance, source, spare;
};

/// What propagations on the device start from, field by field: labels that wait, and distances of
/// the vertices next to sources.
template <class CellLabel>
struct SeedsOf {
  using Label = CellLabel;

  std::vector<Waiting> waiting;
  std::vector<Label> labels;
  std::vector<VertexOffer> offers;

  void clear() {
    waiting.clear();
    labels.clear();
    offers.clear();
  }
};

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

/// shaders/solid.glsl says what is in it.
struct SolidCell {
  std::array<float, 4> distance2;
  GLuint state;  ///< the face it came in by, and the flag
  float sigma;
  GLuint spare;
  GLuint source;
  static constexpr GLuint face_mask = 3, known = 8;
};

/// As the serial rule computes them.
struct SolidSeeds : SeedsOf<SolidCell> {
  /// Sources of one field.
  void add(const TetMesh<float>& mesh, std::span<const PointSource> sources, std::size_t field,
           WorkspaceState<float>& workspace);
  /// What passes the vertices and edges of one field where tetrahedra only touch, given what is
  /// known of all tetrahedra: distances, and labels.
  void add_pinches(const TetMesh<float>& mesh, const PropagateOptions& options, std::size_t field,
                   std::span<const Cell> best, std::span<const SolidCell> known,
                   WorkspaceState<float>& workspace);
};

}  // namespace plexway::detail::gl
