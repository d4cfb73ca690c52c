#include <string>

#include <catch2/catch.hpp>

#include <numbers>

#include "labels/solving.hpp"
#include "with_accuracy.hpp"

namespace plexway::testing::flat_test {

namespace {

template <class Real>
constexpr double exact_to = sizeof(Real) == 4 ? 1e-5 : 1e-12;

Surface squashed(Surface s, double by) {
  for (Position& p : s.positions) p[1] *= by;
  return s;
}

/// All shapes a flat convex domain's triangles can have.
std::vector<std::pair<const char*, Surface>> flat_surfaces() {
  std::vector<std::pair<const char*, Surface>> list = {
      {"one triangle", {{{0, 0, 0}, {1, 0, 0}, {0.3, 2, 0}}, {{0, 1, 2}}}},
      {"grid", grid(17, 13)},
      {"20:1 grid", grid(40, 40, 40, 2)},
      {"1000:1 grid", grid(12, 12, 12000, 12)},
      {"1e6:1 grid", grid(12, 12, 1.2e7, 12)},
      {"1:1e6 grid", grid(12, 12, 12, 1.2e7)},
      {"shuffled grid", renamed(grid(20, 20), 3, true, true).surface},
  };
  for (unsigned seed = 1; seed <= 6; ++seed)
    list.emplace_back("random polygon", random_polygon(3 + seed, 100, 80 * (seed - 1), seed));
  for (const double by : {1e-3, 1e-6})
    list.emplace_back("squashed polygon", squashed(random_polygon(7, 120, 200, 9), by));
  return list;
}

}  // namespace

TEMPLATE_TEST_CASE("flat convex surfaces are exact at any triangle shape", "", float, double) {
  for (const auto& [what, s] : flat_surfaces()) {
    const TriangleMesh<TestType> mesh(s.positions, s.faces);
    std::mt19937 random(7);
    for (int n = 0; n < 4; ++n) {
      const Index source = n == 0 ? 0 : below(random, s.positions.size());
      for (const Schedule schedule : schedules)
        for (const bool vectorised : {true, false}) {
          PropagateOptions options = by_labels();
          options.schedule = schedule;
          options.vectorised = vectorised;
          const Errors e = compare(solve(mesh, PointSource::at(source), options),
                                   straight(s, s.positions[source]));
          CAPTURE(what, name(options), source, s.positions.size());
          CHECK(e.fits);
          // Needles of a million to one cost single precision half a bit more: 1.4e-5 measured.
          const bool needles = sizeof(TestType) == 4 && std::string(what) == "squashed polygon";
          CHECK(e.max <= (needles ? 2e-5 : exact_to<TestType>));
        }
    }
  }
}

TEMPLATE_TEST_CASE("windows on flat convex surfaces", "", float, double) {
  for (const auto& [what, s] : flat_surfaces()) {
    const TriangleMesh<TestType> mesh(s.positions, s.faces);
    std::mt19937 random(7);
    for (int n = 0; n < 4; ++n) {
      const Index source = n == 0 ? 0 : below(random, s.positions.size());
      for (const Schedule schedule : schedules) {
        PropagateOptions options;
        options.schedule = schedule;
        const std::vector<double> exact = straight(s, s.positions[source]);
        const Errors e = compare(solve(mesh, PointSource::at(source), options), exact);
        CAPTURE(what, name(options), source, e.mean, e.max);
        CHECK(e.fits);
        // Needles of a million to one are more than windows of single precision hold; labels do.
        const bool needles = sizeof(TestType) == 4 && std::string(what) == "squashed polygon";
        CHECK(e.mean <= (needles ? 1e-3 : 2e-5));
        CHECK(e.max <= (needles ? 3e-2 : 3e-4));
        if (sizeof(TestType) == 4) continue;
        options.accuracy = Accuracy::exact();
        CHECK(compare(solve(mesh, PointSource::at(source), options), exact).max <= 1e-12);
      }
    }
  }
}

TEMPLATE_TEST_CASE("other policies on flat surfaces", "", float, double) {
  for (const auto& [what, s] : flat_surfaces()) {
    const TriangleMesh<TestType> mesh(s.positions, s.faces);
    for (const Visibility visibility : visibilities)
      for (const Schedule schedule : schedules) {
        PropagateOptions options = by_labels();
        options.visibility = visibility;
        options.schedule = schedule;
        const Errors e =
            compare(solve(mesh, PointSource::at(0), options), straight(s, s.positions[0]));
        CAPTURE(what, name(options), e.mean, e.max, e.below);
        CHECK(e.fits);
        CHECK(e.below >= -1e-4);
      }
  }
}

TEMPLATE_TEST_CASE("a flat surface standing askew in space is exact", "", float, double) {
  Surface s = random_polygon(6, 150, 300, 21);
  const double c = std::cos(0.7), w = std::sin(0.7);
  for (Position& p : s.positions)
    p = {c * p[0] - w * p[1] + 3, c * (w * p[0] + c * p[1]) - 5, w * (w * p[0] + c * p[1]) + 1};
  const TriangleMesh<TestType> mesh(s.positions, s.faces);
  for (const Index source : {0u, 20u, 77u}) {
    const auto worst = [&](const PropagateOptions& options) {
      return compare(solve(mesh, PointSource::at(source), options),
                     straight(s, s.positions[source]))
          .max;
    };
    CHECK(worst(by_labels()) <= exact_to<TestType>);
    CHECK(worst({}) <= 5e-5);
  }
}

TEMPLATE_TEST_CASE("a vertex at the end of a boundary edge from the source", "", float, double) {
  // Its other triangles take their labels from beyond x and cannot see along the edge.
  const Surface s = {{{0, 0, 0}, {1, 0, 0}, {.5, 1, 0}, {.1, .05, 0}},
                     {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
  const Surface mirrored = {{{0, 0, 0}, {-1, 0, 0}, {-.5, 1, 0}, {-.1, .05, 0}},
                            {{0, 3, 1}, {1, 3, 2}, {2, 3, 0}}};
  for (const Surface& surface : {s, mirrored})
    for (const Visibility visibility : visibilities) {
      PropagateOptions options;
      options.visibility = visibility;
      CAPTURE(name(options));
      CHECK(solve(surface.mesh<TestType>(), PointSource::at(0), options)[1] == Approx(1));
    }
}

}  // namespace plexway::testing::flat_test
