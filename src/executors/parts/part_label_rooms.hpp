#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "executors/parts/part_pieces.hpp"
#include "executors/threads/team.hpp"
#include "labels/pieces/triangle_patches.hpp"

namespace plexway::detail {

/// What labels of a surface in parts need and keep from solve to solve: of this process's pieces.
/// Labels read from a triangle where paths may bend, which depends on what lies around its corners
/// and their neighbours: so of ghosts their own pieces say it.
template <class Real>
class PartLabelRooms {
 public:
  /// `pieces` must outlive this. All processes. Cost: a quarter of a solve's.
  PartLabelRooms(const Team& team, const PartPieces<Real>& pieces);

  /// Of our piece i.
  [[nodiscard]] TriangleSheet<Real> sheet(std::size_t i) const {
    return {all_[i].triangles, all_[i].leads_in, pieces_.parts()[i].vertices.size()};
  }
  [[nodiscard]] TriangleRoom<Real>& room(std::size_t i) { return all_[i].room; }
  /// Vertices of its own triangles where fans only touch, ascending.
  [[nodiscard]] std::span<const Index> pinched(std::size_t i) const { return all_[i].pinched; }
  [[nodiscard]] std::size_t bytes() const;

 private:
  struct Piece {
    TriangleRoom<Real> room;
    std::vector<TriangleRecord<Real>> triangles;
    std::vector<std::uint8_t> leads_in;
    std::vector<Index> pinched;
  };

  void mark_saddles(const Team& team);

  const PartPieces<Real>& pieces_;
  std::vector<Piece> all_;
};

extern template class PartLabelRooms<float>;
extern template class PartLabelRooms<double>;

}  // namespace plexway::detail
