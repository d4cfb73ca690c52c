#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <plexway/surface/triangle_mesh.hpp>

#include "complexes/partition/cut.hpp"

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

}  // namespace plexway::detail
