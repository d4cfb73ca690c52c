#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <plexway/surface/triangle_mesh.hpp>

#include "complexes/partition/cut.hpp"
#include "complexes/partition/deal.hpp"
#include "labels/front.hpp"
#include "labels/label_memory.hpp"
#include "labels/pieces/mail.hpp"

namespace plexway::detail {

/// The triangles of a piece by its numbers: its own, ghosts, and a sentinel. keeps(f, e): is all
/// that lies around edge e of a ghost f here? Its other edges are made boundaries.
template <class Real, class Keeps>
[[nodiscard]] std::vector<TriangleRecord<Real>> piece_records(const TriangleMesh<Real>& mesh,
                                                              const Cut& cut, Index number,
                                                              const Keeps& keeps) {
  const CutPiece& piece = cut.pieces[number];
  const auto records = mesh.triangles();
  const Index sentinel = static_cast<Index>(mesh.face_count());
  const Index end = static_cast<Index>(piece.simplices.size());
  constexpr Index rest = (Index{1} << Across::face_shift) - 1;
  std::vector<TriangleRecord<Real>> found(piece.simplices.size() + 1);
  const auto here = [&](Index g) {
    if (g == sentinel) return none;
    return cut.piece_of[g] == number ? cut.number_of[g] : piece.ghost(g, cut.piece_of);
  };
  for (Index i = 0; i < end; ++i) {
    const Index f = piece.simplices[i];
    TriangleRecord<Real>& t = found[i];
    t = records[f];
    for (std::size_t e = 0; e < 3; ++e) {
      const bool kept = i < piece.own || keeps(f, e);
      const Index g = kept ? here(t.across[e] >> Across::face_shift) : none;
      t.across[e] =
          g == none ? end << Across::face_shift : g << Across::face_shift | (t.across[e] & rest);
    }
  }
  found[end] = records[sentinel];
  for (Index& across : found[end].across)
    if (across >> Across::face_shift == sentinel)
      across = end << Across::face_shift | (across & rest);
  return found;
}

/// Numbers the vertices of each patch's own triangles anew, first those that other patches have as
/// well, and puts the numbers into its records, where it has any; ghosts get none. Patches have
/// `triangles`, `vertices` (of each number the surface's) and `shared` (so many are others', too).
template <class Real, class Patches>
void number_vertices(const TriangleMesh<Real>& mesh, const Cut& cut, Patches& patches) {
  const std::size_t vertices = mesh.vertex_count();
  const auto records = mesh.triangles();
  std::vector<Index> piece(vertices, none), number(vertices);
  std::vector<std::uint8_t> is_shared(vertices, 0);
  for (std::size_t f = 0; f < mesh.face_count(); ++f)
    for (const Index v : records[f].corner) {
      if (piece[v] == none) piece[v] = cut.piece_of[f];
      if (piece[v] != cut.piece_of[f]) is_shared[v] = 1;
    }
  piece.assign(vertices, none);
  for (Index p = 0; p < patches.size(); ++p) {
    auto& patch = patches[p];
    const std::span own = std::span(cut.pieces[p].simplices).first(cut.pieces[p].own);
    patch.vertices.reserve(own.size() / 2 + own.size() / 8 + 8);
    for (const bool wanted : {true, false}) {
      for (const Index f : own)
        for (const Index v : records[f].corner)
          if ((is_shared[v] != 0) == wanted && piece[v] != p) {
            piece[v] = p;
            number[v] = static_cast<Index>(patch.vertices.size());
            patch.vertices.push_back(v);
          }
      if (wanted) patch.shared = patch.vertices.size();
    }
    for (std::size_t i = 0; i < patch.triangles.size(); ++i)
      for (Index& v : patch.triangles[i].corner) v = i < own.size() ? number[v] : none;
  }
}

/// Visits the triangles over edge e of triangle f, until visit(triangle) says true. Did it?
template <class Real, class Visit>
bool any_over_edge(std::span<const TriangleRecord<Real>> triangles, Index f, std::size_t e,
                   const Visit& visit) {
  for (Index across = triangles[f].across[e];;) {
    const Index g = across >> Across::face_shift;
    const std::size_t k = across & Across::edge_mask;
    if (g + std::size_t{1} == triangles.size() || (g == f && k == e)) return false;
    if (visit(g)) return true;
    if (!(across & Across::fan)) return false;
    across = triangles[g].across[k];
  }
}

/// Of each ghost, which are the triangles from `own` on: bit e, if an own one lies over its edge e.
template <class Real>
std::vector<std::uint8_t> leads_in(std::span<const TriangleRecord<Real>> triangles,
                                   std::size_t own) {
  std::vector<std::uint8_t> bits(triangles.size() - 1 - own, 0);
  for (std::size_t g = 0; g < bits.size(); ++g)
    for (std::size_t e = 0; e < 3; ++e)
      if (any_over_edge(triangles, static_cast<Index>(own + g), e,
                        [own](Index f) { return f < own; }))
        bits[g] |= static_cast<std::uint8_t>(1 << e);
  return bits;
}

/// The triangles of a piece by its numbers, its own and ghosts, and a sentinel.
template <class Real>
struct TriangleSheet {
  std::span<const TriangleRecord<Real>> triangles;
  std::span<const std::uint8_t> leads_in;  ///< of each ghost: bit e, if one of the piece's own
                                           ///< lies over its edge e
  std::size_t vertices;                    ///< of its own triangles: their corners are below
};

/// What a piece of a surface writes on as labels propagate, kept from solve to solve.
template <class Real>
struct TriangleRoom {
  VisitMarks marks;
  FrontStorage front;
  Room labels;
  std::vector<Index> source;
  std::vector<Real> posted;          ///< of those at a cut: the distance last told,
  std::vector<std::uint8_t> is_new;  ///< and is it told now?
  Outboxes mail;
  std::vector<Real> vertex;  ///< read-out, and its labels
  std::vector<Index> vertex_source;

