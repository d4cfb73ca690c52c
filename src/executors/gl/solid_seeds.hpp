#pragma once

#include <array>
#include <span>
#include <vector>

#include <plexway/complex/tet_mesh.hpp>
#include <plexway/propagate/options.hpp>
#include <plexway/source/point_source.hpp>

#include "executors/gl/seeds.hpp"
#include "propagate/solid_label.hpp"
#include "propagate/workspace_state.hpp"

namespace plexway::gl {

/// shaders/solid.glsl says what is in it.
struct SolidCell {
  std::array<float, 3> place;
  float sigma;
  GLuint state;  ///< the face it came in by, the two flags below, the edge S was turned about
  std::array<GLuint, SolidLabel<float>::bends> bend;
  GLuint source;
  static constexpr GLuint face_mask = 3, unfolded = 4, known = 8, edge_shift = 4;
};

/// As the serial rule computes them.
struct SolidSeeds : SeedsOf<SolidCell> {
  /// Sources of one field.
  void add(const TetMesh<float>& mesh, std::span<const PointSource> sources, std::size_t field,
           WorkspaceState<float>& workspace);
  /// What passes the vertices and edges of one field where tetrahedra only touch, and near cracks
  /// those where paths bend, given what is known of all tetrahedra: distances, and labels.
  void add_pinches(const TetMesh<float>& mesh, const PropagateOptions& options, std::size_t field,
                   std::span<const Cell> best, std::span<const SolidCell> known,
                   WorkspaceState<float>& workspace);
  /// Between the cells of the sources of the only field: distances and sources of its vertices as
  /// they were read out, and after.
  void pass_borders(const TetMesh<float>& mesh, const PropagateOptions& options,
                    std::span<const Cell> best, std::span<const SolidCell> known,
                    WorkspaceState<float>& workspace, std::span<float> distance,
                    std::span<Index> label) const;

 private:
  std::vector<PointSource> sources_;  // of the last field
};

}  // namespace plexway::gl
