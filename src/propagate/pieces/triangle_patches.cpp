#include "propagate/pieces/triangle_patches.hpp"

#include <array>
#include <cmath>

#include "complex/partition.hpp"
#include "propagate/piece_memory.hpp"

namespace plexway {
namespace {

/// Visits the triangles over the edges of one.
template <class Real>
auto neighbours_of(const TriangleMesh<Real>& mesh) {
  return [triangles = mesh.triangles().data(), sentinel = static_cast<Index>(mesh.face_count())](
             Index f, const auto& visit) {
    for (std::size_t e = 0; e < 3; ++e)
      for (Index across = triangles[f].across[e];;) {
        const Index g = across >> Across::face_shift;
        const std::size_t k = across & Across::edge_mask;
        if (g == sentinel || (g == f && k == e)) break;
        visit(g);
        if (!(across & Across::fan)) break;
        across = triangles[g].across[k];
      }
  };
}

/// The middle of each triangle in space; none where not all are known.
template <class Real>
std::vector<std::array<float, 3>> middles(const TriangleMesh<Real>& mesh) {
  const auto places = mesh.positions();
  std::vector<std::array<float, 3>> found;
  if (places.empty()) return found;
  found.resize(mesh.face_count());
  for (std::size_t f = 0; f < found.size(); ++f) {
    const Index(&corner)[3] = mesh.triangles()[f].corner;
    for (std::size_t i = 0; i < 3; ++i) {
      const double sum = places[corner[0]][i] + places[corner[1]][i] + places[corner[2]][i];
      if (!std::isfinite(sum)) return {};
      found[f][i] = static_cast<float>(sum);
    }
  }
  return found;
}

template <class Real>
Cut cut_of(const TriangleMesh<Real>& mesh, std::size_t size) {
  const auto neighbours = neighbours_of(mesh);
  return cut(partition(mesh.face_count(), size, middles(mesh), neighbours), neighbours);
}

}  // namespace

template <class Real>
TrianglePatches<Real>::TrianglePatches(const TriangleMesh<Real>& mesh, std::size_t size)
    : identity_(mesh.identity()), size_(size), cut_(cut_of(mesh, size)) {
  patches_.resize(cut_.pieces.size());
  for (Index p = 0; p < patches_.size(); ++p) take_records(mesh, p);
  take_vertices(mesh.vertex_count());
}

/// From the surface's vertices to those of pieces.
template <class Real>
void TrianglePatches<Real>::take_vertices(std::size_t vertices) {
  std::vector<Index> number(vertices), piece(vertices, none);
  std::vector<std::uint8_t> is_shared(vertices, 0);
  for (Index p = 0; p < patches_.size(); ++p) {
    TrianglePatch<Real>& patch = patches_[p];
    const std::size_t own = cut_.pieces[p].own;
    patch.vertices.reserve(own / 2 + own / 8 + 8);
    for (std::size_t f = 0; f < patch.triangles.size(); ++f)
      for (Index& corner : patch.triangles[f].corner) {
        if (f >= own) {
          corner = none;
          continue;
        }
        if (piece[corner] != p) {
          if (piece[corner] != none) is_shared[corner] = 1;
          piece[corner] = p;
          number[corner] = static_cast<Index>(patch.vertices.size());
          patch.vertices.push_back(corner);
        }
        corner = number[corner];
      }
  }
  for (TrianglePatch<Real>& patch : patches_) {
    patch.is_shared.reserve(patch.vertices.size());
    for (const Index v : patch.vertices) patch.is_shared.push_back(is_shared[v]);
  }
}

template <class Real>
void TrianglePatches<Real>::take_records(const TriangleMesh<Real>& mesh, Index number) {
  const CutPiece& piece = cut_.pieces[number];
  TrianglePatch<Real>& patch = patches_[number];
  const auto records = mesh.triangles();
  const Index sentinel = static_cast<Index>(mesh.face_count());
  const Index end = static_cast<Index>(piece.simplices.size());
  patch.triangles.resize(piece.simplices.size() + 1);
  patch.triangles[end] = records[sentinel];
  patch.leads_in.assign(piece.simplices.size() - piece.own, 0);
  const auto here = [&](Index g) {
    if (g == sentinel) return none;
    return cut_.piece_of[g] == number ? cut_.number_of[g] : piece.ghost(g, cut_.piece_of);
  };
  /// All triangles over an edge of a ghost are here if one of them is the piece's own.
  const auto is_own_over = [&](Index f, std::size_t e) {
    for (Index across = records[f].across[e];;) {
      const Index g = across >> Across::face_shift;
      if (g == sentinel || (g == f && (across & Across::edge_mask) == e)) return false;
      if (cut_.piece_of[g] == number) return true;
      if (!(across & Across::fan)) return false;
      across = records[g].across[across & Across::edge_mask];
    }
  };
  for (Index i = 0; i < end; ++i) {
    const Index f = piece.simplices[i];
    TriangleRecord<Real>& t = patch.triangles[i];
    t = records[f];
    for (std::size_t e = 0; e < 3; ++e) {
      constexpr Index rest = (Index{1} << Across::face_shift) - 1;
      if (i >= piece.own) {
        if (!is_own_over(f, e)) {
          t.across[e] = end << Across::face_shift;
          continue;
        }
        patch.leads_in[i - piece.own] |= static_cast<std::uint8_t>(1 << e);
      }
      const Index g = here(t.across[e] >> Across::face_shift);
      t.across[e] =
          g == none ? end << Across::face_shift : g << Across::face_shift | (t.across[e] & rest);
    }
  }
  for (Index& across : patch.triangles[end].across)
    if (across >> Across::face_shift == sentinel)
      across = end << Across::face_shift | (across & ((Index{1} << Across::face_shift) - 1));
}

template <class Real>
std::size_t TrianglePatch<Real>::bytes() const {
  const auto of = [](const auto& v) { return v.capacity() * sizeof(v[0]); };
  return of(triangles) + of(leads_in) + marks.bytes() + front.capacity * 2 * sizeof(Index) +
         labels.bytes() + of(source) + of(posted) + of(is_new) + of(vertices) + of(is_shared) +
         of(vertex) + of(vertex_source) + mail.box[0].bytes() + mail.box[1].bytes();
}

template <class Real>
std::size_t TrianglePatches<Real>::bytes() const {
  const auto of = [](const auto& v) { return v.capacity() * sizeof(v[0]); };
  std::size_t sum = of(cut_.piece_of) + of(cut_.number_of) + of(cut_.pieces) + of(patches_);
  for (const CutPiece& piece : cut_.pieces)
    sum += of(piece.simplices) + of(piece.peers) + of(piece.slots);
  for (const TrianglePatch<Real>& patch : patches_) sum += patch.bytes();
  return sum;
}

template struct TrianglePatch<float>;
template struct TrianglePatch<double>;
template class TrianglePatches<float>;
template class TrianglePatches<double>;

template <class Real>
PieceMemory<Real>::PieceMemory() noexcept = default;
template <class Real>
PieceMemory<Real>::~PieceMemory() = default;
template <class Real>
PieceMemory<Real>::PieceMemory(PieceMemory&&) noexcept = default;
template <class Real>
PieceMemory<Real>& PieceMemory<Real>::operator=(PieceMemory&&) noexcept = default;

template <class Real>
TrianglePatches<Real>& PieceMemory<Real>::of(const TriangleMesh<Real>& mesh, std::size_t size) {
  if (!patches_ || !patches_->is_for(mesh, size)) {
    patches_.reset();  // its memory first
    patches_ = std::make_unique<TrianglePatches<Real>>(mesh, size);
  }
  return *patches_;
}

template <class Real>
std::size_t PieceMemory<Real>::bytes() const {
  return patches_ ? sizeof(*patches_) + patches_->bytes() : 0;
}

template class PieceMemory<float>;
template class PieceMemory<double>;

}  // namespace plexway
