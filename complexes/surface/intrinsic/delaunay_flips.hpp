#pragma once

#include <cstddef>
#include <vector>

#include <plexway/surface/intrinsic_delaunay.hpp>
#include <plexway/surface/triangle_mesh.hpp>

#include "complexes/common/building_blocks.hpp"
#include "complexes/surface/intrinsic/intrinsic_triangulation.hpp"

namespace plexway::detail {

/// Flips edges until all are Delaunay up to a tolerance, a sine.
///
/// Each flip lowers an energy, so in exact numbers it ends. Rounding may not respect that: from
/// 4096 flips of a slot on the tolerance doubles every 16, and no sum of two angles exceeds pi by
/// more than pi. So there is an end after 4700 flips a slot at the latest.
class DelaunayFlips {
 public:
  DelaunayFlips(IntrinsicTriangulation& triangulation, double tolerance)
      : triangulation_(triangulation), tolerance_(tolerance) {}

  /// All edges, those that are Delaunay already by any number of threads. Cost: linear, and the
  /// flips, which are one thread's.
  void all(int threads);
  /// The edges of a slot and all that follows from them. Tells `changed(slot)` of slots flipped.
  template <class Changed>
  void around(Index slot, Changed changed) {
    for (Index edge = 0; edge < 3; ++edge) from(slot << Across::face_shift | edge, changed);
  }

  [[nodiscard]] std::size_t count() const { return count_; }
  /// Edges that are not Delaunay all the same. Cost: linear if there may be any.
  [[nodiscard]] std::size_t stuck() const;

 private:
  bool should_flip(Halfedge h);
  // A flip puts the four edges around it on a stack, so that what it changes is still in the cache
  // when it is looked at again.
  template <class Changed>
  void from(Halfedge first, Changed changed) {
    stack_.push_back(first);
    while (!stack_.empty()) {
      const Halfedge h = stack_.back();
      stack_.pop_back();
      if (!should_flip(h)) continue;
      const Index f = h >> Across::face_shift;
      const Index g =
          triangulation_.triangles()[f].across[h & Across::edge_mask] >> Across::face_shift;
      if (!triangulation_.flip(h)) {
        may_be_stuck_ = true;
        continue;
      }
      ++count_;
      for (const Index t : {g, f}) {
        changed(t);
        for (const Index i : {2u, 0u}) stack_.push_back(t << Across::face_shift | i);
      }
    }
  }

  IntrinsicTriangulation& triangulation_;
  double tolerance_;
  std::size_t count_ = 0;
  bool may_be_stuck_ = false;
  std::vector<Halfedge> stack_;
};

/// Puts vertices into a Delaunay triangulation until its angles are as wanted, or it has to stop.
void refine(IntrinsicTriangulation& triangulation, DelaunayFlips& flips, const Refinement& wanted);

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

}  // namespace plexway::detail
