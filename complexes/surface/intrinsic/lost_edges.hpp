#pragma once

#include <cstddef>
#include <vector>

#include <plexway/surface/triangle_mesh.hpp>

#include "complexes/common/building_blocks.hpp"
#include "complexes/surface/intrinsic/intrinsic_triangulation.hpp"

namespace plexway {

/// Edges of the input that are none any more: straight lines still.
class LostEdges {
 public:
  /// After the flips, by any number of threads. Cost: linear.
  LostEdges(const IntrinsicTriangulation& now, std::size_t input_faces, int threads);

  /// Are an edge's two sides slots that something happened to, and is the other one the lower? Then
  /// the edge is told from there. `across` as in a mesh's records.
  [[nodiscard]] bool told_by_other_side(Index slot, Index across) const {
    const Index other = across >> Across::face_shift;
    return (across & Across::fan) == 0 && other < slot &&
           (other >= input_faces_ || now_.history().changed(other));
  }
  /// Adds a line that the input knew, or an edge of a slot that something happened to, to `lost` if
  /// it is. Cost: that of the edges from its lower end.
  void look_at(Index v, Index w, double length, std::vector<SurfaceChord>& lost) const;
  /// All that were lost, in any order, ascending by their ends. Of several between the same the
  /// shortest counts.
  [[nodiscard]] static std::vector<SurfaceChord> sorted(std::vector<SurfaceChord> lost);

 private:
  struct Edge {
    Index upper;
    double length;
  };
  template <class Visit>
  void for_changed_edges(int threads, const Visit& visit) const;

  const IntrinsicTriangulation& now_;
  std::size_t input_faces_;
  // Edges of changed slots by their lower ends: those of v before end_[v], some three each, in any
  // order.
  std::vector<Index> end_;
  Unfilled<Edge> edges_;
};

}  // namespace plexway
