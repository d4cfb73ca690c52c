#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include <plexway/simplicial/simplicial_complex.hpp>
#include <plexway/solid/tet_mesh.hpp>
#include <plexway/source/point_source.hpp>

/// What the plain step reads of a domain: its simplices, and what lies over their facets.
namespace plexway::detail {

/// Lines may miss a facet by so much of it.
template <class Real>
inline constexpr Real near_facet = sizeof(Real) == 4 ? Real(2e-4) : Real(1e-9);

template <class Domain>
class SimplexCells;

template <class Real_>
class SimplexCells<TetMesh<Real_>> {
 public:
  using Real = Real_;
  static constexpr int N = 3;
  /// Do corners of a facet come in the same order in all its simplices?
  static constexpr bool in_one_order = false;

  explicit SimplexCells(const TetMesh<Real>& mesh)
      : tets_(mesh.tets().data()),
        points_(mesh.points().data()),
        lengths_(mesh.squared_lengths().data()),
        sentinel_(static_cast<Index>(mesh.tet_count())),
        embedded_(mesh.embedded()),
        tolerance_(embedded_ || mesh.summary().notch_edges > 0 ? near_facet<Real> : Real(0.1)) {}

  [[nodiscard]] Index count() const { return sentinel_; }
  [[nodiscard]] Index vertex_of(Index t, Index i) const { return tets_[t].corner[i]; }
  [[nodiscard]] Real squared_edge(Index t, Index edge) const {
    if (!embedded_) return lengths_[t][edge];
    const auto d = points_[tets_[t].corner[tet_edge_ends[edge][1]]] -
                   points_[tets_[t].corner[tet_edge_ends[edge][0]]];
    return static_cast<Real>(dot(d, d));
  }
  /// Lengths alone that nothing is in the way of: what a line misses a face by is how space is bent
  /// there, not a notch that it would cut off.
  [[nodiscard]] Real tolerance() const { return tolerance_; }
  /// Calls visit(u, face) for the tetrahedron over a face, if there is one.
  template <class Visit>
  void over(Index t, Index face, const Visit& visit) const {
    const Index across = tets_[t].across[face], u = across >> TetAcross::tet_shift;
    if (u != sentinel_) visit(u, across & TetAcross::face_mask);
  }
  void prefetch(Index t) const { __builtin_prefetch(&tets_[t]); }

  /// A source that is no vertex: its tetrahedron, and its coordinates there.
  static std::pair<Index, std::array<double, 4>> inside(const TetMesh<Real>& mesh,
                                                        const PointSource& source) {
    const auto [t, turned] = mesh.inside_tet(source.simplex);
    std::array<double, 4> b = source.barycentric;
    if (turned) std::swap(b[2], b[3]);
    return {t, b};
  }

 private:
  const TetRecord* tets_;
  const Vector3<double>* points_;
  const std::array<Real, 6>* lengths_;
  Index sentinel_;
  bool embedded_;
  Real tolerance_;
};

template <class Real_, int N_>
class SimplexCells<SimplicialComplex<Real_, N_>> {
 public:
  using Real = Real_;
  static constexpr int N = N_;
  static constexpr bool in_one_order = true;

  explicit SimplexCells(const SimplicialComplex<Real, N>& domain)
      : records_(domain.records().data()), count_(static_cast<Index>(domain.simplex_count())) {}

  [[nodiscard]] Index count() const { return count_; }
  [[nodiscard]] Index vertex_of(Index s, Index i) const { return records_[s].corner[i]; }
  [[nodiscard]] Real squared_edge(Index s, Index edge) const { return records_[s].length2[edge]; }
  [[nodiscard]] Real tolerance() const { return near_facet<Real>; }
  /// Calls visit(t, facet) for all simplices over a facet.
  template <class Visit>
  void over(Index s, Index facet, const Visit& visit) const {
    for (Index across = records_[s].across[facet]; across != none;) {
      const Index t = across >> FacetAcross::simplex_shift, j = across & FacetAcross::facet_mask;
      if (t == s) break;  // once around
      visit(t, j);
      if (!(across & FacetAcross::fan)) break;
      across = records_[t].across[j];
    }
  }
  void prefetch(Index s) const {
    const char* record = reinterpret_cast<const char*>(&records_[s]);
    for (std::size_t line = 0; line < sizeof(records_[s]); line += 64)
      __builtin_prefetch(record + line);
  }

  static std::pair<Index, std::array<double, N + 1>> inside(
      const SimplicialComplex<Real, N>& domain, const PointSource& source) {
    const Index s = domain.inside_simplex(source.simplex);
    std::array<double, N + 1> b{};
    for (std::size_t k = 0; k <= N && k < source.barycentric.size(); ++k)
      b[domain.place(s, k)] = source.barycentric[k];
    return {s, b};
  }

 private:
  const SimplexRecord<Real, N>* records_;
  Index count_;
};

/// Squared distances, in the unit inside, of a point from the corners of a simplex, by its
/// coordinates there: sum b_j l_ij^2 - sum b_j b_k l_jk^2.
template <class Cells>
std::array<double, Cells::N + 1> corner_distances2(const Cells& cells, Index s,
                                                   const std::array<double, Cells::N + 1>& b) {
  std::array<double, Cells::N + 1> distance2{};
  double inner = 0;
  Index edge = 0;
  for (std::size_t j = 1; j <= Cells::N; ++j)
    for (std::size_t k = 0; k < j; ++k) {
      const double l2 = static_cast<double>(cells.squared_edge(s, edge++));
      inner += b[j] * b[k] * l2;
      distance2[j] += b[k] * l2;
      distance2[k] += b[j] * l2;
    }
  for (double& d : distance2) d = std::max(d - inner, 0.);
  return distance2;
}

/// Calls offer(vertex, distance) for a source at a vertex, or for the corners of the simplex it
/// lies in: inside numbers and unit, exact.
template <class Domain, class Offer>
void offer_corners(const Domain& domain, const PointSource& source, const Offer& offer) {
  const double sigma = source.offset / domain.unit();
  if (source.vertex != none) {
    offer(domain.inside_vertex(source.vertex), sigma);
    return;
  }
  const SimplexCells<Domain> cells(domain);
  const auto [s, b] = cells.inside(domain, source);
  const auto d2 = corner_distances2(cells, s, b);
  for (std::size_t i = 0; i < b.size(); ++i)
    offer(cells.vertex_of(s, static_cast<Index>(i)), b[i] == 1 ? sigma : sigma + std::sqrt(d2[i]));
}

}  // namespace plexway::detail
