#include <catch2/catch.hpp>

#include <algorithm>
#include <numeric>

#include "labels/solid_closed_forms.hpp"
#include "labels/solid_solving.hpp"

namespace plexway::testing::solid_exact_test {

TEST_CASE("a convex solid is exact") {
  for (const double jitter : {0.0, 0.2}) {
    const Solid s = moved(solid_cube(9, jitter), 3.7, {5, -2, 1});
    for (const Index source : {Index(0), s.nearest(5, 0, 2), Index(999)}) {
      const auto field = plexway::solve(Serial{}, s.mesh<double>(), PointSource::at(source));
      const Errors e = compare(field.distance, straight(s, s.positions[source]));
      CAPTURE(jitter, source, e.max);
      CHECK(e.fits);
      CHECK(e.max < 1e-12);
      const double updates = static_cast<double>(field.statistics.updates);
      CHECK(updates < 1.05 * static_cast<double>(s.tets.size()));
      const Errors f = compare(solve(s.mesh<float>(), PointSource::at(source)),
                               straight(s, s.positions[source]));
      CHECK(f.fits);
      CHECK(f.max < 2e-5);
    }
  }
}

TEST_CASE("a convex solid is exact from inside a tetrahedron, by any schedule") {
  const Solid s = solid_cube(6);
  for (const std::array<double, 4>& b : {std::array<double, 4>{.1, .2, .3, .4},
                                         {.25, .25, .25, .25},
                                         {.5, .5, 0, 0},
                                         {0, 1, 0, 0},
                                         {0, .3, .3, .4}})
    for (const Index tet : {Index(0), Index(700)})
      for (const Schedule schedule : schedules) {
        Position at = {0, 0, 0};
        for (std::size_t i = 0; i < 4; ++i)
          for (std::size_t d = 0; d < 3; ++d) at[d] += b[i] * s.positions[s.tets[tet][i]][d];
        PropagateOptions options;
        options.schedule = schedule;
        const Errors e =
            compare(solve(s.mesh<double>(), PointSource::in(tet, b), options), straight(s, at));
        CAPTURE(tet, e.max, name(options));
        CHECK(e.max < 1e-11);
      }
}

TEST_CASE("around one reflex edge") {
  for (const Index n : {6u, 12u, 16u}) {
    const Solid s = l_shape(n);
    for (const Position& from : {Position{1, 0, 0}, {1, .5, .5}, {.9, .3, .4}, {0, 0, 1}}) {
      const Index source = s.nearest(from[0], from[1], from[2]);
      const Errors e = compare(solve(s.mesh<double>(), PointSource::at(source)),
                               around_l(s, s.positions[source]));
      CAPTURE(n, source, e.mean, e.max, e.below);
      CHECK(e.fits);
      CHECK(e.mean < 1e-12);
      CHECK(e.max < 1e-8);
    }
  }
}

TEST_CASE("over a thick wall") {
  const Solid s = walled(16);
  for (const Position& from : {Position{0, 0, 0}, {.25, .5, .5}, {0, 1, .3}}) {
    const Index source = s.nearest(from[0], from[1], from[2]);
    const Errors e = compare(solve(s.mesh<double>(), PointSource::at(source)),
                             over_wall(s, s.positions[source]));
    CAPTURE(source, e.mean, e.max, e.below);
    CHECK(e.fits);
    CHECK(e.mean < 1e-12);
    CHECK(e.max < 1e-8);
  }
}

TEST_CASE("through an edge that two solids share") {
  const Solid s = edge_touch(8);
  const Index source = s.nearest(0, 0, 0);
  std::vector<double> exact;
  for (const Position& p : s.positions) {
    const double one = std::sqrt(.5), two = std::hypot(p[0] - .5, p[1] - .5);
    exact.push_back(std::max(p[0], p[1]) > .5 ? over(one + two, p[2])
                                              : std::hypot(p[0], p[1], p[2]));
  }
  const Errors e = compare(solve(s.mesh<double>(), PointSource::at(source)), exact);
  CAPTURE(e.mean, e.max, e.below);
  CHECK(e.fits);
  CHECK(e.mean < 1e-2);
  for (const Visibility visibility : {Visibility::centroid, Visibility::upper_bound}) {
    PropagateOptions options;
    options.visibility = visibility;
    const Errors plain = compare(solve(s.mesh<double>(), PointSource::at(source), options), exact);
    CAPTURE(name(options), plain.mean, plain.below);
    CHECK(plain.fits);
    CHECK(plain.mean < 5e-2);
    if (visibility == Visibility::upper_bound) CHECK(plain.below > -1e-12);
  }
}

TEST_CASE("through a vertex that two solids share") {
  const Solid s = vertex_touch(6);
  const Index source = s.nearest(0, 0, 0);
  std::vector<double> exact;
  for (const Position& p : s.positions)
    exact.push_back(std::max({p[0], p[1], p[2]}) > .5
                        ? std::sqrt(.75) + std::hypot(p[0] - .5, p[1] - .5, p[2] - .5)
                        : std::hypot(p[0], p[1], p[2]));
  for (const Visibility visibility : solid_visibilities) {
    PropagateOptions options;
    options.visibility = visibility;
    const Errors e = compare(solve(s.mesh<double>(), PointSource::at(source), options), exact);
    CAPTURE(name(options), e.mean, e.max);
    CHECK(e.fits);
    if (visibility == Visibility::saddles) CHECK(e.max < 1e-11);
  }
}

TEST_CASE("upper bounds are bounds, and lengths alone give the plain step") {
  for (const Solid& s : {solid_cube(7), l_shape(8)}) {
    const Index source = s.nearest(1, 0, 0);
    const auto exact = around_l(s, s.positions[source]);
    PropagateOptions options;
    options.visibility = Visibility::upper_bound;
    const TetMesh<double> lengths(s.positions.size(), s.tets, s.lengths());
    CHECK(!lengths.embedded());
    const bool convex = s.mesh<double>().summary().reflex_edges == 0;
    for (const auto& d : {solve(s.mesh<double>(), PointSource::at(source), options),
                          solve(lengths, PointSource::at(source), options)}) {
      const Errors e = compare(d, convex ? straight(s, s.positions[source]) : exact);
      CAPTURE(convex, e.mean, e.max, e.below);
      CHECK(e.fits);
      CHECK(e.below > -1e-9);
      CHECK(e.mean < 1e-1);
    }
    const Errors plain = compare(solve(lengths, PointSource::at(source)),
                                 convex ? straight(s, s.positions[source]) : exact);
    CAPTURE(plain.mean, plain.below);
    CHECK(plain.fits);
    CHECK(plain.mean < 1e-2);
  }
}

TEMPLATE_TEST_CASE("grids given by lengths alone are exact", "", float, double) {
  for (const Index n : {6u, 12u})
    for (const Position& stretch : {Position{1, 1, 1}, {3, 1, 1}, {1, 1, 3}}) {
      Solid s = solid_cube(n, 0);
      for (Position& p : s.positions)
        for (std::size_t i = 0; i < 3; ++i) p[i] *= stretch[i];
      const TetMesh<TestType> mesh(s.positions.size(), s.tets, s.lengths());
      for (const Index source : {Index{0}, static_cast<Index>(s.positions.size() / 2), n}) {
        const Errors e =
            compare(solve(mesh, PointSource::at(source)), straight(s, s.positions[source]));
        CAPTURE(n, source, stretch[0], e.mean, e.max, e.below);
        CHECK(e.fits);
        CHECK(e.max < (sizeof(TestType) == 4 ? 5e-6 : 1e-14));
      }
    }
}

}  // namespace plexway::testing::solid_exact_test
