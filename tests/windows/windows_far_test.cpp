#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "data/long_strips.hpp"
#include "windows/windows_solving.hpp"

namespace plexway::testing::windows_far_test {

namespace {

struct Off {
  double mean = 0, worst = 0;
};

/// How far off distances in a flat strip are that is so many edges long.
template <class Real>
Off off_in(const TriangleMesh<Real>& mesh, const samples::LongStrip& strip) {
  const auto distance = solve_windows(mesh, {PointSource::at(0)}, Accuracy::accurate());
  Off off;
  for (Index v = 1; v < strip.vertices(); ++v) {
    const double e = std::abs(distance[v] / strip.between(0, v) - 1);
    off.mean += e / (strip.vertices() - 1);
    off.worst = std::max(off.worst, e);
  }
  return off;
}

}  // namespace

TEMPLATE_TEST_CASE("merged windows: strips very many edges long", "", float, double) {
  for (const Index edges : {Index{10000}, Index{100000}}) {
    const samples::LongStrip strip(edges, 2, 1);
    const auto check = [&, edges](const TriangleMesh<TestType>& mesh, const std::string& form) {
      const Off off = off_in(mesh, strip);
      CAPTURE(edges, form, off.mean, off.worst);
      CHECK(off.mean <= (edges == 10000 ? 1e-4 : 3e-5));
      CHECK(off.worst <= 2e-4);
    };
    check({strip.vertices(), strip.faces, strip.lengths()}, "by lengths alone");
    check({strip.wound(), strip.faces}, "wound up");
    const Off flat = off_in(TriangleMesh<TestType>(strip.in_plane(), strip.faces), strip);
    CHECK(flat.mean <= 1e-7);
  }
}

}  // namespace plexway::testing::windows_far_test
