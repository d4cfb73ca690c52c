#include <catch2/catch.hpp>
#include <cmath>

#include <plexway/executors/gl.hpp>
#include <plexway/io/triangles.hpp>
#include <plexway/solve.hpp>

#include "complexes/test_clouds.hpp"
#include "data/corner_domains.hpp"
#include "exact_data.hpp"
#include "gl/device.hpp"
#include "gl/rounds_reference.hpp"
#include "labels/solving.hpp"
#include "with_accuracy.hpp"

namespace plexway::testing::surface_test {

// Surfaces on a GL device against the serial executor.
//
// A triangle keeps one label, the best for its centre, so which of two nearly equal paths the
// triangles beyond hear of depends on the order of updates; no order is right. How far distances
// move with it is measured here without a device: by the serial executor with other schedules and
// with noise in the last digits of the input, and by rounds as the shaders do them, in C++. Where
// that is less than 1e-4 (mean) and 1e-3 (worst), the device must be as close as that; elsewhere
// within twice of it.

namespace {

Difference most(const Difference& a, const Difference& b) {
  return {std::max(a.mean, b.mean), std::max(a.max, b.max), a.fits && b.fits};
}

/// How far the serial executor's distances move with the order of updates, and with noise in the
/// input of the size that rounding has (ties fall differently then).
Difference spread_of(const Surface& surface, std::span<const PointSource> sources,
                     const std::vector<float>& distance) {
  Difference spread;
  const auto add = [&](const TriangleMesh<float>& mesh, const PropagateOptions& options) {
    spread = most(spread, difference(distance, solve(Serial{}, mesh, sources, options).distance));
  };
  const auto mesh = surface.mesh<float>();
  PropagateOptions options = by_labels();
  for (const double step : {0.05, 0.25, 0.5, 2., 3., 5., 8.}) {
    options.step = step;
    add(mesh, options);
  }
  for (const float step : {0.5F, 1.F, 2.F}) {
    const Difference rounds = difference(distance, RoundsReference(mesh, sources, step).distance());
    if (rounds.fits) spread = most(spread, rounds);
  }
  options = by_labels();
  options.vectorised = false;
  add(mesh, options);
  for (const Schedule schedule : {Schedule::fifo, Schedule::priority}) {
    options.schedule = schedule;
    add(mesh, options);
  }
  std::mt19937 random(5);
  for (int n = 0; n < 8; ++n) {
    Surface noisy = surface;
    for (Position& p : noisy.positions)
      for (double& x : p) x += 1e-4 * mesh.unit() * (2 * uniform(random) - 1);
    options.schedule = n % 2 == 0 ? Schedule::dual_queue : Schedule::fifo;
    add(noisy.mesh<float>(), options);
  }
  return spread;
}

/// Over several solves: means of the mean, and the worst of all.
struct Totals {
  Difference found, spread;
  int solves = 0;

