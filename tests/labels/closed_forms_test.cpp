#include <catch2/catch.hpp>

#include <numbers>

#include "labels/cone.hpp"
#include "labels/solving.hpp"

namespace plexway::testing::closed_forms_test {

namespace {

/// Default within `mean` and `max`; upper_bound never below; all others finite in the right places.
template <class Real>
void check_policies(const TriangleMesh<Real>& mesh, const PointSource& source,
                    const std::vector<double>& exact, double mean, double max) {
  for (const Visibility visibility : visibilities)
    for (const Schedule schedule : schedules) {
      PropagateOptions options;
      options.visibility = visibility;
      options.schedule = schedule;
      const Errors e = compare(solve(mesh, source, options), exact);
      CAPTURE(name(options), e.mean, e.max, e.below);
      CHECK(e.fits);
      if (visibility == Visibility::upper_bound) CHECK(e.below >= -1e-4);
      if (visibility != Visibility::saddles) continue;
      CHECK(e.mean <= mean);
      CHECK(e.max <= max);
    }
}

template <class Real>
void check_policies(const Surface& s, Index source, const std::vector<double>& exact, double mean,
                    double max) {
  check_policies(s.mesh<Real>(), PointSource::at(source), exact, mean, max);
}

double bent(const Position& a, const Position& corner, const Position& b) {
  return std::hypot(a[0] - corner[0], a[1] - corner[1]) +
         std::hypot(b[0] - corner[0], b[1] - corner[1]);
}

}  // namespace

TEMPLATE_TEST_CASE("a cube from one of its corners", "", float, double) {
  const Surface s = cube(12);
  // Far faces unfold over either of the two near faces beside them.
  const std::vector<double> exact = by_rule(s, [](Position p) {
    std::sort(p.begin(), p.end());
    if (p[0] == 0) return std::hypot(p[1], p[2]);
    return std::min(std::hypot(1 + p[0], p[1]), std::hypot(1 + p[1], p[0]));
  });
  check_policies<TestType>(s, s.nearest(0, 0, 0), exact, 1e-3, 2e-2);
}

TEMPLATE_TEST_CASE("a tetrahedron from one of its corners", "", float, double) {
  Surface s = tetrahedron();
  for (int i = 0; i < 4; ++i) s = subdivide(s);
  const Surface corners = tetrahedron();
  const std::vector<double> exact = by_rule(s, [&](const Position& p) {
    if (p[2] > 1e-9)
      return std::hypot(p[0] - .5, p[1] - std::sqrt(.75) / 3, p[2] - std::sqrt(2. / 3));
    double least = 1e300;  // from the top's three images beside the base
    for (std::size_t i = 0; i < 3; ++i) {
      const Position &a = corners.positions[i], &b = corners.positions[(i + 1) % 3];
      const Position& c = corners.positions[(i + 2) % 3];
      least = std::min(least, std::hypot(p[0] - a[0] - b[0] + c[0], p[1] - a[1] - b[1] + c[1]));
    }
    return least;
  });
  check_policies<TestType>(s, 3, exact, 1e-3, 2e-2);
}

TEMPLATE_TEST_CASE("a prism unrolls", "", float, double) {
  const Index n = 24;
  const Surface s = prism(n, 15, 15);
  const Index source = 7 * n + 5;
  std::vector<double> exact;
  for (Index v = 0; v < s.positions.size(); ++v) {
    const double around = std::abs(double(v % n) - 5), up = double(v / n) - 7;
    exact.push_back(std::hypot(std::min(around, n - around), up));
  }
  check_policies<TestType>(s, source, exact, 1e-3, 2e-2);
}

TEMPLATE_TEST_CASE("cones, convex and saddle", "", float, double) {
  for (const double turns : {0.4, 0.8, 1.0, 1.5, 2.3}) {
    const Cone<TestType> cone(12, 36, turns * 2 * std::numbers::pi);
    const auto mesh = cone.mesh();
    for (const Index source : {0u, 1u, 1 + 5 * 36 + 7u, 1 + 11 * 36 + 20u}) {
      std::vector<double> exact;
      for (Index v = 0; v < cone.radius.size(); ++v) exact.push_back(cone.distance(source, v));
      exact[source] = 0;
      CAPTURE(turns, source);
      check_policies(mesh, PointSource::at(source), exact, 1e-3, 2e-2);
    }
  }
}

TEMPLATE_TEST_CASE("an L bends paths at its corner", "", float, double) {
  const Surface s = cut(grid(20, 20), [](double x, double y) { return x < .5 || y < .5; });
  const Position corner = {.5, .5, 0};
  for (const Position from : {Position{0, 1, 0}, Position{.25, .9, 0}, Position{.5, 1, 0}}) {
    const Index source = s.nearest(from[0], from[1]);
    const Position& a = s.positions[source];
    std::vector<double> exact = by_rule(s, [&](const Position& p) {
      if (p[0] > .5 + 1e-9 && p[1] > .5 + 1e-9) return std::numeric_limits<double>::infinity();
      // Above the line through the corner is in shadow.
      const bool dark = p[0] > .5 && (corner[0] - a[0]) * (p[1] - a[1]) >
                                         (corner[1] - a[1]) * (p[0] - a[0]) + 1e-12;
      return dark ? bent(a, corner, p) : std::hypot(p[0] - a[0], p[1] - a[1]);
    });
    CAPTURE(from[0], from[1]);
    check_policies<TestType>(s, source, exact, 1e-5, 1e-3);
  }
}

TEMPLATE_TEST_CASE("a slit bends paths at its end", "", float, double) {
  for (const Index n : {10u, 20u}) {
    const Surface s = slit_square(n);
    const Index lip = (n + 1) * (n + 1);  // vertices from here on are on the right lip
    const Position end = {.5, .5, 0};
    for (const Position from : {Position{0, 0, 0}, Position{.2, .3, 0}, Position{.4, 0, 0}}) {
      const Index source = s.nearest(from[0], from[1]);
      const Position& a = s.positions[source];
      std::vector<double> exact;
      for (Index v = 0; v < s.positions.size(); ++v) {
        const Position& p = s.positions[v];
        const bool right = p[0] > .5 || v >= lip;
        const double reach = (end[0] - a[0]) * (p[1] - a[1]) - (end[1] - a[1]) * (p[0] - a[0]);
        const bool dark = right && reach < -1e-12;
        exact.push_back(dark ? bent(a, end, p) : std::hypot(p[0] - a[0], p[1] - a[1]));
      }
      CAPTURE(n, from[0], from[1]);
      check_policies<TestType>(s, source, exact, 1e-5, 1e-3);
    }
  }
}

TEMPLATE_TEST_CASE("a path may pass a pinched vertex", "", float, double) {
  const Surface s = bow_tie(8);
  const Position joint = {1, 1, 0};
  for (const Index source : {0u, 13u, 80u}) {
    const Position& a = s.positions[source];
    const std::vector<double> exact = by_rule(s, [&](const Position& p) {
      return p[0] > 1 || p[1] > 1 ? bent(a, joint, p) : std::hypot(p[0] - a[0], p[1] - a[1]);
    });
    check_policies<TestType>(s, source, exact, 1e-6, 1e-5);
  }
}

TEMPLATE_TEST_CASE("several pinches in a row", "", float, double) {
  // Triangles like beads on a string, each a unit long.
  Surface s;
  Index last = s.add(0, 0);
  for (int i = 0; i < 20; ++i) {
    const Index side = s.add(i + .5, 1), next = s.add(i + 1, 0);
    s.triangle(last, side, next);
    last = next;
  }
  const Surface beads = renamed(s, 8, false).surface;
  const auto mesh = beads.mesh<TestType>();
  CHECK(mesh.summary().pinched_vertices == 19);
  const std::vector<double> exact = by_rule(
      beads, [](const Position& p) { return p[1] == 0 ? p[0] : p[0] - .5 + std::hypot(.5, 1); });
  check_policies(mesh, PointSource::at(0), exact, 1e-6, 1e-5);
}

TEMPLATE_TEST_CASE("three sheets on an edge unfold pairwise", "", float, double) {
  for (const Index count : {3u, 4u}) {
    const Index n = 8;
    const Surface s = sheets(count, n);
    const auto sheet = [&](Index v) { return v <= n ? none : (v - n - 1) / (n * (n + 1)); };
    for (const Index source : {2u, n + 1 + 30, n + 1 + n * (n + 1) + 50}) {
      std::vector<double> exact;
      const Position& a = s.positions[source];
      const double x = std::hypot(a[0], a[1]);
      for (Index v = 0; v < s.positions.size(); ++v) {
        const Position& p = s.positions[v];
        const double across = std::hypot(p[0], p[1]) * (sheet(v) == sheet(source) ? -1 : 1);
        exact.push_back(std::hypot(x + across, p[2] - a[2]));
      }
      exact[source] = 0;
      CAPTURE(count, source);
      // Some vertices are apex of a triangle whose centre lies in the shadow they are just out of.
      check_policies<TestType>(s, source, exact, 1e-4, 3e-3);
    }
  }
}

TEMPLATE_TEST_CASE("spheres converge to great circles", "", float, double) {
  double before = 1;
  for (const int levels : {2, 3, 4, 5}) {
    const Surface s = sphere(levels);
    const Position from = s.positions[0];
    const std::vector<double> exact = by_rule(s, [&](const Position& p) {
      const double chord = std::hypot(p[0] - from[0], p[1] - from[1], p[2] - from[2]);
      return 2 * std::asin(std::min(1., chord / 2));
    });
    const Errors e = compare(solve(s.mesh<TestType>(), PointSource::at(0)), exact);
    CAPTURE(levels, e.mean, e.max);
    CHECK(e.mean < before / 1.8);
    before = e.mean;
  }
  CHECK(before < 2e-3);
}

TEMPLATE_TEST_CASE("a torus of two triangles, from inside one", "", float, double) {
  const double diagonal = std::sqrt(2.);
  const std::vector<Face> faces = {{0, 0, 0}, {0, 0, 0}};
  const std::vector<std::array<double, 3>> lengths = {{1, 1, diagonal}, {diagonal, 1, 1}};
  const std::vector<Face> across = {{4, 5, 3}, {2, 0, 1}};
  const TriangleMesh<TestType> mesh(1, faces, lengths, across);
  CHECK(solve(mesh, PointSource::at(0))[0] == 0);
  const double third = 1. / 3;
  // The centre of (0, 0), (1, 0), (1, 1) is nearest to (1, 0).
  CHECK(solve(mesh, PointSource::in(0, {third, third, third}))[0] ==
        Approx(std::hypot(third, third)));
}

TEMPLATE_TEST_CASE("a triangle glued to itself", "", float, double) {
  const std::vector<Face> faces = {{0, 1, 1}}, across = {{2, none, 0}};
  const std::vector<std::array<double, 3>> lengths = {{2, 1, 2}};
  const TriangleMesh<TestType> mesh(2, faces, lengths, across);
  for (const Visibility visibility : visibilities) {
    PropagateOptions options;
    options.visibility = visibility;
    CHECK(solve(mesh, PointSource::at(0), options) == std::vector<double>{0, 2});
    CHECK(solve(mesh, PointSource::at(1), options) == std::vector<double>{2, 0});
  }
}

TEMPLATE_TEST_CASE("a ring of two triangles that share two edges", "", float, double) {
  const double slope = std::sqrt(10.);
  const std::vector<Face> faces = {{0, 0, 1}, {0, 1, 1}}, across = {{none, 5, 3}, {2, none, 1}};
  const std::vector<std::array<double, 3>> lengths = {{1, 3, slope}, {slope, 1, 3}};
  const TriangleMesh<TestType> mesh(2, faces, lengths, across);
  CHECK(solve(mesh, PointSource::at(0))[1] == Approx(3));
  CHECK(solve(mesh, PointSource::at(1))[0] == Approx(3));
}

}  // namespace plexway::testing::closed_forms_test
