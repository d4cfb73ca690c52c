#include "fields/cut_domain.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

#include "paths/simplex_places.hpp"

namespace plexway {
namespace {

std::array<double, 3> middle(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2};
}

/// Cuts edges that are longer than the limit of either end; a new vertex takes the mean of two.
template <int N>
class Limits {
 public:
  explicit Limits(std::vector<double>& limits) : limits_(limits) {}
  double operator()(const Bisection<N>& fine, Index edge) const {
    const auto& [ends, length] = fine.edges()[edge];
    if (std::max(ends[0], ends[1]) == limits_.size()) {
      const auto [v, w] = fine.halved().back();
      limits_.push_back((limits_[v] + limits_[w]) / 2);
    }
    return length / std::min(limits_[ends[0]], limits_[ends[1]]);
  }

 private:
  std::vector<double>& limits_;
};

template <class Complex, int N>
void take_parts(const Bisection<N>& fine, CutDomain<Complex>& domain) {
  domain.halved = fine.halved();
  domain.splits = fine.splits();
  domain.parent.reserve(fine.simplices().size());
  for (const auto& simplex : fine.simplices()) domain.parent.push_back(simplex.parent);
}

/// The same for a part of a domain: beyond `width` from the box edges may be as much longer as they
/// are farther away.
template <int N>
class LimitsNear {
 public:
  LimitsNear(std::vector<double>& limits, std::vector<std::array<double, 3>>& positions,
             const Box<3>& box, double width)
      : limits_(limits), positions_(positions), box_(box), width_(width) {
    for (const auto& at : positions_) away_.push_back(away(at));
  }
  double operator()(const Bisection<N>& fine, Index edge) const {
    const auto& [ends, length] = fine.edges()[edge];
    if (std::max(ends[0], ends[1]) == limits_.size()) {
      const auto [v, w] = fine.halved().back();
      limits_.push_back((limits_[v] + limits_[w]) / 2);
      positions_.push_back(middle(positions_[v], positions_[w]));
      away_.push_back(away(positions_.back()));
    }
    return length / std::min(limits_[ends[0]] + away_[ends[0]], limits_[ends[1]] + away_[ends[1]]);
  }

 private:
  [[nodiscard]] double away(const std::array<double, 3>& at) const {
    return std::max(0., box_.distance(at) - width_);
  }

