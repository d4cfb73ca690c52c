// Lines through a solid: straight over clear space they come to where walking comes, and a line
// that starts outside of its tetrahedron ends.

#include <algorithm>
#include <catch2/catch.hpp>
#include <numeric>
#include <random>
#include <vector>

#include "complex/test_solids.hpp"
#include "propagate/lit_tets.hpp"
#include "propagate/solid_clear_space.hpp"
#include "propagate/solid_lines.hpp"
#include "propagate/solid_rule.hpp"

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

TEMPLATE_TEST_CASE("lines over clear space come to where walked lines come", "", float, double) {
  const Solid solid = chambers(24);
  const auto mesh = solid.mesh<TestType>();
  SolidClearSpace<TestType> clear;
  clear.measure(mesh);
  REQUIRE(!clear.empty());
  NoFront<TestType> front;
  SolidRule<TestType, NoFront<TestType>> rule(mesh, front);
  rule.skip(clear);
  std::mt19937 random(3);
  const auto tets = static_cast<Index>(mesh.tet_count());
  std::size_t free = 0, skipped = 0;
  for (int n = 0; n < 20000; ++n) {
    const Index start = plexway::testing::below(random, tets);
    const Index end = plexway::testing::below(random, tets);
    const auto from = point_in(mesh, start, random), to = point_in(mesh, end, random);
    Index walked = start, went = start;
    const bool reaches = rule.walk(walked, from, to);
    REQUIRE(rule.go(went, from, to) == reaches);
    if (!reaches) continue;
    ++free;
    CHECK(walked == end);
    CHECK(went == end);
    // Does it ever skip anything?
    skipped += clear.next(from, to, 0, 3 / norm(to - from)).tet != none;
  }
  CHECK(free > 5000);
  CHECK(20000 - free > 5000);
  CHECK(skipped > 5000);
}

TEMPLATE_TEST_CASE("walking leads to a source from tetrahedra that it is known to see whole", "",
                   float, double) {
  const Solid solid = chambers(24);
  const auto mesh = solid.mesh<TestType>();
  NoFront<TestType> front;
  const SolidRule<TestType, NoFront<TestType>> rule(mesh, front);
  const auto tets = static_cast<Index>(mesh.tet_count());
  LitTets<TestType> lit;
  lit.start(tets);
  std::mt19937 random(5);
  std::size_t seen = 0, known = 0;
  for (int source = 0; source < 6; ++source) {
    const Index home = plexway::testing::below(random, tets);
    const auto at =
        source < 3 ? point_in(mesh, home, random) : mesh.points()[mesh.tets()[home].corner[0]];
    std::vector<Index> nearest_first(tets);
    std::iota(nearest_first.begin(), nearest_first.end(), Index{0});
    const auto far = [&](Index t) { return norm(mesh.tets()[t].centre - at); };
    std::sort(nearest_first.begin(), nearest_first.end(),
              [&](Index t, Index u) { return far(t) < far(u); });
    for (const Index t : nearest_first) lit.look(mesh, t, at, [](Index) { return true; });
    for (int n = 0; n < 4000; ++n) {
      const Index t = plexway::testing::below(random, tets);
      Index walked = t;
      const bool sees = rule.walk(walked, point_in(mesh, t, random), at);
      seen += sees;
      known += lit.by(t, at);
      if (lit.by(t, at)) CHECK(sees);
    }
  }
  CAPTURE(seen, known);
  CHECK(2 * known > seen);
}

TEST_CASE("clear space is that of one solid, and is none where it overlaps itself") {
  const Solid one = chambers(24);
  SolidClearSpace<float> clear;
  clear.measure(one.mesh<float>());
  CHECK(!clear.empty());
  Solid twice = one;  // two solids in one place
  const Index n = static_cast<Index>(one.positions.size());
  twice.positions.insert(twice.positions.end(), one.positions.begin(), one.positions.end());
  for (auto t : one.tets) {
    for (Index& v : t) v += n;
    twice.tets.push_back(t);
  }
  clear.measure(twice.mesh<float>());
  CHECK(clear.empty());
  clear.measure(one.mesh<float>());
  CHECK(!clear.empty());
  clear.measure(plexway::testing::solid_cube(12).mesh<float>());  // nothing hides anything
  CHECK(clear.empty());
}

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
