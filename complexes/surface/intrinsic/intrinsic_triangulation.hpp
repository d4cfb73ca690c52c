#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <plexway/common/ids.hpp>
#include <plexway/surface/detail/triangle_record.hpp>
#include <plexway/surface/intrinsic_delaunay.hpp>
#include <plexway/surface/triangle_mesh.hpp>

#include "complexes/common/building_blocks.hpp"
#include "complexes/surface/intrinsic/patch_history.hpp"
#include "complexes/surface/intrinsic/planar.hpp"

namespace plexway::detail {

/// A triangle that may change, in double. Edge i runs from corner i to the next.
///
/// Lengths *and* angles: lengths alone hold the height of a thin triangle to the root of a rounding
/// error, and angles alone its short edge. With both a flip turns angles into sums and differences
/// of the angles before it, so that the sums around vertices stay.
struct IntrinsicTriangle {
  std::array<double, 3> length;
  std::array<Turn, 3> angle;
  std::array<Index, 3> across;  ///< packed as Across; `none` on a boundary
  std::array<Index, 3> corner;  ///< vertices
};

/// A halfedge: triangle << Across::face_shift | edge.
using Halfedge = Index;

/// A surface whose triangulation can be changed while its metric stays: a Delta-complex with flips
/// and splits. Edges with other than two triangles stay what they are.
///
/// Triangles keep their place, a *slot*: a flip makes two of two, a split adds slots at the end.
class IntrinsicTriangulation {
 public:
  /// Of nothing.
  IntrinsicTriangulation() = default;
  /// Lengths in the mesh's unit. Slots are the mesh's numbers inside, corners the caller's
  /// vertices.
  template <class Real>
  explicit IntrinsicTriangulation(const TriangleMesh<Real>& mesh);
  /// The same from what a mesh is made of, in units of its mean edge, which `unit` takes.
  IntrinsicTriangulation(const FaceLayout& layout, const TriangleShapes& shapes, double& unit,
                         int threads);

  [[nodiscard]] std::span<const IntrinsicTriangle> triangles() const { return triangles_; }
  /// Whether the slot had its corners the other way round in the input as the caller gave it.
  [[nodiscard]] bool turned(Index slot) const { return slot < turned_.size() && turned_[slot]; }
  [[nodiscard]] std::size_t vertices() const { return vertices_; }
  [[nodiscard]] const PatchHistory& history() const { return history_; }
  [[nodiscard]] std::size_t bytes() const;
  /// After the last flip and split: what only these need.
  void settle() {
    std::vector<std::uint16_t>().swap(flips_);
    if (std::find(turned_.begin(), turned_.end(), char{1}) == turned_.end())
      std::vector<char>().swap(turned_);
    history_.trim();
  }
  /// What is left maps points.
  void release_triangles() { Unfilled<IntrinsicTriangle>().swap(triangles_); }

  /// By how much the angles opposite to an edge exceed pi, as a sine; negative where the edge is
  /// Delaunay or cannot be flipped.
  [[nodiscard]] double excess(Halfedge h) const;
  /// Flips an edge with an excess. False if it must stay: a loop would turn over.
  bool flip(Halfedge h);
  /// Flips since the start of the slots beside an edge, the larger number.
  [[nodiscard]] std::uint32_t flips(Halfedge h) const;

  /// Puts a new vertex into a triangle, by barycentric coordinates: that slot and two new ones.
  void split(Index slot, const std::array<double, 3>& at);
  /// Puts a new vertex in the middle of an edge with one triangle: its slot and a new one.
  void split_border(Halfedge h);
  /// Where in the input the vertices are that were put in, in order.
  [[nodiscard]] std::span<const SlotPoint> inserted() const { return inserted_; }

 private:
  friend struct KeptParts;

  [[nodiscard]] Index& across(Halfedge h) {
    return triangles_[h >> Across::face_shift].across[h & Across::edge_mask];
  }
  [[nodiscard]] Index across(Halfedge h) const {
    return triangles_[h >> Across::face_shift].across[h & Across::edge_mask];
  }
  void take_callers_turns();
  [[nodiscard]] Halfedge before(Halfedge h) const;
  void rename(std::span<const Halfedge> from, std::span<const Halfedge> to, bool mirrored = false);
  void turn_over(Index slot);
  [[nodiscard]] bool may_turn_over(Index slot) const;
  Index add_slot();
  Index add_vertex(Index slot, const std::array<double, 3>& at);

  std::size_t vertices_ = 0;
  Unfilled<IntrinsicTriangle> triangles_;
  std::vector<std::uint16_t> flips_;
  std::vector<char> turned_;
  PatchHistory history_;
  std::vector<SlotPoint> inserted_;
};

/// As measure_triangulation of a mesh, before there is one. By any number of threads.
template <class Real>
TriangulationShape measure_triangulation(const FaceLayout& layout, const TriangleShapes& shapes,
                                         int threads);

}  // namespace plexway::detail