  void add(const Difference& one, const Difference& orders) {
    found = {found.mean + one.mean, std::max(found.max, one.max), found.fits && one.fits};
    spread = {spread.mean + orders.mean, std::max(spread.max, orders.max), true};
    ++solves;
  }
  void check() const {
    CAPTURE(found.mean / solves, found.max, spread.mean / solves, spread.max);
    CHECK(found.fits);
    CHECK(found.mean <= std::max(1e-4 * solves, 1.5 * spread.mean));
    CHECK(found.max <= std::max(1e-3, 2 * spread.max));
  }
};

/// Another label than the serial executor's is right where its source is as near.
void check_labels(const TriangleMesh<float>& mesh, std::span<const PointSource> sources,
                  const DistanceField<float>& serial, const DistanceField<float>& field,
                  double close) {
  REQUIRE(field.label.size() == field.distance.size());
  std::vector<std::vector<float>> alone;
  for (const PointSource& s : sources)
    alone.push_back(solve(Serial{}, mesh, s, by_labels()).distance);
  std::size_t others = 0;
  for (std::size_t v = 0; v < field.label.size(); ++v) {
    const Index label = field.label[v];
    INFO("vertex " << v << " label " << label << " serial " << serial.label[v]);
    if (std::isinf(field.distance[v])) {
      CHECK(label == none);
      continue;
    }
    REQUIRE(label < sources.size());
    if (label == serial.label[v]) continue;
    ++others;
    CHECK(double(alone[label][v]) <= double(serial.distance[v]) * (1 + close) + 1e-6);
  }
  CHECK(others <= field.label.size() / 20 + 2);
}

/// `count` sources at once, some of them inside triangles, some with an offset.
Totals compare(const Surface& surface, std::size_t count = 1) {
  const TriangleMesh<float> mesh(surface.positions, surface.faces);
  std::mt19937 random(7);
  GLWorkspace workspace;
  Totals totals;
  for (int turn = 0; turn < 5; ++turn) {
    std::vector<PointSource> sources;
    for (std::size_t n = 0; n < count; ++n) {
      const bool inside = (n + std::size_t(turn)) % 3 == 2;
      sources.push_back(
          inside ? PointSource::in(below(random, surface.faces.size()), {0.2, 0.5, 0.3})
                 : PointSource::at(surface.faces[below(random, surface.faces.size())][0]));
      if (turn == 1) sources.back().offset = 0.3 * mesh.unit() * uniform(random);
    }
    const auto serial = solve(Serial{}, mesh, sources, by_labels());
    const Difference spread = spread_of(surface, sources, serial.distance);
    DistanceField<float> field;
    solve(GL{}, mesh, sources, {}, workspace, field);
    totals.add(difference(serial.distance, field.distance), spread);
    CHECK(field.complete);
    CHECK(field.statistics.reached_simplices == serial.statistics.reached_simplices);
    if (count > 1)
      check_labels(mesh, sources, serial, field, std::max(2e-3, 2 * spread.max));
    else
      CHECK(field.label.empty());
  }
  return totals;
}

/// Two components, and a vertex in no triangle.
Surface apart() {
  Surface s = sphere(2);
  const Surface other = grid(7, 5);
  const auto shift = static_cast<Index>(s.positions.size());
  for (const Position& p : other.positions) s.add(p[0] + 3, p[1], p[2]);
  for (const Face& f : other.faces) s.triangle(f[0] + shift, f[1] + shift, f[2] + shift);
  s.add(9, 9, 9);
  return s;
}

/// A height field of hills, and the same with steps across.
Surface hills(Index n, double height) {
  Surface s = grid(n, n);
  for (Position& p : s.positions) p[2] = height * std::sin(9 * p[0]) * std::cos(7 * p[1]);
  return s;
}

struct Named {
  const char* name;
  Surface surface;
};

std::vector<Named> many_kinds() {
  return {{"flat grid", grid(14, 9)},
          {"slit", slit_square(12)},
          {"random polygon", random_polygon(7, 60, 200, 5)},
          {"cube", cube(7)},
          {"tetrahedron", subdivide(subdivide(tetrahedron()))},
          {"sphere", sphere(3)},
          {"prism", prism(9, 12, 4)},
          {"moebius strip", moebius(30, 4)},
          {"five sheets on an edge", sheets(5, 6)},
          {"bow tie", bow_tie(6)},
          {"two components", apart()},
          {"hills", hills(24, 0.2)},
          {"renumbered hills", renamed(hills(20, 0.3), 3, true, true).surface},
          {"soup", soup(40, 60, 11)},
          {"another soup", soup(90, 200, 12)}};
}

}  // namespace

TEST_CASE("surfaces of many kinds on a device agree with the serial executor", "[gl]") {
  if (!device()) return;
  for (const Named& one : many_kinds()) {
    INFO(one.name);
    compare(one.surface).check();
  }
}

TEST_CASE("shaders do what the same rounds in C++ do", "[gl]") {
  const auto context = device();
  if (!context) return;
  const Surface some[] = {
      grid(9, 6),      slit_square(8), random_polygon(7, 40, 100, 5),
      prism(9, 12, 4), moebius(30, 4), subdivide(tetrahedron()),
      sheets(5, 3),    hills(60, 0.2), renamed(hills(40, 0.3), 3, true).surface};
  int solves = 0, same = 0, close = 0;
  double mean = 0;
  for (const Surface& surface : some) {
    const auto mesh = surface.mesh<float>();
    std::mt19937 random(8);
    GLWorkspace workspace;
    for (int turn = 0; turn < 10; ++turn) {
      const Index face = below(random, surface.faces.size());
      const PointSource source = turn % 2 == 0 ? PointSource::at(surface.faces[face][0])
                                               : PointSource::in(face, {0.2, 0.5, 0.3});
      const std::span<const PointSource> sources(&source, 1);
      DistanceField<float> field;
      solve(GL{}, mesh, sources, {}, workspace, field);
      const auto rounds = RoundsReference(mesh, sources, 1).distance();
      const Difference found = difference(rounds, field.distance);
      CHECK(found.fits);
      ++solves;
      same += found.max == 0;
      close += found.max <= 1e-3;
      mean += found.mean;
    }
  }
  CAPTURE(solves, same, close, mean / solves);
  CHECK(close > 0.9 * solves);
  CHECK(mean < 1e-4 * solves);
  if (exact(*context)) CHECK(same == solves);
}

TEST_CASE("several sources on a device: distances and labels", "[gl]") {
  if (!device()) return;
  for (const Named& one : many_kinds()) {
    INFO(one.name);
    compare(one.surface, 5).check();
  }
}

TEST_CASE("flat surfaces on a device: the straight distance", "[gl]") {
  if (!device()) return;
  const Surface flat[] = {grid(30, 20, 1.5, 1), random_polygon(9, 80, 300, 2)};
  for (const Surface& s : flat) {
    const auto mesh = s.mesh<float>();
    std::mt19937 random(3);
    for (int turn = 0; turn < 4; ++turn) {
      const Index v = below(random, s.positions.size());
      const auto field = solve(GL{}, mesh, PointSource::at(v));
      const Errors errors = testing::compare(field.distance, straight(s, s.positions[v]));
      CHECK(errors.fits);
      CHECK(errors.max < 1e-4);
    }
  }
}

TEST_CASE("real surfaces on a device are as near to the truth as the serial executor", "[gl]") {
  if (!device()) return;
  struct Source {
    const char* kind;
    const char* name;
    Index vertex;
  };
  const Source sources[] = {{"surfaces", "spot", 1357},       {"surfaces", "spot", 2367},
                            {"surfaces", "spot", 2822},       {"surfaces", "fandisk", 2095},
                            {"surfaces", "fandisk", 2415},    {"surfaces", "fandisk", 3045},
                            {"surfaces", "camelhead", 5506},  {"surfaces", "camelhead", 6695},
                            {"surfaces", "camelhead", 6697},  {"surfaces", "rocker-arm", 4092},
                            {"surfaces", "rocker-arm", 9152}, {"surfaces", "rocker-arm", 9166},
                            {"awkward", "cow", 141},          {"awkward", "moebius", 33}};
  double serial = 0, found = 0;
  for (const Source& s : sources) {
    const auto file = exact_file(s.kind, std::string(s.name) + ".obj");
    if (file.empty()) continue;
    const auto t = io::read_triangles(file);
    const std::vector<double> exact =
        exact_values(exact_file(s.kind, s.name + (".v" + std::to_string(s.vertex)) + ".txt"));
    const TriangleMesh<float> mesh(t.positions, t.triangles);
    REQUIRE(exact.size() == mesh.vertex_count());
    const PointSource source = PointSource::at(s.vertex);
    const std::span<const PointSource> one(&source, 1);
    const Errors by_device = testing::compare(solve(GL{}, mesh, source).distance, exact);
    // Any order is as good: the serial executor's, and that of a team, whose rounds these are.
    Errors by_serial;
    PropagateOptions options = by_labels();
    options.vectorised = false;
    double poorest =
        openmp_built()
            ? testing::compare(solve(OpenMP{.threads = 1}, mesh, one, options).distance, exact).mean
            : 0;
    options.vectorised = true;
    for (const double step : {1., 0.25, 0.5, 2.}) {
      options.step = step;
      const Errors e = testing::compare(solve(Serial{}, mesh, one, options).distance, exact);
      if (step == 1) by_serial = e;
      poorest = std::max(poorest, e.mean);
    }
    CAPTURE(s.name, s.vertex, by_serial.mean, poorest, by_device.mean);
    CHECK(by_device.fits);
    CHECK(by_device.mean <= 1.5 * poorest + 1e-4);
    serial += by_serial.mean, found += by_device.mean;
  }
  CAPTURE(serial, found);
  CHECK(found <= 1.1 * serial);
}

TEST_CASE("one field a source on a device", "[gl]") {
  if (!device()) return;
  const Surface s = hills(16, 0.3);
  const auto mesh = s.mesh<float>();
  std::vector<PointSource> sources;
  for (Index n = 0; n < 11; ++n)
    sources.push_back(n % 4 == 3 ? PointSource::in(40 * n, {0.3, 0.3, 0.4})
                                 : PointSource::at(n * 23));
  const std::size_t vertices = mesh.vertex_count();
  for (const std::size_t bytes : {std::size_t{1} << 30, std::size_t{60000}}) {
    GL executor;
    executor.batch_bytes = bytes;  // all at once, or a few at a time
    GLWorkspace workspace;
    std::vector<float> all(sources.size() * vertices);
    CHECK(solve_each(executor, mesh, sources, {}, workspace, all));
    Totals totals;
    for (std::size_t k = 0; k < sources.size(); ++k) {
      const auto one = solve(Serial{}, mesh, sources[k], by_labels()).distance;
      const std::span<const float> row(all.data() + k * vertices, vertices);
      totals.add(difference(one, row),
                 spread_of(s, std::span<const PointSource>(&sources[k], 1), one));
    }
    totals.check();
  }
  const auto named = solve_each(GL{}, mesh, sources);
  CHECK(named.rows() == sources.size());
  CHECK(named.complete);
  CHECK(named.row(4)[sources[4].vertex] == 0);
  CHECK(named.row(5)[sources[4].vertex] > 0);
  const auto nearest = solve(GL{}, mesh, sources);
  CHECK(nearest.distance[sources[4].vertex] == 0);
  CHECK(nearest.distance[sources[5].vertex] == 0);
  std::vector<float> short_of(5);
  GLWorkspace workspace;
  CHECK_THROWS_AS(solve_each(GL{}, mesh, sources, {}, workspace, short_of), UsageError);
}

// Clouds on a GL device and on several threads: their sheets are surfaces, so what is tested is
// that they arrive there and come back, against great circles.

TEST_CASE("points of a sphere, two of them twins, on several threads and on a GL device") {
  auto cloud = samples::sphere_cloud(2500);
  cloud.points.push_back(cloud.points[17]);
  const PointCloud<float> domain(cloud.points, test_clouds::near_pairs(cloud.points));
  const std::size_t twin = cloud.points.size() - 1;
  const auto check = [&](const DistanceField<float>& field) {
    REQUIRE(field.distance.size() == cloud.points.size());
    double mean = 0;
    for (std::size_t i = 1; i < twin; ++i)
      mean += std::abs(double(field.distance[i]) / cloud.distance(0, i) - 1) / double(twin);
    CHECK(mean < 1.5e-3);
    CHECK(field.distance[twin] == field.distance[17]);
    CHECK(field.distance[0] == 0);
  };
  check(solve(Serial{}, domain, PointSource::at(0)));
  if (openmp_built()) check(solve(OpenMP{2}, domain, PointSource::at(0)));
  if (testing::device()) check(solve(GL{}, domain, PointSource::at(0)));
  const auto from_twin = solve(Serial{}, domain, PointSource::at(static_cast<Index>(twin)));
  CHECK(from_twin.distance[17] == 0);
}

// Flat domains with corners on a GL device: no light leaks behind them, as with one thread
// (tests/labels/corners_test.cpp). The exact distances are those of a visibility graph.

TEST_CASE("a device knows of corners as one thread does", "[gl]") {
  if (!device()) return;
  for (const samples::CornerDomain& domain : samples::corner_domains())
    for (const Index n : {50u, 100u}) {
      const samples::Shape grid = domain.grid(n);
      const TriangleMesh<float> mesh(grid.points, grid.faces);
      const auto field = solve(GL{}, mesh, PointSource::at(0));
      const Errors errors = testing::compare(field.distance, domain.distances(grid.points));
      CAPTURE(domain.name, n, errors.mean, errors.max, errors.below);
      CHECK(errors.fits);
      CHECK(errors.mean <= 2e-6);
      CHECK(errors.max <= 1e-3);
      CHECK(errors.below >= -1e-4);
    }
}

}  // namespace plexway::testing::surface_test
