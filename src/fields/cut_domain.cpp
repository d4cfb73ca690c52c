#include "fields/cut_domain.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

#include "paths/simplex_places.hpp"

namespace plexway::detail {
namespace {

std::array<double, 3> middle(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2};
}

/// Cuts edges that are longer than the limit of either end; a new vertex takes the mean of two.
/// Beyond `near` edges may be as much longer as they are farther away.
template <class Complex>
class Limits {
 public:
  Limits(CutDomain<Complex>& domain, const Near* near) : domain_(domain), near_(near) {
    for (std::size_t v = 0; v < domain.limits.size(); ++v) away_.push_back(away(v));
  }
  double operator()(const Bisection<Complex::dimension>& fine, Index edge) const {
    const auto& [ends, length] = fine.edges()[edge];
    std::vector<double>& limits = domain_.limits;
    if (std::max(ends[0], ends[1]) == limits.size()) {
      const auto [v, w] = fine.halved().back();
      limits.push_back((limits[v] + limits[w]) / 2);
      if (near_ != nullptr) domain_.places.push_back(middle(domain_.places[v], domain_.places[w]));
      away_.push_back(away(away_.size()));
    }
    return length / std::min(limits[ends[0]] + away_[ends[0]], limits[ends[1]] + away_[ends[1]]);
  }

 private:
  [[nodiscard]] double away(std::size_t v) const {
    if (near_ == nullptr) return 0;
    return std::max(0., near_->box.distance(domain_.places[v]) - near_->width);
  }

