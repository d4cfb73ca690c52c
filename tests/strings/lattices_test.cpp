#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <memory>
#include <random>
#include <vector>

#include <plexway/solid/tet_mesh.hpp>

#include "data/cell_lattice.hpp"
#include "strings/solver.hpp"

// Strings in lattices of cubes, some left out at random, against the same ones with each cube cut
// in eight: corners where rows of edges meet, and edges and vertices where cubes only touch.

namespace plexway::testing::strings_lattices_test {
namespace {

std::vector<double> distances(const TetMesh<double>& mesh, Index from) {
  const strings::MediaSpace space(std::make_shared<const strings::SolidSpace>(mesh));
  strings::Solver solver(space);
  strings::Source source;
  source.point = mesh.inside_vertex(from);
  source.at = space.point(source.point);
  const std::array sources = {source};
  REQUIRE(solver.solve(sources, {}));
  std::vector<double> found;
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    found.push_back(solver.distance(mesh.inside_vertex(v)) * mesh.unit());
  return found;
}

TEST_CASE("strings in lattices are as long as in finer ones, but for few") {
  std::mt19937 random(1);
  constexpr int side = 5;
  std::size_t all = 0, longer = 0;
  double most = 0;
  for (int n = 0; n < 12; ++n) {
    const auto out = samples::CellLattice::left_out(side, .15, random);
    const samples::CellLattice coarse(side, out, 1), fine(side, out, 2);
    const std::array<int, 3> at = coarse.any_vertex(random);
    const auto found = distances({coarse.places, coarse.tets}, coarse.vertex(at)),
               finer = distances({fine.places, fine.tets}, fine.vertex(at));
    coarse.each_vertex([&](const std::array<int, 3>& p) {
      const double a = found[coarse.vertex(p)], b = finer[fine.vertex(p)];
      const double straight = std::hypot(p[0] - at[0], p[1] - at[1], p[2] - at[2]);
      CAPTURE(n, at, p);
      REQUIRE(std::isfinite(a) == std::isfinite(b));
      if (!std::isfinite(a)) return;
      CHECK(a >= straight * (1 - 1e-12));
      ++all;
      longer += a > b * (1 + 1e-3);
      if (b > 0) most = std::max(most, a / b - 1);
    });
  }
  CAPTURE(all, longer, most);
  CHECK(all > 2000);
  CHECK(longer * 500 < all);
  CHECK(most < .02);
}

}  // namespace
}  // namespace plexway::testing::strings_lattices_test
