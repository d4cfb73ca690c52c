#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include <plexway/metric/edge_lengths.hpp>
#include <plexway/simplicial/kuhn_grid.hpp>
#include <plexway/solve.hpp>

#include "complexes/test_clouds.hpp"
#include "complexes/test_meshes.hpp"
#include "complexes/test_solids.hpp"
#include "data/two_speeds.hpp"

/// A small domain of every kind and metric where distances have a closed form, whatever the source.
namespace plexway::testing {
using namespace detail;

using Place = std::array<double, 4>;

inline double straight_between(const Place& a, const Place& b) {
  double sum = 0;
  for (std::size_t d = 0; d < 4; ++d) sum += (a[d] - b[d]) * (a[d] - b[d]);
  return std::sqrt(sum);
}
inline Place between(const Place& a, const Place& b, double share) {
  Place p;
  for (std::size_t d = 0; d < 4; ++d) p[d] = a[d] + share * (b[d] - a[d]);
  return p;
}

template <class D>
struct Scene {
  std::string name;
  D domain;
  std::vector<Place> places;                  ///< one a vertex
  std::vector<std::vector<Index>> simplices;  ///< corners, as given
  std::function<double(const Place&, const Place&)> distance = straight_between;

  [[nodiscard]] Place place(const PointSource& source) const {
    if (source.vertex != none) return places[source.vertex];
    Place p{};
    const auto& corners = simplices[source.simplex];
    for (std::size_t i = 0; i < corners.size(); ++i)
      for (std::size_t d = 0; d < 4; ++d) p[d] += source.barycentric[i] * places[corners[i]][d];
    return p;
  }
  /// From all of a segment: exactly by the straight line, else by samples; in a wireframe a segment
  /// is as near as its ends.
  [[nodiscard]] double from_segment(const Place& a, const Place& b, const Place& p) const {
    if (D::kind == DomainKind::wireframe) return std::min(distance(a, p), distance(b, p));
    double best = std::numeric_limits<double>::infinity();
    if (domain.metric() != MetricKind::refracting) {
      double along = 0, length2 = 0;
      for (std::size_t d = 0; d < 4; ++d) {
        along += (p[d] - a[d]) * (b[d] - a[d]);
        length2 += (b[d] - a[d]) * (b[d] - a[d]);
      }
      return distance(between(a, b, std::clamp(along / length2, 0., 1.)), p);
    }
    for (int i = 0; i <= 64; ++i) best = std::min(best, distance(between(a, b, i / 64.), p));
    return best;
  }
};

/// What may be asked of a scene: a source, and its closed form at a vertex.
struct Asked {
  std::string name;
  SourceKind kind;
  Source source;
  std::function<double(Index)> exact;
};

template <class D>
std::vector<Asked> sources_of(const Scene<D>& scene) {
  std::vector<Asked> all;
  const auto from = [&scene](const PointSource& source, Index v) {
    return scene.distance(scene.place(source), scene.places[v]);
  };
  const Index many = static_cast<Index>(scene.places.size());
  const PointSource at = PointSource::at(many / 3);
  all.push_back({"a vertex", SourceKind::vertex, at, [=](Index v) { return from(at, v); }});
  const VertexSource set{.vertices = {many / 5, many / 2}, .offsets = {0.1, 0}, .offset = 0.05};
  all.push_back({"vertices with offsets", SourceKind::vertex, set, [=](Index v) {
                   return 0.05 + std::min(0.1 + from(PointSource::at(set.vertices[0]), v),
                                          from(PointSource::at(set.vertices[1]), v));
                 }});
  const BallSource ball{.centre = at, .radius = 0.2, .offset = 0.03};
  all.push_back({"a ball", SourceKind::vertex, ball,
                 [=](Index v) { return 0.03 + std::abs(from(at, v) - 0.2); }});

  // A point, a segment and all of one simplex.
  const Index simplex = static_cast<Index>(scene.simplices.size() / 3);
  constexpr std::size_t corners = std::min(D::dimension, 3) + 1;
  PointSource in{.simplex = simplex}, other{.simplex = simplex};
  const std::size_t used = std::min(scene.simplices[simplex].size(), corners);
  const double left = 1 / static_cast<double>(used);
  for (std::size_t i = 0; i < used; ++i) {
    in.barycentric[i] = i == 0 ? left + 0.1 : i == 1 ? left - 0.1 : left;
    other.barycentric[i] = i == 0 ? 0.1 : i + 1 == used ? 0.9 : 0;
  }
  all.push_back({"a point", SourceKind::point, in, [=](Index v) { return from(in, v); }});
  const BallSource round{.centre = in, .radius = 0.1};
  all.push_back({"a ball about a point", SourceKind::point, round,
                 [=](Index v) { return std::abs(from(in, v) - 0.1); }});
  all.push_back({"a segment", SourceKind::curve, CurveSource{.points = {in, other}, .offset = 0.02},
                 [=, &scene](Index v) {
                   return 0.02 +
                          scene.from_segment(scene.place(in), scene.place(other), scene.places[v]);
                 }});
  all.push_back(
      {"a simplex", SourceKind::simplex, SimplexSource{.simplex = simplex}, [=, &scene](Index v) {
         const auto& c = scene.simplices[simplex];
         double best = std::numeric_limits<double>::infinity();
         for (std::size_t i = 0; i < c.size(); ++i)
           for (std::size_t j = 0; j < i; ++j)
             best = std::min(
                 best, scene.from_segment(scene.places[c[i]], scene.places[c[j]], scene.places[v]));
         return best;
       }});
  return all;
}

namespace scenes {

template <class Points>
std::vector<Place> places_of(const Points& points) {
  std::vector<Place> all;
  for (const auto& p : points) {
    all.push_back({});
    for (std::size_t d = 0; d < p.size(); ++d) all.back()[d] = p[d];
  }
  return all;
}
template <class Rows>
std::vector<std::vector<Index>> rows_of(const Rows& rows, Index first = 0) {
  std::vector<std::vector<Index>> all;
  for (const auto& row : rows) {
    all.emplace_back(row.begin(), row.end());
    for (Index& v : all.back()) v += first;
  }
  return all;
}

}  // namespace scenes

/// Calls visit(scene) for every metric that a kind of domain may have.
template <class D, class Visit>
void visit_scenes(const Visit& visit) {
  using Real = RealOf<D>;
  using namespace scenes;
  if constexpr (D::kind == DomainKind::surface) {
    const Surface s = grid(11, 9, 1.2, 1);
    visit(Scene<D>{"a rectangle", s.mesh<Real>(), places_of(s.positions), rows_of(s.faces)});
    const samples::HalvedSquare halved(20, 0.3);
    const samples::TwoSpeeds law{1, 2};
    metric::SimplexSpeeds speeds;
    for (std::size_t f = 0; f < halved.faces.size(); ++f)
      speeds.speed.push_back(halved.is_above(f) ? law.above : law.below);
    speeds.agreement = {metric::Sides::own, 0.01};
    SurfaceHints hints;
    hints.refracts = true;
    visit(Scene<D>{"a square of two speeds",
                   D(halved.points.size(), halved.faces,
                     metric::triangle_lengths(halved.points, halved.faces, speeds), hints),
                   places_of(halved.points), rows_of(halved.faces),
                   [law](const Place& a, const Place& b) {
                     return law.time({a[0], a[1], a[2]}, {b[0], b[1], b[2]});
                   }});
  } else if constexpr (D::kind == DomainKind::solid) {
    const Solid s = solid_cube(4);
    visit(Scene<D>{"a cube", s.mesh<Real>(), places_of(s.positions), rows_of(s.tets)});
    visit(Scene<D>{"a cube by lengths", D(s.positions.size(), s.tets, s.lengths()),
                   places_of(s.positions), rows_of(s.tets)});
  } else if constexpr (D::kind == DomainKind::wireframe) {
    std::vector<std::array<double, 3>> points;  // a lattice of bars: along them, not straight
    std::vector<std::array<Index, 2>> edges;
    for (Index j = 0; j < 9; ++j)
      for (Index i = 0; i < 11; ++i) {
        points.push_back({0.1 * i, 0.1 * j, 0});
        const Index v = 11 * j + i;
        if (i > 0) edges.push_back({v - 1, v});
        if (j > 0) edges.push_back({v - 11, v});
      }
    visit(Scene<D>{"a lattice", D(points, edges), places_of(points), rows_of(edges),
                   [](const Place& a, const Place& b) {
                     return std::abs(a[0] - b[0]) + std::abs(a[1] - b[1]);
                   }});
  } else if constexpr (D::kind == DomainKind::simplices) {
    constexpr int n = D::dimension;
    std::vector<double> numbers;
    std::vector<std::array<Index, n + 1>> simplices;
    std::vector<Place> places;
    if constexpr (n == 1) {
      for (Index v = 0; v < 40; ++v) {
        numbers.push_back(0.03 * v + (v % 3 ? 0.01 : 0));
        places.push_back({numbers.back(), 0, 0, 0});
        if (v > 0) simplices.push_back({v - 1, v});
      }
    } else {
      typename KuhnGrid<n>::Place cells;
      typename KuhnGrid<n>::Point spacing;
      cells.fill(n == 2 ? 10 : n == 3 ? 4 : 2);
      spacing.fill(n == 2 ? 0.1 : n == 3 ? 0.25 : 0.5);
      const KuhnGrid<n> kuhn(cells, spacing);
      numbers = kuhn.positions();
      simplices = kuhn.simplices();
      for (Index v = 0; v < kuhn.vertex_count(); ++v) {
        places.push_back({});
        for (std::size_t d = 0; d < n; ++d) places.back()[d] = kuhn.position(v)[d];
      }
    }
    visit(Scene<D>{"a cube of dimension " + std::to_string(n), D(numbers, n, simplices), places,
                   rows_of(simplices)});
  } else if constexpr (D::kind == DomainKind::cloud) {
    std::vector<std::array<double, 3>> points;  // of a square with straight sides
    std::mt19937 random(5);
    for (int j = 0; j <= 20; ++j)
      for (int i = 0; i <= 20; ++i) {
        const double x = i % 20 ? 0.015 * (uniform(random) - 0.5) : 0;
        const double y = j % 20 ? 0.015 * (uniform(random) - 0.5) : 0;
        points.push_back({0.05 * i + x, 0.05 * j + y, 0});
      }
    points.push_back(points[7]);  // a twin
    visit(Scene<D>{"points of a square",
                   D(points, test_clouds::near_pairs(points)),
                   places_of(points),
                   {{0, 1, 2}}});
  } else {
    const Surface left = grid(8, 8);
    Surface right = grid(8, 8);
    for (auto& p : right.positions) p[0] += 1;
    D domain;
    const auto a = domain.add(left.mesh<Real>(), left.positions);
    const auto b = domain.add(right.mesh<Real>(), right.positions);
    domain.weld(a, b, {.tolerance = 1e-9});
    auto places = places_of(left.positions);
    const auto more = places_of(right.positions);
    places.insert(places.end(), more.begin(), more.end());
    auto simplices = rows_of(left.faces);
    const auto others = rows_of(right.faces, b.first_vertex);
    simplices.insert(simplices.end(), others.begin(), others.end());
    visit(Scene<D>{"two squares welded", std::move(domain), places, simplices});
  }
}

}  // namespace plexway::testing
