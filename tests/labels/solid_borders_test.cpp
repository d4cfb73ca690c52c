// Vertices between the cells of several sources in a solid: each knows its own source, though no
// tetrahedron around it may have its label.

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <plexway/simplicial/kuhn_grid.hpp>
#include <plexway/solid/tet_mesh.hpp>
#include <plexway/solve.hpp>
#include <plexway/solve/workspace.hpp>

namespace plexway::solid_borders_test {

TEST_CASE("several sources in a cube: straight lines, whoever works") {
  std::mt19937 random(5);
  const auto share = [&] { return static_cast<double>(random()) / 4294967296.; };
  constexpr std::size_t n = 9;
  const KuhnGrid<3> grid({n, n, n}, {1, 1, 1});
  const auto tets = grid.simplices();
  for (const std::size_t count : {2, 5, 20, 200, 600}) {
    std::vector<std::array<double, 3>> places;
    for (Index v = 0; v < grid.vertex_count(); ++v) {
      places.push_back(grid.position(v));
      for (double& x : places.back())
        if (x > .5 && x < n - .5) x += .3 * share() - .15;
    }
    const TetMesh<double> cube(places, tets);
    std::vector<PointSource> sources;
    std::vector<double> truth(places.size(), std::numeric_limits<double>::infinity());
    for (std::size_t k = 0; k < count; ++k) {
      const auto v = static_cast<Index>(random() % places.size());
      sources.push_back(PointSource::at(v));
      sources.back().offset = count % 2 == 0 ? 0 : 2 * share();
      for (std::size_t w = 0; w < places.size(); ++w)
        truth[w] = std::min(truth[w], sources[k].offset + std::hypot(places[w][0] - places[v][0],
                                                                     places[w][1] - places[v][1],
                                                                     places[w][2] - places[v][2]));
    }
    const auto field = solve(Serial{}, cube, sources);
    for (std::size_t w = 0; w < places.size(); ++w) {
      CAPTURE(count, w);
      CHECK(std::abs(field.distance[w] - truth[w]) <= 1e-12);
      const PointSource& s = sources[field.label[w]];
      CHECK(std::abs(s.offset +
                     std::hypot(places[w][0] - places[s.vertex][0],
                                places[w][1] - places[s.vertex][1],
                                places[w][2] - places[s.vertex][2]) -
                     truth[w]) <= 1e-12);
    }
    for (const int threads : {1, 2, 3, 8}) {
      const auto by_team = solve(OpenMP{threads}, cube, sources);
      for (std::size_t w = 0; w < places.size(); ++w)
        CHECK(std::abs(by_team.distance[w] - truth[w]) <= 1e-12);
    }
  }
}

}  // namespace plexway::solid_borders_test