  [[nodiscard]] std::size_t bytes() const;
};

/// A piece of a surface that one process has.
template <class Real>
struct TrianglePatch : TriangleRoom<Real> {
  /// A ghost's other neighbours are cut off; corners are numbers in `vertices`, those of ghosts
  /// `none`.
  std::vector<TriangleRecord<Real>> triangles;
  std::vector<std::uint8_t> leads_in;  ///< as TriangleSheet has it
  std::vector<Index> vertices;         ///< of its own triangles: the surface's numbers inside
  std::size_t shared = 0;              ///< so many of them, the first, are other pieces', too

  [[nodiscard]] TriangleSheet<Real> sheet() const { return {triangles, leads_in, vertices.size()}; }
  [[nodiscard]] std::size_t bytes() const;
};

/// A surface cut into pieces.
template <class Real>
class TrianglePatches final : public KeptPieces {
 public:
  /// About `size` triangles each. Those that are not ours stay without triangles.
  TrianglePatches(const TriangleMesh<Real>& mesh, std::size_t size, Deal deal);

  [[nodiscard]] const Cut& cut() const { return cut_; }
  [[nodiscard]] std::size_t count() const { return cut_.pieces.size(); }
  [[nodiscard]] TrianglePatch<Real>& operator[](std::size_t piece) { return patches_[piece]; }
  [[nodiscard]] std::size_t bytes() const override;

 private:
  void take_records(const TriangleMesh<Real>& mesh, Index piece);

  Cut cut_;
  std::vector<TrianglePatch<Real>> patches_;
};

/// A surface's triangles in compact parts of about `size`; `cut` comes to it next.
template <class Real>
[[nodiscard]] Partition partition_of(const TriangleMesh<Real>& mesh, std::size_t size);

extern template struct TriangleRoom<float>;
extern template struct TriangleRoom<double>;
extern template class TrianglePatches<float>;
extern template class TrianglePatches<double>;

}  // namespace plexway::detail
