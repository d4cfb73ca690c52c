#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include <plexway/mixed/mixed_complex.hpp>

#include "labels/mixed/hinge_chains.hpp"
#include "labels/mixed/hinge_neighbours.hpp"
#include "labels/mixed/mixed_piece.hpp"

namespace plexway {

/// What propagations must know of the hinges of a mixed domain, found once.
///
/// A *slot* is a place where a piece may have something to tell another: 2 w + side is that side of
/// weld w, and 2 welds + m is member m.
template <class Real>
class MixedHinges {
 public:
  using Domain = MixedComplex<Real>;
  using Member = typename Domain::Member;
  using Pieces = std::vector<std::unique_ptr<MixedPiece<Real>>>;

  MixedHinges(const Domain& domain, const Pieces& pieces) : chains_(domain), neighbours_(domain) {
    find_bends(domain, pieces);
    find_slots(domain);
    find_vertices(domain);
  }

  [[nodiscard]] const HingeChains<Real>& chains() const { return chains_; }
  [[nodiscard]] const HingeNeighbours<Real>& neighbours() const { return neighbours_; }
  /// Do both pieces measure the hinge alike?
  [[nodiscard]] bool is_isometric(Index hinge) const { return isometric_[hinge]; }
  /// A hinge at which a path may bend at the vertex of weld w, or none.
  [[nodiscard]] Index bend_at(Index w) const { return bends_[w]; }

  /// The hinge of a member, and its side.
  [[nodiscard]] std::pair<Index, Index> place(Index member) const { return places_[member]; }
  /// The slots at a simplex of a piece, of a wireframe at a vertex.
  [[nodiscard]] std::span<const Index> slots(Index piece, Index at) const {
    const Slots& own = slots_[piece];
    if (own.begin.empty()) return {};
    return std::span(own.slots).subspan(own.begin[at], own.begin[at + 1] - own.begin[at]);
  }

  /// The slots of hinges of dimension 0 at the vertex of such a slot, and it.
  [[nodiscard]] std::span<const Index> beside(Index slot) const {
    const auto [begin, end] = beside_[slot];
    return std::span(at_vertices_).subspan(begin, end - begin);
  }

  [[nodiscard]] std::size_t bytes() const {
    std::size_t sum =
        sizeof(*this) + chains_.bytes() + neighbours_.bytes() + isometric_.capacity() +
        (bends_.capacity() + at_vertices_.capacity()) * sizeof(Index) +
        beside_.capacity() * sizeof(beside_[0]) + places_.capacity() * sizeof(places_[0]);
    for (const Slots& own : slots_)
      sum += sizeof(own) + (own.begin.capacity() + own.slots.capacity()) * sizeof(Index);
    return sum;
  }

 private:
  static const TetMesh<Real>* solid(const Domain& domain, Index piece) {
    return std::get_if<TetMesh<Real>>(&domain.complex(domain.pieces()[piece]));
  }

  // Which hinges the two pieces measure alike; at which welded vertices paths may bend: where they
  // do not, and where a straight line of shared edges ends.
  void find_bends(const Domain& domain, const Pieces& pieces) {
    constexpr Real alike = Real(1e-6);
    std::vector<std::array<Index, 5>> at;  // pieces, vertices, weld
    for (Index w = 0; w < domain.welds().size(); ++w) {
      const auto& weld = domain.welds()[w];
      at.push_back({weld.piece[0], weld.piece[1], weld.vertex[0], weld.vertex[1], w});
    }
    std::sort(at.begin(), at.end());
    bends_.assign(domain.welds().size(), none);
    isometric_.assign(domain.hinges().size(), 0);
    for (Index n = 0; n < domain.hinges().size(); ++n) {
      const auto& hinge = domain.hinges()[n];
      const Member* member[2];
      for (const std::size_t side : {0, 1}) member[side] = &domain.members()[hinge.begin[side]];
      // Solids that could not be joined bend paths at edges of the face between them.
      const bool window =
          hinge.dimension == 2 && solid(domain, hinge.piece[0]) && solid(domain, hinge.piece[1]);
      isometric_[n] =
          !window && pieces[hinge.piece[0]]
                         ->shape(*member[0], hinge.dimension)
                         .agrees(pieces[hinge.piece[1]]->shape(*member[1], hinge.dimension),
                                 hinge.dimension, alike);
      for (std::size_t i = 0; i <= hinge.dimension; ++i) {
        if (isometric_[n] && (hinge.dimension == 2 || !chains_.ends(n, i))) continue;
        const std::array<Index, 5> key = {
            hinge.piece[0], hinge.piece[1],
            pieces[hinge.piece[0]]->vertex_of(member[0]->simplex, member[0]->corner[i]),
            pieces[hinge.piece[1]]->vertex_of(member[1]->simplex, member[1]->corner[i]), 0};
        const auto found = std::lower_bound(at.begin(), at.end(), key);
        if (found != at.end() && std::equal(key.begin(), key.begin() + 4, found->begin()))
          bends_[(*found)[4]] = n;
      }
    }
  }

