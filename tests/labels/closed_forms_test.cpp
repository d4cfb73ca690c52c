#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "complexes/test_meshes.hpp"
#include "data/tuning_shapes.hpp"
#include "labels/solving.hpp"
#include "with_accuracy.hpp"

#include <plexway/surface/triangle_mesh.hpp>

namespace plexway::testing::closed_forms_test {

namespace {

/// A cone of total angle `theta` around vertex 0, unrolled: ring i at radius (i + 1) / rings.
/// Given by lengths, so that theta may exceed a full turn.
template <class Real>
struct Cone {
  Index rings, around;
  double theta;
  std::vector<double> radius{0}, angle{0};
  std::vector<Face> faces;

  Cone(Index r, Index a, double t) : rings(r), around(a), theta(t) {
    for (Index i = 0; i < rings; ++i)
      for (Index j = 0; j < around; ++j) {
        radius.push_back(double(i + 1) / rings);
        angle.push_back(theta * j / around);
      }
    for (Index j = 0; j < around; ++j) {
      const Index k = (j + 1) % around;
      faces.push_back({0, 1 + j, 1 + k});
      for (Index i = 0; i + 1 < rings; ++i) {
        const Index a0 = 1 + i * around + j, b0 = 1 + i * around + k;
        faces.push_back({a0, a0 + around, b0 + around});
        faces.push_back({a0, b0 + around, b0});
      }
    }
  }
  [[nodiscard]] double distance(Index v, Index w) const {
    double turn = std::abs(angle[v] - angle[w]);
    turn = std::min(turn, theta - turn);
    if (turn >= std::numbers::pi || v == 0 || w == 0) return radius[v] + radius[w];
    const double p = radius[v] - radius[w] * std::cos(turn), q = radius[w] * std::sin(turn);
    return std::hypot(p, q);
  }
  [[nodiscard]] TriangleMesh<Real> mesh() const {
    std::vector<std::array<double, 3>> lengths;
    for (const Face& f : faces)
      lengths.push_back({distance(f[0], f[1]), distance(f[1], f[2]), distance(f[2], f[0])});
    return TriangleMesh<Real>(radius.size(), faces, lengths);
  }
};

/// Default within `mean` and `max`; upper_bound never below; all others finite in the right places;
/// in double `exact` is, with the same bits in any order.
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
  if constexpr (std::is_same_v<Real, double>) {
    PropagateOptions options = at(Accuracy::exact());
    const std::vector<double> first = solve(mesh, source, options);
    const Errors e = compare(first, exact);
    CAPTURE(e.mean, e.max, e.below);
    CHECK(e.fits);
    CHECK(e.max <= 1e-11);
    for (const Schedule schedule : schedules) {
      options.schedule = schedule;
      CHECK(solve(mesh, source, options) == first);
    }
  }
}

/// Each accuracy that there is of a precision.
template <class Real>
std::vector<PropagateOptions> accuracies() {
  std::vector<PropagateOptions> all = {{}, by_labels()};
  if (sizeof(Real) == 8) all.push_back(at(Accuracy::exact()));
  return all;
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
  check_policies<TestType>(s, s.nearest(0, 0, 0), exact, 5e-5, 2e-3);
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
      check_policies<TestType>(s, source, exact, 5e-5, 2e-3);
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
  const double third = 1. / 3;
  for (const PropagateOptions& options : accuracies<TestType>()) {
    CHECK(solve(mesh, PointSource::at(0), options)[0] == 0);
    // The centre of (0, 0), (1, 0), (1, 1) is nearest to (1, 0).
    CHECK(solve(mesh, PointSource::in(0, {third, third, third}), options)[0] ==
          Approx(std::hypot(third, third)));
  }
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
  for (const PropagateOptions& options : accuracies<TestType>())
    CHECK(solve(mesh, PointSource::at(1), options) == std::vector<double>{2, 0});
}

TEMPLATE_TEST_CASE("a ring of two triangles that share two edges", "", float, double) {
  const double slope = std::sqrt(10.);
  const std::vector<Face> faces = {{0, 0, 1}, {0, 1, 1}}, across = {{none, 5, 3}, {2, none, 1}};
  const std::vector<std::array<double, 3>> lengths = {{1, 3, slope}, {slope, 1, 3}};
  const TriangleMesh<TestType> mesh(2, faces, lengths, across);
  for (const PropagateOptions& options : accuracies<TestType>()) {
    CHECK(solve(mesh, PointSource::at(0), options)[1] == Approx(3));
    CHECK(solve(mesh, PointSource::at(1), options)[0] == Approx(3));
  }
}

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

// A spring of five turns about the z axis: its tube of radius 0.12 winds about a circle of radius
// 1, 260 rings of 8 vertices. No point of it is nearer to the axis than `inside`, so a path that
// turns by an angle and climbs by a height is no shorter than on a cylinder of that radius.
TEMPLATE_TEST_CASE("no distance along a tube that winds is shorter than its inside", "", float,
                   double) {
  const samples::Shape spring = samples::tuning::spring();
  const TriangleMesh<TestType> mesh(spring.points, spring.faces);
  const double turn = 10 * samples::pi / 260, inside = 0.88 * std::cos(turn);
  const auto angle = [&](Index v) {  // about the axis, turns counted
    const double ring = turn * (v / 8);
    const samples::Point& p = spring.points[v];
    return ring + std::remainder(std::atan2(p[1], p[0]) - ring, 2 * samples::pi);
  };
  for (const Index source : {Index{0}, Index{1044}, Index{2070}}) {
    const std::vector<double> distance = solve(mesh, PointSource::at(source));
    double worst = 0;
    for (Index v = 0; v < distance.size(); ++v) {
      const double least = std::hypot(inside * (angle(v) - angle(source)),
                                      spring.points[v][2] - spring.points[source][2]);
      worst = std::min(worst, distance[v] - least * 0.99);
      REQUIRE(std::isfinite(distance[v]));
    }
    INFO("from " << source);
    CHECK(worst >= -0.02);
  }
}

}  // namespace plexway::testing::closed_forms_test
