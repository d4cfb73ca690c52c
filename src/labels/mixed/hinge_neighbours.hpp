#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <variant>
#include <vector>

#include <plexway/mixed/mixed_complex.hpp>

namespace plexway {

/// Which hinges between the same two pieces touch: of triangles those that share an edge, and those
/// that share a vertex; of edges those that share a vertex.
template <class Real>
class HingeNeighbours {
 public:
  explicit HingeNeighbours(const MixedComplex<Real>& domain) {
    // By dimension, pieces, and the vertices of what is shared.
    std::vector<Key> edges, vertices;
    for (Index n = 0; n < domain.hinges().size(); ++n) {
      const auto& hinge = domain.hinges()[n];
      const auto& member = domain.members()[hinge.begin[0]];
      const auto& complex = domain.complex(domain.pieces()[hinge.piece[0]]);
      const auto vertex = [&](std::size_t i) { return corner(complex, member, i); };
      for (std::size_t i = 0; i <= hinge.dimension; ++i) {
        const Index v = vertex(i), w = vertex(i == hinge.dimension ? 0 : i + 1);
        vertices.push_back({hinge.dimension, hinge.piece[0], hinge.piece[1], v, none, n});
        if (hinge.dimension == 2)
          edges.push_back({2, hinge.piece[0], hinge.piece[1], std::min(v, w), std::max(v, w), n});
      }
    }
    const std::size_t hinges = domain.hinges().size();
    over_edges_ = Lists(edges, hinges);
    over_vertices_ = Lists(vertices, hinges);
  }

  [[nodiscard]] std::span<const Index> over_edges(Index hinge) const {
    return over_edges_.of(hinge);
  }
  [[nodiscard]] std::span<const Index> over_vertices(Index hinge) const {
    return over_vertices_.of(hinge);
  }
  [[nodiscard]] std::size_t bytes() const { return over_edges_.bytes() + over_vertices_.bytes(); }

 private:
  using Key = std::array<Index, 6>;  // all but the last say what is shared

  class Lists {
   public:
    Lists() = default;
    Lists(std::vector<Key>& keys, std::size_t hinges) : begin_(hinges + 1, 0) {
      std::sort(keys.begin(), keys.end());
      std::vector<std::array<Index, 2>> links;
      for (std::size_t i = 0, end = 0; i < keys.size(); i = end) {
        const auto same = [&](std::size_t j) {
          return std::equal(keys[i].begin(), keys[i].begin() + 5, keys[j].begin());
        };
        for (end = i + 1; end < keys.size() && same(end);) ++end;
        for (std::size_t j = i; j < end; ++j)
          for (std::size_t k = i; k < end; ++k)
            if (keys[j][5] != keys[k][5]) links.push_back({keys[j][5], keys[k][5]});
      }
      std::sort(links.begin(), links.end());
      links.erase(std::unique(links.begin(), links.end()), links.end());
      for (const auto& link : links) {
        ++begin_[link[0] + 1];
        list_.push_back(link[1]);
      }
      for (std::size_t n = 1; n < begin_.size(); ++n) begin_[n] += begin_[n - 1];
    }
    [[nodiscard]] std::span<const Index> of(Index hinge) const {
      return std::span(list_).subspan(begin_[hinge], begin_[hinge + 1] - begin_[hinge]);
    }
    [[nodiscard]] std::size_t bytes() const {
      return (begin_.capacity() + list_.capacity()) * sizeof(Index);
    }

   private:
    std::vector<Index> begin_, list_;
  };

  template <class Complex, class Member>
  static Index corner(const Complex& complex, const Member& member, std::size_t i) {
    if (const auto* surface = std::get_if<TriangleMesh<Real>>(&complex))
      return surface->triangles()[member.simplex].corner[member.corner[i]];
    return std::get<TetMesh<Real>>(complex).tets()[member.simplex].corner[member.corner[i]];
  }

  Lists over_edges_, over_vertices_;
};

}  // namespace plexway
