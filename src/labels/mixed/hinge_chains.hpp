#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include <plexway/mixed/mixed_complex.hpp>

#include "labels/mixed/mixed_piece.hpp"

namespace plexway {

/// Where a surface stands on a solid along a straight line of several edges, each edge is a hinge
/// of its own; but paths bend at the ends of the line alone.
template <class Real>
class HingeChains {
 public:
  using Domain = MixedComplex<Real>;

  explicit HingeChains(const Domain& domain)
      : links_(domain.hinges().size()), solid_(domain.hinges().size(), 2) {
    std::map<std::array<Index, 3>, std::vector<std::array<Index, 2>>> ends;  // by pieces and vertex
    for (Index n = 0; n < domain.hinges().size(); ++n) {
      const auto& hinge = domain.hinges()[n];
      for (Index side : {0u, 1u})
        if (hinge.dimension == 1 && solid_at(domain, hinge.piece[side])) solid_[n] = side;
      if (solid_[n] == 2) continue;
      for (Index end : {0u, 1u})
        ends[{hinge.piece[0], hinge.piece[1], vertex(domain, n, end)}].push_back({n, end});
    }
    for (const auto& [key, meeting] : ends)
      for (const auto& [n, end] : meeting)
        for (const auto& [other, other_end] : meeting)
          if (other != n && straight(domain, n, end, other, other_end))
            links_[n][end] = {other, other_end};
    find_lines(domain);
  }

  /// Does a straight line of edges into a solid end here, or turn?
  [[nodiscard]] bool ends(Index n, std::size_t end) const {
    return solid_[n] != 2 && links_[n][end].hinge == none;
  }

  /// From where to where the straight line of edges into a solid goes that hinge n is on, in its
  /// frame; without end for other hinges.
  [[nodiscard]] std::pair<Real, Real> line(Index n) const { return lines_[n]; }

  [[nodiscard]] std::size_t bytes() const {
    return links_.capacity() * sizeof(links_[0]) + solid_.capacity() * sizeof(Index) +
           lines_.capacity() * sizeof(lines_[0]);
  }

 private:
  void find_lines(const Domain& domain) {
    constexpr Real infinity = std::numeric_limits<Real>::infinity();
    lines_.assign(links_.size(), {-infinity, infinity});
    for (Index n = 0; n < links_.size(); ++n) {
      if (solid_[n] == 2) continue;
      Real beyond[2] = {0, 0};
      for (const Index towards : {0u, 1u})
        for (Link link = links_[n][towards]; link.hinge != none && link.hinge != n;
             link = links_[link.hinge][1 - link.end])
          beyond[towards] += length(domain, link.hinge);
      lines_[n] = {-beyond[0], length(domain, n) + beyond[1]};
    }
  }

  struct Link {
    Index hinge = none, end = 0;  // the end of that hinge which is ours
  };

  [[nodiscard]] static const TetMesh<Real>* solid_at(const Domain& domain, Index piece) {
    return std::get_if<TetMesh<Real>>(&domain.complex(domain.pieces()[piece]));
  }
  [[nodiscard]] Index vertex(const Domain& domain, Index n, Index end) const {
    const auto& hinge = domain.hinges()[n];
    const auto& member = domain.members()[hinge.begin[solid_[n]]];
    return solid_at(domain, hinge.piece[solid_[n]])
        ->tets()[member.simplex]
        .corner[member.corner[end]];
  }
  [[nodiscard]] Vector3<Real> along(const Domain& domain, Index n, Index from) const {
    const auto points = solid_at(domain, domain.hinges()[n].piece[solid_[n]])->points();
    return points[vertex(domain, n, 1 - from)] - points[vertex(domain, n, from)];
  }
  [[nodiscard]] Real length(const Domain& domain, Index n) const {
    const Real unit =
        static_cast<Real>(solid_at(domain, domain.hinges()[n].piece[solid_[n]])->unit());
    return norm(along(domain, n, 0)) * unit;
  }
  [[nodiscard]] bool straight(const Domain& domain, Index n, Index end, Index other,
                              Index other_end) const {
    const Vector3<Real> u = along(domain, n, 1 - end), w = along(domain, other, other_end);
    constexpr Real rounding = 256 * std::numeric_limits<Real>::epsilon();
    return dot(u, w) > 0 && norm(cross(u, w)) <= rounding * dot(u, w);
  }

  std::vector<std::array<Link, 2>> links_;
  std::vector<Index> solid_;  // by hinge: which side is a solid and met over an edge, or 2
  std::vector<std::pair<Real, Real>> lines_;
};

}  // namespace plexway
