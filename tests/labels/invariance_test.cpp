#include <catch2/catch.hpp>

#include "labels/solving.hpp"
#include "with_accuracy.hpp"

namespace plexway::testing::invariance_test {

namespace {

/// A bumpy disc with a hole: curved both ways, with a boundary and no symmetry.
Surface bumpy(Index n = 30) {
  Surface s = cut(grid(n, n), [](double x, double y) { return std::hypot(x - .4, y - .6) > .12; });
  for (Position& p : s.positions) {
    p[2] = .15 * std::sin(9 * p[0]) * std::cos(7 * p[1]) + .05 * std::sin(23 * p[0] + 5 * p[1]);
    p[0] += .004 * std::sin(51 * p[1]);
  }
  return s;
}

struct Difference {
  double mean = 0, max = 0;
};
Difference difference(const std::vector<double>& a, const std::vector<double>& b) {
  REQUIRE(a.size() == b.size());
  Difference d;
  for (std::size_t v = 0; v < a.size(); ++v) {
    REQUIRE(std::isinf(a[v]) == std::isinf(b[v]));
    if (a[v] == b[v]) continue;
    const double e = std::abs(a[v] - b[v]) / std::max(a[v], b[v]);
    d.mean += e / static_cast<double>(a.size());
    d.max = std::max(d.max, e);
  }
  return d;
}

template <class Real>
std::vector<double> distances(const Surface& s, Index source,
                              const PropagateOptions& options = {}) {
  return solve(s.mesh<Real>(), PointSource::at(source), options);
}

/// What is the same problem again: how far its distances may be off the first ones'. Labels and
/// exact windows give them again, but for ties; of merged ones rounding decides which there are.
struct Again {
  Accuracy accuracy;
  double mean, max;
};
template <class Real>
std::vector<Again> again() {
  std::vector<Again> all = {{Accuracy::fast(), 1e-6, 1e-5}, {Accuracy::usual(), 1e-4, 1e-3}};
  if (sizeof(Real) == 8) all.push_back({Accuracy::exact(), 1e-12, 1e-10});
  return all;
}

}  // namespace

TEMPLATE_TEST_CASE("the vectorised step agrees with the plain one", "", float, double) {
  // Same rule; but two labels may be as good as each other, and rounding then chooses between them.
  // Where they belong to paths around different sides of a saddle, vertices beyond notice.
  for (const Surface& s : {bumpy(), sphere(4), cube(9), moebius(40, 8), soup(40, 60, 5)})
    for (const Schedule schedule : schedules) {
      PropagateOptions plain = by_labels();
      plain.schedule = schedule;
      plain.vectorised = false;
      PropagateOptions fast = plain;
      fast.vectorised = true;
      const Difference d =
          difference(distances<TestType>(s, 5, plain), distances<TestType>(s, 5, fast));
      CAPTURE(name(fast), s.positions.size(), d.mean, d.max);
      CHECK(d.max <= 1e-3);
      CHECK(d.mean <= 2e-5);
    }
}

TEMPLATE_TEST_CASE("numbering does not matter", "", float, double) {
  for (const Surface& s : {bumpy(), random_polygon(6, 80, 100, 3), sphere(3)})
    for (const auto& [accuracy, mean, max] : again<TestType>()) {
      const std::vector<double> d = distances<TestType>(s, 5, at(accuracy));
      for (unsigned seed = 1; seed <= 5; ++seed) {
        const Renamed other = renamed(s, seed, seed != 1, seed > 3);
        const std::vector<double> e =
            distances<TestType>(other.surface, other.vertex[5], at(accuracy));
        std::vector<double> back;
        for (const Index v : other.vertex) back.push_back(e[v]);
        const Difference change = difference(d, back);
        CAPTURE(s.positions.size(), accuracy.error(), seed, change.mean);
        // Turned over, left becomes right, and of two equally long paths another label comes first.
        const bool other_label = seed > 3 && accuracy == Accuracy::fast();
        CHECK(change.max <= (other_label ? 1e-2 : max));
        CHECK(change.mean <= (other_label ? 1e-4 : mean));
      }
    }
}

TEMPLATE_TEST_CASE("scale only scales", "", float, double) {
  const Surface s = bumpy();
  std::vector<double> scales = {1e-6, 1e6, 0x1p-20, 0x1p20, 3};
  if (sizeof(TestType) == 8) scales.insert(scales.end(), {1e-30, 1e30, 1e-280, 1e280});
  for (const double scale : scales) {
    Surface t = s;
    for (Position& p : t.positions)
      for (double& c : p) c *= scale;
    // Coordinates are rounded anew: another label may win by a rounding.
    for (const auto& [accuracy, mean, max] : again<TestType>()) {
      std::vector<double> e = distances<TestType>(t, 40, at(accuracy));
      for (double& x : e) x /= scale;
      const Difference change = difference(distances<TestType>(s, 40, at(accuracy)), e);
      CAPTURE(scale, accuracy.error());
      CHECK(change.mean <= mean);
      CHECK(change.max <= max);
    }
  }
}

TEMPLATE_TEST_CASE("a power of two scales exactly", "", float, double) {
  const Surface s = sphere(3);
  Surface t = s;
  for (Position& p : t.positions)
    for (double& c : p) c *= 0x1p13;
  std::vector<double> d = distances<TestType>(s, 9);
  for (double& x : d) x *= 0x1p13;
  CHECK(d == distances<TestType>(t, 9));
}

TEMPLATE_TEST_CASE("position and attitude in space do not matter", "", float, double) {
  const Surface s = bumpy();
  Surface t = s;
  const double c = std::cos(1.1), w = std::sin(1.1);
  for (Position& p : t.positions)
    p = {c * p[0] - w * p[1] + 1, c * (w * p[0] + c * p[1]) - w * p[2],
         w * (w * p[0] + c * p[1]) + c * p[2] - 2};
  for (const auto& [accuracy, mean, max] : again<TestType>()) {
    const Difference d = difference(distances<TestType>(s, 3, at(accuracy)),
                                    distances<TestType>(t, 3, at(accuracy)));
    CAPTURE(accuracy.error());
    CHECK(d.mean <= mean);
    CHECK(d.max <= max);
  }
}

TEMPLATE_TEST_CASE("solving again gives the same bits", "", float, double) {
  const auto mesh = bumpy().mesh<TestType>();
  Workspace<TestType> workspace;
  const PointSource here[] = {PointSource::at(7)};
  const PointSource there[] = {PointSource::at(500), PointSource::at(2)};
  for (const Visibility visibility : visibilities)
    for (const Schedule schedule : schedules)
      check_again(workspace, mesh, here, there, {.visibility = visibility, .schedule = schedule});
}

TEST_CASE("thousands of solves on one workspace") {
  // The numbers that tell this propagation's marks from earlier ones come round after 8191.
  const auto mesh = bow_tie(2).mesh<float>();
  Workspace<float> workspace;
  DistanceField<float> field;
  std::vector<std::vector<float>> expected;
  for (Index v = 0; v < 17; ++v)
    expected.push_back(plexway::solve(Serial{}, mesh, PointSource::at(v)).distance);
  bool same = true;
  for (Index n = 0; n < 20000; ++n) {
    const PointSource source[] = {PointSource::at(n * 7 % 17)};
    PropagateOptions options;
    if (n % 3) options.radius = .3;  // leaves old marks about
    plexway::solve(Serial{}, mesh, source, options, workspace, field);
    if (n % 3 == 0) same &= field.distance == expected[source[0].vertex];
  }
  CHECK(same);
}

TEMPLATE_TEST_CASE("one workspace serves meshes of different size", "", float, double) {
  Workspace<TestType> workspace;
  DistanceField<TestType> field;
  for (const Index n : {12u, 30u, 5u, 30u, 13u}) {
    const auto mesh = bumpy(n).mesh<TestType>();
    for (const Schedule schedule : schedules) {
      PropagateOptions options;
      options.schedule = schedule;
      const PointSource source[] = {PointSource::at(n)};
      plexway::solve(Serial{}, mesh, source, options, workspace, field);
      CHECK(field.distance == plexway::solve(Serial{}, mesh, source, options).distance);
    }
  }
}

TEMPLATE_TEST_CASE("distances are symmetric within the error", "", float, double) {
  const Surface s = bumpy();
  const auto mesh = s.mesh<TestType>();
  const std::vector<Index> some = {0, 31, 77, 200, 450, 640, 800, 955};
  std::vector<std::vector<double>> d;
  for (const Index v : some) d.push_back(solve(mesh, PointSource::at(v)));
  double worst = 0, sum = 0;
  for (std::size_t i = 0; i < some.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const double e = std::abs(d[i][some[j]] / d[j][some[i]] - 1);
      worst = std::max(worst, e);
      sum += e / 28;
    }
  CAPTURE(sum);
  CHECK(worst <= 2e-2);
  CHECK(sum <= 3e-3);
}

TEMPLATE_TEST_CASE("never much longer than along edges, and a metric", "", float, double) {
  for (const Surface& s : {bumpy(), sphere(3), cube(7), moebius(30, 5), bow_tie(6), sheets(3, 6)}) {
    const auto mesh = s.mesh<TestType>();
    const std::vector<double> edges = along_edges(s, 11);
    for (const Visibility visibility : visibilities) {
      PropagateOptions options;
      options.visibility = visibility;
      const std::vector<double> d = solve(mesh, PointSource::at(11), options);
      CAPTURE(name(options), s.positions.size());
      double over = 0;
      bool chord = true;
      for (std::size_t v = 0; v < d.size(); ++v) {
        REQUIRE(std::isinf(d[v]) == std::isinf(edges[v]));
        if (v == 11 || std::isinf(d[v])) continue;
        over = std::max(over, d[v] / edges[v] - 1);
        const Position &p = s.positions[v], &q = s.positions[11];
        // Shorter than straight through space it is never.
        chord &= d[v] >= .98 * std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
      }
      // Bends cost upper_bound more than edges do.
      CHECK(over <= (visibility == Visibility::upper_bound ? .05 : .02));
      CHECK(chord);
      // Neighbours differ by their edge at most, but for the error.
      double step = 0;
      const auto lengths = lengths_of(s);
      for (std::size_t f = 0; f < s.faces.size(); ++f)
        for (std::size_t i = 0; i < 3; ++i) {
          const double a = d[s.faces[f][i]], b = d[s.faces[f][(i + 1) % 3]];
          if (std::isfinite(a)) step = std::max(step, std::abs(a - b) / lengths[f][i] - 1);
        }
      CHECK(step <= (visibility == Visibility::upper_bound ? 1 : .5));
    }
  }
}

}  // namespace plexway::testing::invariance_test
