// Lines through a solid in a mixed domain: one that starts outside of its tetrahedron ends.

#include <catch2/catch.hpp>
#include <random>

#include "complexes/test_solids.hpp"
#include "labels/solid/solid_rule.hpp"
#include "labels/solid_lines.hpp"

namespace plexway::solid_walk_test {

namespace {

using plexway::testing::NoFront;
using plexway::testing::point_in;
using plexway::testing::Solid;

// A cube without a cube in the middle, and without a slab that leaves a gap.
Solid chambers(Index n) {
  return plexway::testing::cubes(n, n, n, 1.0 / n, 0.2, [n](Index i, Index j, Index k) {
    const auto middle = [n](Index x) { return 3 * x >= n && 3 * x < 2 * n; };
    const bool slab = i == n / 6 && j < 2 * n / 3;
    return !(middle(i) && middle(j) && middle(k)) && !slab;
  });
}

}  // namespace

TEST_CASE("a line that starts outside of its tetrahedron does not go round for ever") {
  const Solid solid = chambers(12);
  const auto mesh = solid.mesh<float>();
  NoFront<float> front;
  const SolidRule<float, NoFront<float>> rule(mesh, front);
  std::mt19937 random(4);
  const auto tets = static_cast<Index>(mesh.tet_count());
  // Each that goes round takes a thousand times as long as one that does not.
  for (int n = 0; n < 300000; ++n) {
    Index t = plexway::testing::below(random, tets);
    const Index beside = mesh.tets()[t].across[random() % 4] >> TetAcross::tet_shift;
    if (beside == tets) continue;
    const auto from = point_in(mesh, beside, random);
    (void)rule.walk(t, from, point_in(mesh, plexway::testing::below(random, tets), random));
  }
}

}  // namespace plexway::solid_walk_test
