#pragma once

// Solids with obstacles, as fine as one likes, with exact answers. Needs TetGen.

#include <string>
#include <utility>
#include <vector>

#include <plexway/solve.hpp>
#include <plexway/tetgen/tetrahedralize.hpp>

#include "data/convex_obstacles.hpp"
#include "data/obstacles.hpp"
#include "errors.hpp"

namespace bench {

struct SolidDomain {
  std::string name;
  std::vector<std::array<double, 3>> positions;
  std::vector<std::array<Index, 4>> tets;
  Truth truth;
};

inline Index nearest_vertex(const std::vector<std::array<double, 3>>& positions,
                            const samples::Point& at) {
  using namespace samples;
  const auto gap = [&](const Point& p) { return dot(p - at, p - at); };
  const auto best =
      std::min_element(positions.begin(), positions.end(),
                       [&](const Point& a, const Point& b) { return gap(a) < gap(b); });
  return static_cast<Index>(best - positions.begin());
}

/// TetGen keeps tetrahedra to about half of the largest volume allowed.
inline plexway::tetgen::TetrahedralizeOptions about(double tets, double volume) {
  plexway::tetgen::TetrahedralizeOptions options;
  options.max_volume = 2.8 * volume / tets;
  return options;
}

inline SolidDomain pipe_domain(double tets) {
  const samples::PipePrism pipe{samples::PipePrism::sides_for(tets)};
  plexway::tetgen::PiecewiseLinearComplex boundary;
  const Index n = pipe.sides;
  for (const double z : {0., pipe.height})
    for (const double radius : {pipe.inner, pipe.outer})
      for (Index i = 0; i < n; ++i) boundary.positions.push_back(pipe.corner(i, radius, z));
  for (const Index ring : {Index{0}, n})
    for (Index i = 0; i < n; ++i) {
      const Index a = ring + i, b = ring + (i + 1) % n;
      boundary.facets.push_back({{{a, b, b + 2 * n, a + 2 * n}}, {}});
    }
  for (const Index end : {Index{0}, 2 * n}) {
    std::vector<Index> inner, outer;
    for (Index i = 0; i < n; ++i) inner.push_back(end + i), outer.push_back(end + n + i);
    boundary.facets.push_back({{outer, inner}, {{0, 0, end == 0 ? 0 : pipe.height}}});
  }
  boundary.holes.push_back({0, 0, pipe.height / 2});
  auto solid = plexway::tetgen::tetrahedralize(boundary, about(tets, pipe.volume()));
  SolidDomain domain{"pipe", std::move(solid.positions), std::move(solid.tets), {}};
  domain.truth.source = nearest_vertex(domain.positions, {-0.8, 0.1, 0.2});
  domain.truth.distance = pipe.distances(domain.positions, domain.positions[domain.truth.source]);
  return domain;
}

inline SolidDomain cavity_domain(double tets) {
  const samples::Shape surface = samples::ball_in_cube(samples::ball_parts_for(tets));
  const std::vector<samples::Point> holes = {{0, 0, 0}};
  auto solid = plexway::tetgen::tetrahedralize(surface.points, surface.faces, holes,
                                               about(tets, 8 - samples::pi / 6));
  SolidDomain domain{"cavity", std::move(solid.positions), std::move(solid.tets), {}};
  domain.truth.source = nearest_vertex(domain.positions, {-0.8, 0.1, 0.05});
  domain.truth.distance =
      samples::around_ball(domain.positions, domain.positions[domain.truth.source], 0.5);
  return domain;
}

/// The cube from -1 to 1 around convex obstacles; no truth.
inline SolidDomain obstacle_domain(const samples::Obstacles& obstacles, double tets) {
  plexway::tetgen::PiecewiseLinearComplex boundary;
  const auto add = [&](const samples::Polyhedron& block) {
    const auto first = static_cast<Index>(boundary.positions.size());
    boundary.positions.insert(boundary.positions.end(), block.points.begin(), block.points.end());
    for (std::vector<Index> face : block.faces) {
      for (Index& corner : face) corner += first;
      boundary.facets.push_back({{std::move(face)}, {}});
    }
  };
  add(samples::Polyhedron::block({1, 1, 1}, {0, 0, 0}));
  for (const samples::Polyhedron& block : obstacles.blocks) {
    add(block);
    boundary.holes.push_back(block.middle);
  }
  auto solid = plexway::tetgen::tetrahedralize(boundary, about(tets, 8));
  return {obstacles.name, std::move(solid.positions), std::move(solid.tets), {}};
}

/// Errors of distances from one source, relative, against ways around obstacles by brute force.
struct ObstacleErrors {
  std::size_t count = 0;
  double sum = 0, worst = 0, in_sight = 0, below = 0;

