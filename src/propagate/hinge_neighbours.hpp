#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <plexway/complex/mixed_complex.hpp>

namespace plexway {

/// Which hinges between the same two pieces touch: in an edge where they are triangles, in a vertex
/// where they are edges.
template <class Real>
class HingeNeighbours {
 public:
  explicit HingeNeighbours(const MixedComplex<Real>& domain) {
    // By dimension, pieces, and the vertices of what is shared.
    std::vector<std::array<Index, 6>> faces;
    for (Index n = 0; n < domain.hinges().size(); ++n) {
      const auto& hinge = domain.hinges()[n];
      const auto& member = domain.members()[hinge.begin[0]];
      const auto& complex = domain.complex(domain.pieces()[hinge.piece[0]]);
      const auto vertex = [&](std::size_t i) { return corner(complex, member, i); };
      const std::array<Index, 2> pieces = {hinge.piece[0], hinge.piece[1]};
      for (std::size_t i = 0; i <= hinge.dimension; ++i) {
        if (hinge.dimension == 1) {
          faces.push_back({1, pieces[0], pieces[1], vertex(i), none, n});
          continue;
        }
        const Index v = vertex(i), w = vertex(i == 2 ? 0 : i + 1);
        faces.push_back({2, pieces[0], pieces[1], std::min(v, w), std::max(v, w), n});
      }
    }
    std::sort(faces.begin(), faces.end());
    std::vector<std::array<Index, 2>> links;
    for (std::size_t i = 0, end = 0; i < faces.size(); i = end) {
      const auto same = [&](std::size_t j) {
        return std::equal(faces[i].begin(), faces[i].begin() + 5, faces[j].begin());
      };
      for (end = i + 1; end < faces.size() && same(end);) ++end;
      for (std::size_t j = i; j < end; ++j)
        for (std::size_t k = i; k < end; ++k)
          if (faces[j][5] != faces[k][5]) links.push_back({faces[j][5], faces[k][5]});
    }
    std::sort(links.begin(), links.end());
    links.erase(std::unique(links.begin(), links.end()), links.end());
    begin_.assign(domain.hinges().size() + 1, 0);
    for (const auto& link : links) {
      ++begin_[link[0] + 1];
      list_.push_back(link[1]);
    }
    for (std::size_t n = 1; n < begin_.size(); ++n) begin_[n] += begin_[n - 1];
  }

  [[nodiscard]] std::span<const Index> of(Index hinge) const {
    return std::span(list_).subspan(begin_[hinge], begin_[hinge + 1] - begin_[hinge]);
  }

 private:
  template <class Complex, class Member>
  static Index corner(const Complex& complex, const Member& member, std::size_t i) {
    if (const auto* surface = std::get_if<TriangleMesh<Real>>(&complex))
      return surface->triangles()[member.simplex].corner[member.corner[i]];
    return std::get<TetMesh<Real>>(complex).tets()[member.simplex].corner[member.corner[i]];
  }

  std::vector<Index> begin_, list_;
};

}  // namespace plexway