  std::vector<double>& limits_;
  std::vector<std::array<double, 3>>& positions_;
  mutable std::vector<double> away_;
  Box<3> box_;
  double width_;
};

template <class Real>
double length_of(const TetMesh<Real>& mesh, Index v, Index w) {
  return static_cast<double>(norm(mesh.points()[v] - mesh.points()[w]));
}

std::array<double, 3> scaled(const std::array<double, 3>& at, double unit) {
  return {at[0] * unit, at[1] * unit, at[2] * unit};
}

/// Some tetrahedra of a solid, all their vertices numbered anew by `number`.
template <class Real, class Number>
Bisection<3> bisected(const TetMesh<Real>& mesh, std::span<const Index> chosen,
                      std::size_t vertices, const Number& number,
                      const Bisection<3>::Excess& excess, std::size_t most,
                      bool shape_kept = false) {
  const Index count = static_cast<Index>(chosen.size());
  struct Side {
    Index v, w, at;  // at: 6 t + edge
  };
  std::vector<Side> all;
  all.reserve(std::size_t{6} * count);
  std::vector<std::array<Index, 4>> simplices(count);
  for (Index t = 0; t < count; ++t) {
    const Index* corner = mesh.tets()[chosen[t]].corner;
    std::transform(corner, corner + 4, simplices[t].begin(), number);
    for (Index e = 0; e < 6; ++e) {
      const Index v = corner[tet_edge_ends[e][0]], w = corner[tet_edge_ends[e][1]];
      all.push_back({std::min(v, w), std::max(v, w), 6 * t + e});
    }
  }
  std::sort(all.begin(), all.end(), [](const Side& a, const Side& b) {
    return std::tie(a.v, a.w, a.at) < std::tie(b.v, b.w, b.at);
  });
  std::vector<std::array<Index, 6>> sides(count);
  std::vector<Bisection<3>::Edge> edges;
  for (std::size_t n = 0; n < all.size(); ++n) {
    const Side& s = all[n];
    if (n == 0 || s.v != all[n - 1].v || s.w != all[n - 1].w)
      edges.push_back({{number(s.v), number(s.w)}, length_of(mesh, s.v, s.w)});
    sides[s.at / 6][s.at % 6] = static_cast<Index>(edges.size() - 1);
  }
  return Bisection<3>(vertices, simplices, sides, std::move(edges), excess, most, shape_kept);
}

std::vector<std::array<Index, 4>> tets_of(const Bisection<3>& fine) {
  std::vector<std::array<Index, 4>> tets;
  tets.reserve(fine.simplices().size());
  for (const auto& simplex : fine.simplices()) tets.push_back(simplex.vertex);
  return tets;
}

/// Triangles with their edges numbered, as they are glued.
struct TriangleSides {
  std::vector<std::array<Index, 3>> simplices, sides;
  std::vector<Bisection<2>::Edge> edges;
  bool apart = true;  ///< no edge begins and ends at one vertex or is two sides of one triangle
};

constexpr std::size_t triangle_side(std::size_t i) { return Bisection<2>::side(i, edge_after(i)); }

/// Some triangles of a surface, ascending, all their vertices numbered anew by `number`.
template <class Real, class Number>
TriangleSides sides_of(const TriangleMesh<Real>& mesh, std::span<const Index> chosen,
                       const Number& number) {
  const auto triangles = mesh.triangles();
  const Index faces = static_cast<Index>(mesh.face_count());
  std::vector<Index> place(faces, none);
  for (std::size_t n = 0; n < chosen.size(); ++n) place[chosen[n]] = static_cast<Index>(n);
  TriangleSides found;
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

/// Cut triangles as a surface is made of them.
struct CutTriangles {
  std::vector<std::array<Index, 3>> faces, across;
  std::vector<std::array<double, 3>> lengths;

  CutTriangles() = default;
  CutTriangles(const Bisection<2>& fine, double unit) {
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
};

template <class Real>
void take_copy(const CutTriangles& cut, CutDomain<TriangleMesh<Real>>& domain) {
  domain.copy = std::make_unique<TriangleMesh<Real>>(domain.limits.size(), cut.faces, cut.lengths,
                                                     cut.across);
  domain.complex = domain.copy.get();
}

/// Begins a part of a domain: what lies within `width` of a box.
template <class Complex>
CutDomain<Complex> part_near(const Complex& complex, std::span<const double> limits,
                             const Box<3>& box, double width) {
  CutDomain<Complex> domain;
  domain.partial = true;
  for (Index s = 0; s < complex.simplex_count(); ++s) {
    if (!(box.distance(box_around(complex, s)) <= width)) continue;
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

template <class Real>
CutDomain<TriangleMesh<Real>> cut(const TriangleMesh<Real>& mesh, std::vector<double> limits,
                                  std::size_t most) {
  CutDomain<TriangleMesh<Real>> domain;
  domain.complex = &mesh;
  const auto triangles = mesh.triangles();
  // Most of the time nothing is near any limit.
  const double least = *std::min_element(limits.begin(), limits.end());
  bool fits = true;
  for (Index f = 0; f < mesh.face_count() && fits; ++f) {
    const Real* length = triangles[f].length;
    if (static_cast<double>(std::max({length[0], length[1], length[2]})) <= least) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      const Index v = triangles[f].corner[i], w = triangles[f].corner[edge_after(i)];
      fits = fits && static_cast<double>(triangles[f].length[i]) <= std::min(limits[v], limits[w]);
    }
  }
  TriangleSides sides;
  if (!fits) {
    std::vector<Index> all(mesh.face_count());
    std::iota(all.begin(), all.end(), Index{0});
    sides = sides_of(mesh, all, [](Index v) { return v; });
  }
  domain.limits = std::move(limits);
  if (fits || !sides.apart) return domain;  // in the second case there is no way to cut it
  CutTriangles cut;
  {  // What cut it need not be there while a copy is built.
    const Bisection<2> fine(domain.limits.size(), sides.simplices, sides.sides,
                            std::move(sides.edges), Limits<2>(domain.limits), most);
    take_parts(fine, domain);
    cut = CutTriangles(fine, mesh.unit());
  }
  take_copy(cut, domain);
  return domain;
}

template <class Real>
CutDomain<TetMesh<Real>> cut(const TetMesh<Real>& mesh, std::vector<double> limits,
                             std::size_t most) {
  CutDomain<TetMesh<Real>> domain;
  domain.complex = &mesh;
  const auto tets = mesh.tets();
  const auto points = mesh.points();
  const Index count = static_cast<Index>(mesh.tet_count());
  bool fits = true;
  for (Index t = 0; t < count && fits; ++t)
    for (const auto& [i, j] : tet_edge_ends) {
      const Index v = tets[t].corner[i], w = tets[t].corner[j];
      fits = fits && length_of(mesh, v, w) <= std::min(limits[v], limits[w]);
    }
  if (fits) {
    domain.limits = std::move(limits);
    return domain;
  }
  std::vector<std::array<Index, 4>> cut;
  {  // What cut it need not be there while a copy is built.
    domain.limits = std::move(limits);
    std::vector<Index> all(count);
    std::iota(all.begin(), all.end(), Index{0});
    const Bisection<3> fine = bisected(
        mesh, all, domain.limits.size(), [](Index v) { return v; }, Limits<3>(domain.limits), most);
    take_parts(fine, domain);
    cut = tets_of(fine);
  }
  std::vector<std::array<double, 3>> positions;
  positions.reserve(domain.limits.size());
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    positions.push_back(scaled(place_of(mesh, v), mesh.unit()));
  for (const auto& [v, w] : domain.halved) positions.push_back(middle(positions[v], positions[w]));
  domain.copy = std::make_unique<TetMesh<Real>>(positions, cut);
  domain.complex = domain.copy.get();
  return domain;
}

template <class Real>
CutDomain<TriangleMesh<Real>> cut_near(const TriangleMesh<Real>& mesh,
                                       std::span<const double> limits, const Box<3>& box,
                                       double width, std::size_t most) {
  CutDomain<TriangleMesh<Real>> domain = part_near(mesh, limits, box, width);
  if (domain.simplices.empty()) return domain;
  CutTriangles cut;
  {
    TriangleSides sides =
        sides_of(mesh, domain.simplices, [&](Index v) { return domain.vertex_in_copy(v); });
    const Bisection<2> fine(domain.vertices.size(), sides.simplices, sides.sides,
                            std::move(sides.edges),
                            LimitsNear<2>(domain.limits, domain.places, box, width), most, true);
    take_parts(fine, domain);
    for (Index& s : domain.parent) s = domain.simplices[s];
    cut = CutTriangles(fine, mesh.unit());
  }
  take_copy(cut, domain);
  return domain;
}

template <class Real>
CutDomain<TetMesh<Real>> cut_near(const TetMesh<Real>& mesh, std::span<const double> limits,
                                  const Box<3>& box, double width, std::size_t most) {
  CutDomain<TetMesh<Real>> domain = part_near(mesh, limits, box, width);
  if (domain.simplices.empty()) return domain;
  std::vector<std::array<Index, 4>> cut;
  {
    const Bisection<3> fine = bisected(
        mesh, domain.simplices, domain.vertices.size(),
        [&](Index v) { return domain.vertex_in_copy(v); },
        LimitsNear<3>(domain.limits, domain.places, box, width), most, true);
    take_parts(fine, domain);
    for (Index& s : domain.parent) s = domain.simplices[s];
    cut = tets_of(fine);
  }
  std::vector<std::array<double, 3>> positions;
  positions.reserve(domain.places.size());
  for (const auto& at : domain.places) positions.push_back(scaled(at, mesh.unit()));
  domain.copy = std::make_unique<TetMesh<Real>>(positions, cut);
  domain.complex = domain.copy.get();
  return domain;
}

template CutDomain<TriangleMesh<float>> cut(const TriangleMesh<float>&, std::vector<double>,
                                            std::size_t);
template CutDomain<TriangleMesh<double>> cut(const TriangleMesh<double>&, std::vector<double>,
                                             std::size_t);
template CutDomain<TetMesh<float>> cut(const TetMesh<float>&, std::vector<double>, std::size_t);
template CutDomain<TetMesh<double>> cut(const TetMesh<double>&, std::vector<double>, std::size_t);
template CutDomain<TriangleMesh<float>> cut_near(const TriangleMesh<float>&,
                                                 std::span<const double>, const Box<3>&, double,
                                                 std::size_t);
template CutDomain<TriangleMesh<double>> cut_near(const TriangleMesh<double>&,
                                                  std::span<const double>, const Box<3>&, double,
                                                  std::size_t);
template CutDomain<TetMesh<float>> cut_near(const TetMesh<float>&, std::span<const double>,
                                            const Box<3>&, double, std::size_t);
template CutDomain<TetMesh<double>> cut_near(const TetMesh<double>&, std::span<const double>,
                                             const Box<3>&, double, std::size_t);

}  // namespace plexway
