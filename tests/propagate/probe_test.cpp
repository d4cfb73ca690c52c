#include <catch2/catch.hpp>

#include <set>

#include <plexway/propagate/probe.hpp>

#include "propagate/solving.hpp"

using namespace plexway;
using namespace plexway::testing;

TEMPLATE_TEST_CASE("only six entries of the tuned table occur", "", float, double) {
  const std::set<TestType> possible = {TestType(1.0),    TestType(.0635997), TestType(.0515979),
                                       TestType(.56903), TestType(.0612103), TestType(.718198)};
  std::set<TestType> found;
  std::mt19937 random(1);
  for (int n = 0; n < 200000; ++n) {
    // Second corner at (1, 0), third anywhere from needle to sliver.
    const double reach = std::pow(10, 8 * uniform(random) - 4);
    const double x = reach * (2 * uniform(random) - 1) + (n % 2 ? 1 : 0);
    const double h = reach * std::pow(10, -6 * uniform(random));
    found.insert(tuned_probe(TestType(1), TestType(std::hypot(x - 1, h)),
                             TestType(std::hypot(x, h)), TestType(h)));
  }
  CHECK(found == possible);
}

TEST_CASE("probes by policy") {
  CHECK(probe_share(Visibility::centroid, 1., 1., 1., .8) == 1);
  CHECK(probe_share(Visibility::upper_bound, 1., 1., 1., .8) == 0);
  CHECK(probe_share(Visibility::tuned, 1., 1., 1., .866) == 1);
  CHECK(probe_share(Visibility::tuned, 1., 10., 10., 9.9) == .0515979);
}
