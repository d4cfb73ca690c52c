#pragma once

#include <array>
#include <cstddef>

#include <plexway/common/ids.hpp>

namespace plexway::detail {

/// Where the edges of an N-simplex and of its facets are in a list of lengths. Edge (a, b), a < b,
/// stands at b (b - 1) / 2 + a: (0,1) (0,2) (1,2) (0,3) (1,3) (2,3) (0,4) ... Facet i is the one
/// opposite corner i, its corners in the same order as in the simplex.
template <int N>
struct SimplexLayout {
  static_assert(N >= 1 && N <= 4, "simplices of dimension 1 to 4");
  static constexpr std::size_t corners = N + 1;
  static constexpr std::size_t edges = N * (N + 1) / 2;
  static constexpr std::size_t facet_edges = N * (N - 1) / 2;

  static constexpr std::size_t edge(std::size_t a, std::size_t b) {
    return a < b ? b * (b - 1) / 2 + a : a * (a - 1) / 2 + b;
  }
  /// Corner of the simplex that is corner k of facet i.
  static constexpr std::size_t corner(std::size_t i, std::size_t k) { return k + (k >= i); }

  struct Tables {
    /// Facet i: its edges in the simplex; (N = 1: one entry that is not used).
    std::array<std::array<unsigned char, facet_edges + (N == 1)>, corners> facet_edge{};
    /// Facet i: the edge from corner i to each of its corners.
    std::array<std::array<unsigned char, N>, corners> spoke{};
  };
  static constexpr Tables make_tables() {
    Tables t;
    for (std::size_t i = 0; i < corners; ++i)
      for (std::size_t b = 0; b < N; ++b) {
        t.spoke[i][b] = static_cast<unsigned char>(edge(i, corner(i, b)));
        for (std::size_t a = 0; a < b; ++a)
          t.facet_edge[i][edge(a, b)] =
              static_cast<unsigned char>(edge(corner(i, a), corner(i, b)));
      }
    return t;
  }
  static constexpr Tables tables = make_tables();
};

/// What lies across a facet, packed; `none` on a boundary.
struct FacetAcross {
  static constexpr Index facet_mask = 7;  ///< its facet in its simplex
  static constexpr Index fan = 8;         ///< more than two simplices share the facet (a cycle)
  static constexpr int simplex_shift = 4;
  static constexpr Index limit = Index{1} << 28;  ///< so many simplices at most
};

/// All that propagation reads of one simplex. Corners ascend, so that the corners of a facet come
/// in the same order on all its sides, and no permutation needs to be stored. Lengths are in units
/// of the mean edge.
template <class Real, int N>
struct SimplexRecord {
  Index across[N + 1];            ///< FacetAcross of each facet
  Real length2[N * (N + 1) / 2];  ///< squared lengths, order of SimplexLayout
  Index corner[N + 1];            ///< vertices, numbers inside, ascending
  Index number;                   ///< the caller's
};

}  // namespace plexway::detail
