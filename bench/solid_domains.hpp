#pragma once

// Solids with obstacles, as fine as one likes, with exact answers. Needs TetGen.

#include <string>
#include <vector>

#include <plexway/tetgen/tetrahedralize.hpp>

#include "../data/obstacles.hpp"
#include "harness.hpp"

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

}  // namespace bench