  CutDomain<Complex>& domain_;
  const Near* near_;
  mutable std::vector<double> away_;
};

template <class Real>
double length_of(const TetMesh<Real>& mesh, Index v, Index w) {
  return norm(mesh.points()[v] - mesh.points()[w]);
}

/// Is no edge longer than the limits of its ends? Most of the time nothing is near any limit.
template <class Real>
bool fits(const TriangleMesh<Real>& mesh, std::span<const double> limits) {
  const double least = *std::min_element(limits.begin(), limits.end());
  for (const TriangleRecord<Real>& t : mesh.triangles().first(mesh.face_count())) {
    if (static_cast<double>(*std::max_element(t.length, t.length + 3)) <= least) continue;
    for (std::size_t i = 0; i < 3; ++i)
      if (!(static_cast<double>(t.length[i]) <=
            std::min(limits[t.corner[i]], limits[t.corner[edge_after(i)]])))
        return false;
  }
  return true;
}
template <class Real>
bool fits(const TetMesh<Real>& mesh, std::span<const double> limits) {
  for (Index t = 0; t < mesh.tet_count(); ++t)
    for (const auto& [i, j] : tet_edge_ends) {
      const Index v = mesh.tets()[t].corner[i], w = mesh.tets()[t].corner[j];
      if (!(length_of(mesh, v, w) <= std::min(limits[v], limits[w]))) return false;
    }
  return true;
}

/// Simplices with their edges numbered.
template <int N>
struct Sides {
  std::vector<std::array<Index, Bisection<N>::corners>> simplices;
  std::vector<std::array<Index, Bisection<N>::sides>> sides;
  std::vector<typename Bisection<N>::Edge> edges;
  bool apart = true;  ///< no edge begins and ends at one vertex or is two sides of one triangle
};

/// Some tetrahedra of a solid, all their vertices numbered anew by `number`.
template <class Real, class Number>
Sides<3> sides_of(const TetMesh<Real>& mesh, std::span<const Index> chosen, const Number& number) {
  const Index count = static_cast<Index>(chosen.size());
  struct Side {
    Index v, w, at;  // at: 6 t + edge
  };
  std::vector<Side> all;
  all.reserve(std::size_t{6} * count);
  Sides<3> found;
  found.simplices.resize(count), found.sides.resize(count);
  for (Index t = 0; t < count; ++t) {
    const Index* corner = mesh.tets()[chosen[t]].corner;
    std::transform(corner, corner + 4, found.simplices[t].begin(), number);
    for (Index e = 0; e < 6; ++e) {
      const Index v = corner[tet_edge_ends[e][0]], w = corner[tet_edge_ends[e][1]];
      all.push_back({std::min(v, w), std::max(v, w), 6 * t + e});
    }
  }
  std::sort(all.begin(), all.end(), [](const Side& a, const Side& b) {
    return std::tie(a.v, a.w, a.at) < std::tie(b.v, b.w, b.at);
  });
  for (std::size_t n = 0; n < all.size(); ++n) {
    const Side& s = all[n];
    if (n == 0 || s.v != all[n - 1].v || s.w != all[n - 1].w)
      found.edges.push_back({{number(s.v), number(s.w)}, length_of(mesh, s.v, s.w)});
    found.sides[s.at / 6][s.at % 6] = static_cast<Index>(found.edges.size() - 1);
  }
  return found;
}

constexpr std::size_t triangle_side(std::size_t i) { return Bisection<2>::side(i, edge_after(i)); }

/// Some triangles of a surface, ascending, as they are glued.
template <class Real, class Number>
Sides<2> sides_of(const TriangleMesh<Real>& mesh, std::span<const Index> chosen,
                  const Number& number) {
  const auto triangles = mesh.triangles();
  const Index faces = static_cast<Index>(mesh.face_count());
  std::vector<Index> place(faces, none);
  for (std::size_t n = 0; n < chosen.size(); ++n) place[chosen[n]] = static_cast<Index>(n);
  Sides<2> found;
  found.simplices.resize(chosen.size()), found.sides.resize(chosen.size());
  for (auto& s : found.sides) s.fill(none);
  for (std::size_t n = 0; n < chosen.size(); ++n) {
    const Index f = chosen[n];
    const TriangleRecord<Real>& t = triangles[f];
    std::transform(t.corner, t.corner + 3, found.simplices[n].begin(), number);
    for (std::size_t i = 0; i < 3; ++i) {
      if (found.sides[n][triangle_side(i)] != none) continue;
      const Index v = t.corner[i], w = t.corner[edge_after(i)];
      if (v == w) found.apart = false;
      const Index edge = static_cast<Index>(found.edges.size());
      found.edges.push_back({{number(v), number(w)}, static_cast<double>(t.length[i])});
      found.sides[n][triangle_side(i)] = edge;
      for (Index across = t.across[i]; (across >> Across::face_shift) != faces;) {
        const Index g = across >> Across::face_shift;
        const std::size_t k = across & Across::edge_mask;
        if (g == f) {
          if (k != i) found.apart = false;  // glued to itself
          break;
        }
        if (place[g] != none) found.sides[place[g]][triangle_side(k)] = edge;
        if (!(across & Across::fan)) break;
        across = triangles[g].across[k];
      }
    }
  }
  return found;
}

/// Cut simplices as a domain is made of them.
template <class Complex>
struct Parts;
template <class Real>
struct Parts<TriangleMesh<Real>> {
  std::vector<std::array<Index, 3>> faces, across;
  std::vector<std::array<double, 3>> lengths;

  Parts(const Bisection<2>& fine, double unit) {
    const auto& cut = fine.simplices();
    faces.resize(cut.size()), across.resize(cut.size()), lengths.resize(cut.size());
    std::vector<Index> first(fine.edges().size(), none), last = first;  // cycles of halfedges
    for (Index f = 0; f < cut.size(); ++f) {
      faces[f] = cut[f].vertex;
      for (std::size_t i = 0; i < 3; ++i) {
        const Index edge = cut[f].edge[triangle_side(i)];
        const Index halfedge = 3 * f + static_cast<Index>(i);
        lengths[f][i] = fine.edges()[edge].length * unit;
        across[f][i] = none;
        if (first[edge] == none) {
          first[edge] = halfedge;
        } else {
          across[last[edge] / 3][last[edge] % 3] = halfedge;
          across[f][i] = first[edge];
        }
        last[edge] = halfedge;
      }
    }
  }

  [[nodiscard]] auto make(const TriangleMesh<Real>&,
                          const CutDomain<TriangleMesh<Real>>& domain) const {
    return std::make_unique<TriangleMesh<Real>>(domain.limits.size(), faces, lengths, across);
  }
};
template <class Real>
struct Parts<TetMesh<Real>> {
  std::vector<std::array<Index, 4>> tets;

