#include <catch2/catch.hpp>

#include <span>

#include <plexway/solve.hpp>

#include "data/corner_domains.hpp"
#include "labels/solving.hpp"
#include "with_accuracy.hpp"

namespace plexway::testing::corners_test {

// Flat domains with corners, on grids so fine that most lines of sight pass a corner without
// touching a triangle at it; the exact distances are those of a visibility graph.

namespace {

struct Solved {
  Errors errors;
  double updates;  // a triangle
};

template <class Real, class Executor>
Solved solve_grid(const Executor& executor, const samples::CornerDomain& domain, Index n,
                  const PropagateOptions& options = {}) {
  const samples::Shape grid = domain.grid(n);
  const TriangleMesh<Real> mesh(grid.points, grid.faces);
  const auto field = solve(executor, mesh, PointSource::at(0), options);
  return {compare(field.distance, domain.distances(grid.points)),
          static_cast<double>(field.statistics.updates) / static_cast<double>(grid.faces.size())};
}

}  // namespace

TEST_CASE("the visibility graph of a notch is right where it can be said by hand") {
  const samples::CornerDomain notch = samples::corner_domains()[0];
  CHECK(notch.clear({.1, .2, 0}, {.4, .6, 0}));
  CHECK(notch.clear({.4, .1, 0}, {.4, .6, 0}));
  CHECK_FALSE(notch.clear({.1, .2, 0}, {.7, .6, 0}));
  const auto d = notch.distances({{.1, .2, 0}, {.1, 1, 0}, {.8, .1, 0}});
  CHECK(d[1] == Approx(.8).epsilon(1e-14));
  CHECK(d[2] == Approx(std::hypot(.3, .4) + .2 + std::hypot(.2, .5)).epsilon(1e-14));
}

TEMPLATE_TEST_CASE("no light leaks behind corners, however fine the grid", "", float, double) {
  for (const samples::CornerDomain& domain : samples::corner_domains())
    for (const Index n : {50u, 100u, 200u}) {
#ifdef PLEXWAY_SANITIZED
      if (n > 100) continue;
#endif
      for (const bool vectorised : {true, false}) {
        PropagateOptions options = by_labels();
        options.vectorised = vectorised;
        const Solved s = solve_grid<TestType>(Serial{}, domain, n, options);
        CAPTURE(domain.name, n, vectorised, s.errors.mean, s.errors.max, s.errors.below);
        CHECK(s.errors.fits);
        CHECK(s.errors.mean <= 2e-6);
        CHECK(s.errors.max <= 1e-3);
        CHECK(s.errors.below >= -1e-4);
        CHECK(s.updates <= 1.3);
      }
    }
}

TEMPLATE_TEST_CASE("merged light hardly leaks behind corners", "", float, double) {
  // Labels are exact in such domains, but for corners that they mistake; windows have the errors of
  // merging everywhere.
  for (const samples::CornerDomain& domain : samples::corner_domains())
    for (const Index n : {50u, 100u, 200u}) {
#ifdef PLEXWAY_SANITIZED
      if (n > 100) continue;
#endif
      const Solved s = solve_grid<TestType>(Serial{}, domain, n);
      CAPTURE(domain.name, n, s.errors.mean, s.errors.max, s.errors.below);
      CHECK(s.errors.fits);
      CHECK(s.errors.mean <= 1.5e-5);
      CHECK(s.errors.max <= 1e-3);
      CHECK(s.errors.below >= -3e-4);
    }
}

TEST_CASE("teams know of corners as one thread does") {
  for (const samples::CornerDomain& domain : samples::corner_domains()) {
    const Solved s = solve_grid<float>(OpenMP{2}, domain, 100, by_labels());
    CAPTURE(domain.name, s.errors.mean, s.errors.max, s.errors.below);
    CHECK(s.errors.fits);
    CHECK(s.errors.mean <= 2e-6);
    CHECK(s.errors.below >= -1e-4);
  }
}

}  // namespace plexway::testing::corners_test
