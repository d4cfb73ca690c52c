#include <catch2/catch.hpp>

#include <numbers>

#include <plexway/error.hpp>

#include "data/shapes.hpp"
#include "windows/windows_solving.hpp"

namespace plexway::testing::windows_merged_test {

namespace {

/// Errors in any order of work.
template <class Real>
void check_merged(const TriangleMesh<Real>& mesh, const std::vector<PointSource>& sources,
                  const std::vector<double>& exact, double mean, double max) {
  for (const Schedule schedule : schedules) {
    PropagateOptions options;
    options.schedule = schedule;
    const Errors e = compare(solve_windows(mesh, sources, Accuracy::accurate(), options), exact);
    CAPTURE(static_cast<int>(schedule), e.mean, e.max, e.below);
    CHECK(e.fits);
    CHECK(e.mean <= mean);
    CHECK(e.max <= max);
  }
}

/// A torus whose vertices are moved on it at random: 2 n by n cells, radii 2 and 0.8.
Surface jittered_torus(Index n) {
  std::mt19937 random(n);
  Surface s;
  const Index m = 2 * n;
  for (Index i = 0; i < m; ++i)
    for (Index j = 0; j < n; ++j) {
      const double a = 2 * std::numbers::pi * (i + .3 * (uniform(random) - .5)) / m;
      const double b = 2 * std::numbers::pi * (j + .3 * (uniform(random) - .5)) / n;
      const double r = 2 + .8 * std::cos(b);
      s.add(r * std::cos(a), r * std::sin(a), .8 * std::sin(b));
    }
  for (Index i = 0; i < m; ++i)
    for (Index j = 0; j < n; ++j) {
      const Index a = i * n + j, b = (i + 1) % m * n + j;
      const Index c = i * n + (j + 1) % n, d = (i + 1) % m * n + (j + 1) % n;
      if (random() % 2)
        s.quad(a, b, d, c);
      else
        s.quad(c, a, b, d);
    }
  return s;
}

}  // namespace

TEMPLATE_TEST_CASE("merged windows: one source in a plane is one source to the end", "", float,
                   double) {
  constexpr Index n = 120;
  samples::Shape plane = samples::jittered_square(n, 1, .25, 5, [](Index, Index) { return false; });
  samples::add_square_faces(plane, n, [](Index, Index) { return true; });
  const TriangleMesh<TestType> mesh(plane.points, plane.faces);
  for (const Index source : {Index{0}, n * (n + 1) / 2 + 40}) {
    std::vector<double> exact;
    for (const auto& p : plane.points)
      exact.push_back(std::hypot(p[0] - plane.points[source][0], p[1] - plane.points[source][1]));
    constexpr bool single = sizeof(TestType) == sizeof(float);
    // With slivers that move sources 1e-6 and 5e-5 even in double, 3e-6 and 1.5e-4 in float.
    check_merged(mesh, {PointSource::at(source)}, exact, single ? 5e-7 : 1e-14,
                 single ? 4e-5 : 1e-13);
  }
}

TEMPLATE_TEST_CASE("merged windows: a strip that turns over", "", float, double) {
  const Surface strip = moebius(60, 6);
  const auto mesh = strip.mesh<double>();
  const auto exact = solve_windows(mesh, {PointSource::at(100)}, Accuracy::exact());
  check_merged(strip.mesh<TestType>(), {PointSource::at(100)}, exact, 3e-4, 5e-3);
}

TEMPLATE_TEST_CASE("merged windows: a sliver behind a boundary that bends very little", "", float,
                   double) {
  // The boundary y = 0 bends at its middle, by too little to matter elsewhere. Beyond it a triangle
  // of almost no height, whose apex is reached along that edge alone.
  for (const double bend : {5e-5, 1e-3, 6e-3, 1e-2, 1.3e-2}) {
    constexpr int n = 40;
    Surface s;
    for (int row = 0; row < 4; ++row)
      for (int i = -n; i <= n; ++i)
        s.add(1.57 * i, row + (row == 0 && i < 0 ? 1.57 * i * bend : 0));
    for (Index row = 0; row < 3; ++row)
      for (Index i = 0; i < 2 * n; ++i) {
        const Index a = row * (2 * n + 1) + i, b = a + 2 * n + 1;
        s.quad(a, a + 1, b + 1, b);
      }
    const Index middle = n, apex = s.add(.78, -.002);
    s.triangle(middle, apex, middle + 1);
    const Position source = s.positions[0];
    std::vector<double> exact;
    for (const Position& p : s.positions) {
      const bool seen = p[0] <= 0 || p[1] >= p[0] * bend;
      exact.push_back(seen ? std::hypot(p[0] - source[0], p[1] - source[1])
                           : std::hypot(source[0], source[1]) + std::hypot(p[0], p[1]));
    }
    CAPTURE(bend);
    check_merged(s.mesh<TestType>(), {PointSource::at(0)}, exact, 2e-4, 1e-3);
  }
}

TEMPLATE_TEST_CASE("merged windows: several sources, in faces and on edges", "", float, double) {
  const Surface s = jittered_torus(20);
  std::vector<PointSource> sources = {PointSource::in(17, {.2, .5, .3}),
                                      PointSource::in(400, {.4, .6, 0.}), PointSource::at(333)};
  sources[1].offset = .25;
  const auto exact = solve_windows(s.mesh<double>(), sources, Accuracy::exact());
  check_merged(s.mesh<TestType>(), sources, exact, 2e-4, 5e-3);
}

TEMPLATE_TEST_CASE("merged windows: no distance is below the straight line", "", float, double) {
  // Where a surface is flat, half of what merging misses would be.
  std::mt19937 random(4);
  for (const Index width : {2u, 40u}) {
    Surface s = grid(4000 / width, width, 4000 / width, width);
    for (Position& p : s.positions) {
      if (p[0] > 0 && p[0] < 4000 / width) p[0] += .2 * (uniform(random) - .5);
      if (p[1] > 0 && p[1] < width) p[1] += .2 * (uniform(random) - .5);
    }
    const auto mesh = s.mesh<TestType>();
    for (const std::vector<PointSource>& sources :
         {std::vector{PointSource::at(0)},
          {PointSource::at(9), PointSource{.vertex = 700, .offset = .5}}}) {
      const auto found = solve_windows(mesh, sources, Accuracy::accurate());
      double mean = 0;
      for (Index v = 0; v < found.size(); ++v) {
        double line = 1e300;
        for (const PointSource& from : sources)
          line = std::min(
              line, from.offset + std::hypot(s.positions[v][0] - s.positions[from.vertex][0],
                                             s.positions[v][1] - s.positions[from.vertex][1]));
        CAPTURE(width, v);
        CHECK(found[v] >= line * (1 - 1e-6));
        mean += (found[v] - line) / std::max(line, 1.) / double(found.size());
      }
      CHECK(mean < 1e-4);
    }
  }
}

TEST_CASE("merged windows: errors fall with the triangles' size") {
  double before = 1;
  for (const Index n : {40u, 80u, 160u}) {
#ifdef PLEXWAY_SANITIZED
    if (n > 80) continue;
#endif
    const Surface s = jittered_torus(n);
    const auto exact = solve_windows(s.mesh<double>(), {PointSource::at(0)}, Accuracy::exact());
    const Errors e =
        compare(solve_windows(s.mesh<float>(), {PointSource::at(0)}, Accuracy::accurate()), exact);
    CAPTURE(n, e.mean, e.max);
    CHECK(e.mean < before / 2);
    CHECK(e.max < 5e-3);
    before = e.mean;
  }
  CHECK(before < 2e-5);
}

TEST_CASE("merged windows: a smaller error takes more work, is smaller, and is told") {
  const Surface s = jittered_torus(30);
  const auto mesh = s.mesh<double>();
  const PointSource source = PointSource::at(7);
  const auto exact = solve_windows(mesh, {source}, Accuracy::exact());
  Workspace<double> workspace;
  DistanceField<double> field;
  const std::vector<double>& error = field.error;
  double before = 1;
  std::size_t work = 0;
  // Wide limits cost less than they allow: slivers no longer move sources.
  for (const auto& [asked, most] : {std::pair(1e-3, 1.3e-4), {2e-4, 1.1e-4}, {4e-5, 4.8e-5}}) {
    solve_windows(mesh, {&source, 1}, Accuracy(asked), {}, workspace, field);
    const Errors e = compare(field.distance, exact);
    CAPTURE(asked, e.mean, e.max);
    CHECK(e.mean < before);
    CHECK(e.mean < most);
    CHECK(field.statistics.expansions > work * 9 / 10);
    before = e.mean;
    work = field.statistics.expansions;
    std::size_t held = 0;
    double least = 1;
    for (std::size_t v = 0; v < exact.size(); ++v) {
      held += std::abs(field.distance[v] - exact[v]) <= error[v] + 1e-9;
      least = std::min(least, error[v]);
    }
    CHECK(least >= 0);
    CHECK(static_cast<double>(held) >= .97 * static_cast<double>(exact.size()));
  }
  solve_windows(mesh, {&source, 1}, Accuracy(0), {}, workspace, field);
  CHECK(compare(field.distance, exact).max == 0);
  CHECK(std::all_of(error.begin(), error.end(), [](double e) { return e == 0; }));
  for (const double no : {-1., 1., std::nan("")})
    CHECK_THROWS_AS(solve_windows(mesh, {&source, 1}, Accuracy(no), {}, workspace, field),
                    UsageError);
}

TEMPLATE_TEST_CASE("merged windows: edges of no length, as raw scans have them", "", float,
                   double) {
  // A plane folded along x = 0, 1, 2, ... and cut by lines that are not parallel: the straight line
  // in space is shorter than the way, and raises nothing.
  constexpr Index n = 60;
  std::mt19937 random(5);
  Surface flat, s;
  const double slope = std::tan(0.6), c = 1 / std::hypot(1, slope);
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j) {
      const double y = j + (j == 0 || j == n - 1 ? 0 : .6 * (uniform(random) - .5));
      flat.add(i, y);
      s.add(c * i, y, i % 2 == 0 ? 0 : c * slope);
    }
  for (Index i = 0; i + 1 < n; ++i)
    for (Index j = 0; j + 1 < n; ++j) {
      const Index a = i * n + j;
      if (random() % 2)
        s.quad(a, a + n, a + n + 1, a + 1);
      else
        s.quad(a + 1, a, a + n, a + n + 1);
    }
  // Vertices are doubled: half of the fan, from a neighbour p to a neighbour q, gets the twin, and
  // two triangles without an area close the gap.
  std::vector<std::vector<std::size_t>> fans(s.positions.size());
  for (std::size_t f = 0; f < s.faces.size(); ++f)
    for (const Index v : s.faces[f]) fans[v].push_back(f);
  for (int k = 0; k < 60; ++k) {
    const Index v = (2 + below(random, n - 4)) * n + 2 + below(random, n - 4);
    const auto at = [&](std::size_t f) {
      return static_cast<std::size_t>(std::find(s.faces[f].begin(), s.faces[f].end(), v) -
                                      s.faces[f].begin());
    };
    std::vector<std::size_t> fan = fans[v];
    if (fan.size() < 4) continue;
    for (const std::size_t f : fan)  // not where a neighbour has a twin
      for (const Index w : s.faces[f])
        if (fans[w].empty()) fan.clear();
    if (fan.empty()) continue;
    const Index twin = static_cast<Index>(s.positions.size());
    s.positions.push_back(s.positions[v]);
    flat.positions.push_back(flat.positions[v]);
    fans.emplace_back();
    std::size_t f = fan[0];
    const Index p = s.faces[f][(at(f) + 1) % 3];
    Index q = p;
    for (std::size_t half = 0; half < fan.size() / 2; ++half) {
      const std::size_t i = at(f);
      q = s.faces[f][(i + 2) % 3];
      s.faces[f][i] = twin;
      for (const std::size_t g : fan)
        if (at(g) < 3 && s.faces[g][(at(g) + 1) % 3] == q) {
          f = g;
          break;
        }
    }
    s.triangle(v, p, twin);
    s.triangle(v, twin, q);
    fans[v].clear();
  }
  REQUIRE(s.faces.size() > 2 * (n - 1) * (n - 1) + 60);
  const auto mesh = s.template mesh<TestType>();
  REQUIRE(mesh.summary().boundary_edges == 4 * (n - 1));
  for (const Index source : {Index{17}, Index{n * 31 + 12}, Index{n * 50 + 40}})
    check_merged(mesh, {PointSource::at(source)}, straight(flat, flat.positions[source]), 5e-5,
                 2e-3);
}