  Parts(const Bisection<3>& fine, double) {
    tets.reserve(fine.simplices().size());
    for (const auto& simplex : fine.simplices()) tets.push_back(simplex.vertex);
  }
  [[nodiscard]] auto make(const TetMesh<Real>& mesh, const CutDomain<TetMesh<Real>>& domain) const {
    std::vector<std::array<double, 3>> positions;
    positions.reserve(domain.limits.size());
    const auto add = [&](const std::array<double, 3>& at) {
      positions.push_back({at[0] * mesh.unit(), at[1] * mesh.unit(), at[2] * mesh.unit()});
    };
    for (const auto& at : domain.places) add(at);
    if (!domain.partial) {
      for (Index v = 0; v < mesh.vertex_count(); ++v) add(place_of(mesh, v));
      for (const auto& [v, w] : domain.halved)
        positions.push_back(middle(positions[v], positions[w]));
    }
    return std::make_unique<TetMesh<Real>>(positions, tets);
  }
};

/// Begins a part of a domain.
template <class Complex>
CutDomain<Complex> part_near(const Complex& complex, std::span<const double> limits,
                             const Near& near) {
  CutDomain<Complex> domain;
  domain.partial = true;
  for (Index s = 0; s < complex.simplex_count(); ++s) {
    if (!(near.box.distance(box_around(complex, s)) <= near.width)) continue;
    domain.simplices.push_back(s);
    for (const Index v : corners_in(complex, s)) domain.vertices.push_back(v);
  }
  std::sort(domain.vertices.begin(), domain.vertices.end());
  domain.vertices.erase(std::unique(domain.vertices.begin(), domain.vertices.end()),
                        domain.vertices.end());
  for (const Index v : domain.vertices) {
    domain.limits.push_back(limits[v]);
    domain.places.push_back(place_of(complex, v));
  }
  return domain;
}

}  // namespace

template <class Complex>
CutDomain<Complex> cut(const Complex& complex, std::span<const double> limits, std::size_t most,
                       const Near* near) {
  constexpr int N = Complex::dimension;
  CutDomain<Complex> domain;
  std::vector<Index> all;
  if (near != nullptr) {
    domain = part_near(complex, limits, *near);
    if (domain.simplices.empty()) return domain;
  } else {
    domain.complex = &complex;
    domain.limits.assign(limits.begin(), limits.end());
    if (fits(complex, limits)) return domain;
    all.resize(complex.simplex_count());
    std::iota(all.begin(), all.end(), Index{0});
  }
  Sides<N> sides = sides_of(complex, near != nullptr ? domain.simplices : all,
                            [&](Index v) { return domain.vertex_in_copy(v); });
  if (near == nullptr && !sides.apart) return domain;  // there is no way to cut it
  const auto parts = [&] {  // What cut it need not be there while a copy is built.
    const Bisection<N> fine(domain.limits.size(), sides.simplices, sides.sides,
                            std::move(sides.edges), Limits<Complex>(domain, near), most,
                            near != nullptr);
    domain.halved = fine.halved();
    domain.splits = fine.splits();
    domain.parent.reserve(fine.simplices().size());
    for (const auto& simplex : fine.simplices())
      domain.parent.push_back(near != nullptr ? domain.simplices[simplex.parent] : simplex.parent);
    return Parts<Complex>(fine, complex.unit());
  }();
  domain.copy = parts.make(complex, domain);
  domain.complex = domain.copy.get();
  return domain;
}

template CutDomain<TriangleMesh<float>> cut(const TriangleMesh<float>&, std::span<const double>,
                                            std::size_t, const Near*);
template CutDomain<TriangleMesh<double>> cut(const TriangleMesh<double>&, std::span<const double>,
                                             std::size_t, const Near*);
template CutDomain<TetMesh<float>> cut(const TetMesh<float>&, std::span<const double>, std::size_t,
                                       const Near*);
template CutDomain<TetMesh<double>> cut(const TetMesh<double>&, std::span<const double>,
                                        std::size_t, const Near*);

}  // namespace plexway::detail
