#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include <plexway/complex/kuhn_grid.hpp>
#include <plexway/complex/tet_mesh.hpp>
#include <plexway/solve.hpp>

#include "fuzz/fuzz_plan.hpp"
#include "plan_errors.hpp"

/// Several sources at once in solids.
namespace bench {

/// Where sources are, and their offsets.
struct PlacedSources {
  std::vector<plexway::PointSource> sources;
  std::vector<fuzz::Place> at;

  void add(const plexway::PointSource& source, const fuzz::Place& place) {
    sources.push_back(source);
    at.push_back(place);
  }
  /// By straight lines.
  [[nodiscard]] Distances straight(const std::vector<fuzz::Place>& places) const {
    Distances truth;
    for (const fuzz::Place& p : places) {
      truth.push_back(std::numeric_limits<double>::infinity());
      for (std::size_t n = 0; n < at.size(); ++n)
        truth.back() = std::min(truth.back(), sources[n].offset + fuzz::Graph::straight(p, at[n]));
    }
    return truth;
  }
};

/// A cube of 6 to 20 cells a side; vertices inside moved by up to `jitter` of a cell.
struct RandomCube {
  std::size_t cells;
  std::vector<fuzz::Place> places;
  std::vector<std::array<plexway::Index, 4>> tets;

  RandomCube(Random& random, double jitter) : cells(6 + random() % 15) {
    const double cell = 1. / static_cast<double>(cells);
    const plexway::KuhnGrid<3> grid({cells, cells, cells}, {cell, cell, cell});
    for (plexway::Index v = 0; v < grid.vertex_count(); ++v) {
      places.push_back(grid.position(v));
      if (jitter > 0)
        for (double& x : places.back())
          if (x > cell / 2 && x < 1 - cell / 2) x += (2 * share(random) - 1) * jitter * cell;
    }
    tets = grid.simplices();
  }
  void solve(const PlacedSources& from, PlanErrors& errors) const {
    const plexway::TetMesh<double> cube(places, tets);
    errors.add(plexway::solve(plexway::Serial{}, cube, from.sources).distance,
               from.straight(places));
  }
};

/// So many vertices of the grid as it is.
inline void solve_cube(Random& random, std::size_t count, PlanErrors& errors) {
  const RandomCube cube(random, 0);
  PlacedSources from;
  for (std::size_t n = 0; n < count; ++n) {
    const auto v = static_cast<plexway::Index>(random() % cube.places.size());
    from.add(plexway::PointSource::at(v), cube.places[v]);
  }
  cube.solve(from, errors);
}

/// Vertices and points of tetrahedra, in every other draw with offsets, on a grid whose vertices
/// are moved.
inline void solve_moved_cube(Random& random, std::size_t count, PlanErrors& errors) {
  const RandomCube cube(random, .15);
  const double most = random() % 2 == 0 ? 0 : share(random) / 4;
  PlacedSources from;
  for (std::size_t n = 0; n < count; ++n) {
    const auto t = static_cast<plexway::Index>(random() % cube.tets.size());
    std::array<double, 4> b = {1, 0, 0, 0};
    if (random() % 2 == 0) {
      for (double& x : b) x = .05 + share(random);
      const double sum = b[0] + b[1] + b[2] + b[3];
      for (double& x : b) x /= sum;
    }
    fuzz::Place at = {0, 0, 0};
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t k = 0; k < 3; ++k) at[k] += b[i] * cube.places[cube.tets[t][i]][k];
    plexway::PointSource source = plexway::PointSource::in(t, b);
    source.offset = most * share(random);
    from.add(source, at);
  }
  cube.solve(from, errors);
}

/// All vertices of the boundary.
inline void solve_from_boundary(Random& random, PlanErrors& errors) {
  const RandomCube cube(random, .15);
  PlacedSources from;
  for (plexway::Index v = 0; v < cube.places.size(); ++v)
    if (std::any_of(cube.places[v].begin(), cube.places[v].end(),
                    [](double x) { return x < 1e-9 || x > 1 - 1e-9; }))
      from.add(plexway::PointSource::at(v), cube.places[v]);
  cube.solve(from, errors);
}

/// In the prism over a plan, against the least of a field from each.
inline void solve_least(const fuzz::Cut& cut, Random& random, std::size_t count, double height,
                        PlanErrors& errors) {
  const fuzz::Prism prism = fuzz::prism_of(cut.shape, height);
  const plexway::TetMesh<double> solid(prism.places, prism.tets);
  std::vector<plexway::PointSource> sources;
  while (sources.size() < count) {
    const auto v = static_cast<plexway::Index>(random() % prism.places.size());
    sources.push_back(plexway::PointSource::at(v));
    sources.back().offset = random() % 2 == 0 ? 0 : share(random) / 4;
  }
  Distances least(prism.places.size(), std::numeric_limits<double>::infinity());
  for (const plexway::PointSource& source : sources) {
    const auto one = plexway::solve(plexway::Serial{}, solid, source).distance;
    for (std::size_t v = 0; v < least.size(); ++v) least[v] = std::min(least[v], one[v]);
  }
  errors.add(plexway::solve(plexway::Serial{}, solid, sources).distance, least);
}

}  // namespace bench
