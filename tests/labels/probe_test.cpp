#include <catch2/catch.hpp>

#include <set>

#include <plexway/error.hpp>

#include "labels/plain_rule.hpp"
#include "labels/solving.hpp"

namespace plexway::testing::probe_test {
using namespace detail;

namespace {

// The published table as it is printed, sixteen entries by four bits.
double as_printed(double shared, double second, double third, double height) {
  constexpr double table[16] = {.320991,  .446887,  .595879,  .270094, .236679,  .159685,
                                .0872932, .434132,  1.0,      .726262, .0635997, .0515979,
                                .56903,   .0447586, .0612103, .718198};
  const double longest = std::max({shared, second, third});
  const double shortest = std::min({shared, second, third});
  return table[(longest > 5.1424 * shared) + 2 * (longest > 4.20638 * shortest) +
               4 * (height < 0.504201 * shared) + 8 * (height < 2.84918 * longest)];
}

}  // namespace

TEMPLATE_TEST_CASE("six entries say what the printed table of sixteen says", "", float, double) {
  const ProbeAim<TestType> aim(Visibility::tuned, ProbeTable::published());
  std::set<double> found;
  std::mt19937 random(1);
  int different = 0;
  for (int n = 0; n < 100000; ++n) {
    // Second corner at (1, 0), third anywhere from needle to sliver.
    const double reach = std::pow(10, 8 * uniform(random) - 4);
    const double x = reach * (2 * uniform(random) - 1) + (n % 2 ? 1 : 0);
    const double h = reach * std::pow(10, -6 * uniform(random));
    const double printed = as_printed(1, std::hypot(x - 1, h), std::hypot(x, h), h);
    const TestType here = aim.share(TestType(1), TestType(std::hypot(x - 1, h)),
                                    TestType(std::hypot(x, h)), TestType(h));
    different += here != TestType(printed);
    found.insert(printed);
  }
  CHECK(found.size() == 6);
  CHECK(different <= 2);  // on a threshold, by rounding
}

TEST_CASE("a table is data of a solve") {
  const Surface s = grid(12, 12);
  const TriangleMesh<double> mesh(s.positions, s.faces);
  PropagateOptions tuned;
  tuned.visibility = Visibility::tuned;
  PropagateOptions other;
  for (const auto& [share, policy] :
       {std::pair{1.0, Visibility::centroid}, std::pair{0.0, Visibility::upper_bound}}) {
    tuned.probe = {5, 4, .5, {share, share, share, share, share, share}};
    other.visibility = policy;
    CHECK(solve(mesh, PointSource::at(5), tuned) == solve(mesh, PointSource::at(5), other));
  }
  tuned.probe.share[3] = 1.6;
  CHECK_THROWS_AS(solve(mesh, PointSource::at(5), tuned), UsageError);
  tuned.probe.share[3] = std::nan("");
  CHECK_THROWS_AS(solve(mesh, PointSource::at(5), tuned), UsageError);
}

}  // namespace plexway::testing::probe_test
