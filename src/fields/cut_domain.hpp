#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include <plexway/solid/tet_mesh.hpp>
#include <plexway/surface/triangle_mesh.hpp>

#include "complexes/common/box_tree.hpp"
#include "fields/bisection.hpp"

namespace plexway::detail {

/// A domain whose edges are no longer than requested: itself, or a copy of all or of a part of it,
/// cut into smaller simplices. Numbers are those inside.
template <class Complex>
struct CutDomain {
  const Complex* complex = nullptr;  ///< to work on
  std::unique_ptr<Complex> copy;     ///< which this is, or none
  std::vector<double> limits;        ///< one a vertex, of `complex`

  /// Of a copy, by the numbers that its caller knows: which simplex of the domain given each is a
  /// part of, and between which two vertices each new one lies halfway, after those given.
  std::vector<Index> parent;
  std::vector<std::pair<Index, Index>> halved;
  Splits splits;
  /// Of a copy of a part: the domain's vertices and simplices that it began with, ascending.
  bool partial = false;
  std::vector<Index> vertices, simplices;
  /// Of a copy of a part: where its vertices lie, in the unit inside the domain.
  std::vector<std::array<double, 3>> places;

  /// A vertex of the domain, or a point of a simplex of it, by the numbers that the copy's caller
  /// knows. They must be in the part.
  [[nodiscard]] Index vertex_in_copy(Index v) const { return partial ? place(vertices, v) : v; }
  [[nodiscard]] Index vertex_in_domain(Index v) const { return partial ? vertices[v] : v; }
  [[nodiscard]] bool has_vertex(Index v) const {
    return !partial || std::binary_search(vertices.begin(), vertices.end(), v);
  }
  [[nodiscard]] Index simplex_in_copy(Index s, Weights& weights) const {
    return splits.part(partial ? place(simplices, s) : s, weights);
  }

 private:
  static Index place(const std::vector<Index>& list, Index number) {
    return static_cast<Index>(std::lower_bound(list.begin(), list.end(), number) - list.begin());
  }
};

/// A box and what lies within `width` of it, in the unit inside.
struct Near {
  Box<3> box;
  double width;
};

/// `limits`: the longest edge wanted at each vertex, in the unit inside. Throws TooManyParts where
/// that makes more than `most` simplices. With `near` a copy of what lies there, in any case; what
/// sticks out of that is cut more and more coarsely. Then the domain must have places.
template <class Complex>
CutDomain<Complex> cut(const Complex& complex, std::span<const double> limits,
                       std::size_t most = most_parts, const Near* near = nullptr);

}  // namespace plexway::detail