  void find_slots(const Domain& domain) {
    places_.resize(domain.members().size());
    std::vector<std::vector<std::array<Index, 2>>> found(domain.pieces().size());  // where, slot
    std::vector<Index> corners;
    for (Index w = 0; w < domain.welds().size(); ++w) {
      const auto& weld = domain.welds()[w];
      if (!weld.hinge && bends_[w] == none) continue;
      for (const Index side : {0u, 1u}) {
        const Index piece = weld.piece[side], vertex = weld.vertex[side], slot = 2 * w + side;
        const auto& complex = domain.complex(domain.pieces()[piece]);
        if (const auto* surface = std::get_if<TriangleMesh<Real>>(&complex)) {
          surface->corners_at(vertex, corners);
          for (const Index c : corners) found[piece].push_back({c / 3, slot});
        } else if (const auto* tets = std::get_if<TetMesh<Real>>(&complex)) {
          for (const Index c : tets->corners_at(vertex)) found[piece].push_back({c / 4, slot});
        } else {
          found[piece].push_back({vertex, slot});
        }
      }
    }
    for (Index n = 0; n < domain.hinges().size(); ++n) {
      const auto& hinge = domain.hinges()[n];
      for (const Index side : {0u, 1u})
        for (Index m = hinge.begin[side]; m < hinge.end[side]; ++m) {
          places_[m] = {n, side};
          found[hinge.piece[side]].push_back(
              {domain.members()[m].simplex, static_cast<Index>(2 * domain.welds().size() + m)});
        }
    }
    slots_.resize(found.size());
    for (const auto& piece : domain.pieces()) {
      const auto& own = found[piece.number];
      if (own.empty()) continue;
      const bool wire = std::holds_alternative<Wireframe<Real>>(domain.complex(piece));
      auto& [begin, slots] = slots_[piece.number];
      begin.assign((wire ? piece.vertices : piece.simplices) + std::size_t{2}, 0);
      for (const auto& [where, slot] : own) ++begin[where + 2];
      for (std::size_t i = 2; i < begin.size(); ++i) begin[i] += begin[i - 1];
      slots.resize(own.size());
      for (const auto& [where, slot] : own) slots[begin[where + 1]++] = slot;
    }
  }

  void find_vertices(const Domain& domain) {
    std::vector<std::array<Index, 3>> at;  // piece, vertex, slot
    for (Index w = 0; w < domain.welds().size(); ++w) {
      const auto& weld = domain.welds()[w];
      for (const Index side : {0u, 1u})
        if (weld.hinge) at.push_back({weld.piece[side], weld.vertex[side], 2 * w + side});
    }
    std::sort(at.begin(), at.end());
    beside_.resize(2 * domain.welds().size(), {0, 0});
    for (Index i = 0, end = 0; i < at.size(); i = end) {
      while (end < at.size() && at[end][0] == at[i][0] && at[end][1] == at[i][1]) ++end;
      for (Index k = i; k < end; ++k) {
        beside_[at[k][2]] = {i, end};
        at_vertices_.push_back(at[k][2]);
      }
    }
  }

  struct Slots {
    std::vector<Index> begin, slots;
  };

  HingeChains<Real> chains_;
  HingeNeighbours<Real> neighbours_;
  std::vector<char> isometric_;                  // by hinge
  std::vector<Index> bends_;                     // by weld
  std::vector<std::pair<Index, Index>> places_;  // by member
  std::vector<std::pair<Index, Index>> beside_;  // by slot of a weld, a range of the next
  std::vector<Index> at_vertices_;
  std::vector<Slots> slots_;  // by piece
};

}  // namespace plexway