  [[nodiscard]] double mean() const { return sum / static_cast<double>(count); }
};

/// Of these executors' distances, which it takes by solve(mesh, source) as vectors, the errors of
/// each. Sources: vertices far from the obstacles, a vertex just off an edge, and a point in a
/// tetrahedron just off a face; `most` of them.
template <class Real, class... Solve>
std::array<ObstacleErrors, sizeof...(Solve)> obstacle_errors(const samples::Obstacles& obstacles,
                                                             double tets, int parts,
                                                             std::size_t most,
                                                             const Solve&... solve) {
  using namespace samples;
  const SolidDomain domain = obstacle_domain(obstacles, tets);
  const plexway::TetMesh<Real> mesh(domain.positions, domain.tets);
  const Polyhedron& first = obstacles.blocks[0];
  std::vector<std::pair<plexway::PointSource, Point>> sources;
  const auto at_vertex = [&](const Point& p) {
    const Index v = nearest_vertex(domain.positions, p);
    sources.push_back({plexway::PointSource::at(v), domain.positions[v]});
  };
  const Point edge = first.points[0] + .3 * (first.points[1] - first.points[0]);
  at_vertex(edge + .04 * unit(edge - first.middle));
  {
    const Point p = 1 / 3. * (first.points[0] + first.points[1] + first.points[2]) +
                    .05 * first.planes[0].normal;
    std::vector<Point> middles;
    for (const auto& tet : domain.tets) {
      Point middle{};
      for (const Index v : tet) middle = middle + .25 * domain.positions[v];
      middles.push_back(middle);
    }
    const Index tet = nearest_vertex(middles, p);
    const std::array<double, 4> weight = {.2, .3, .15, .35};
    Point at{};
    for (std::size_t i = 0; i < 4; ++i) at = at + weight[i] * domain.positions[domain.tets[tet][i]];
    sources.push_back({plexway::PointSource::in(tet, weight), at});
  }
  for (const Point& p : {Point{-.83, .11, .17}, {.61, -.72, .43}, {-.2, -.9, -.85}}) at_vertex(p);
  if (sources.size() > most) sources.resize(most);

  std::array<ObstacleErrors, sizeof...(Solve)> errors{};
  WaysAround ways(obstacles.blocks, parts);
  for (const auto& [source, at] : sources) {
    ways.start(at);
    const std::vector<std::vector<double>> fields = {solve(mesh, source)...};
    for (std::size_t v = 0; v < domain.positions.size(); ++v) {
      const double truth = ways.to(domain.positions[v]);
      if (!(truth > 0)) continue;
      for (std::size_t n = 0; n < fields.size(); ++n) {
        const double error = fields[n][v] / truth - 1;
        ObstacleErrors& e = errors[n];
        ++e.count;
        e.sum += std::abs(error);
        e.worst = std::max(e.worst, std::abs(error));
        e.below = std::min(e.below, error);
        if (ways.sees(at, domain.positions[v])) e.in_sight = std::max(e.in_sight, std::abs(error));
      }
    }
  }
  return errors;
}

}  // namespace bench