TEMPLATE_TEST_CASE("windows: points that all but lie at a vertex", "", float, double) {
  const Surface s = random_polygon(7, 100, 0, 3);
  const auto mesh = s.template mesh<TestType>();
  std::mt19937 random(8);
  for (const double near : {1e-17, 1e-14, 1e-11, 1e-9, 1e-7, 3e-6, 1e-4})
    for (int k = 0; k < 6; ++k) {
      const Index f = below(random, s.faces.size());
      const double share = uniform(random);
      const PointSource point = PointSource::in(f, {1 - near, share * near, (1 - share) * near});
      Position p = {0, 0, 0};
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t c = 0; c < 3; ++c)
          p[c] += point.barycentric[i] * s.positions[s.faces[f][i]][c];
      const std::vector<double> truth = straight(s, p);
      CAPTURE(near, f, share);
      for (const Accuracy accuracy : window_accuracies) {
        const auto found = solve_windows(mesh, {point}, accuracy);
        double mean = 0;
        for (std::size_t v = 0; v < truth.size(); ++v)
          mean += std::abs(found[v] - truth[v]) / static_cast<double>(truth.size());
        CHECK(mean < 2e-4 * *std::max_element(truth.begin(), truth.end()));
      }
    }
}

}  // namespace plexway::testing::windows_merged_test
