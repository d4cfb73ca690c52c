// Solids on a GL device against closed forms, exact answers and the serial executor, by the literal
// step.
//
// The order of updates decides which of several nearly equal ways a label takes; no order is right.
// How far distances move with it is measured by the serial executor with other schedules. Where
// that is less than 1e-4 (mean) and 1e-3 (worst), the device must be as close as that; elsewhere
// within twice of it.

#include <array>
#include <catch2/catch.hpp>
#include <random>
#include <vector>

#include <plexway/executors/gl.hpp>
#include <plexway/solve.hpp>

#include "gl/device.hpp"
#include "propagate/solid_closed_forms.hpp"
#include "propagate/solid_truth.hpp"
#include "with_accuracy.hpp"

namespace plexway::testing::solid_test {

namespace {

using Sources = std::span<const PointSource>;

std::vector<float> serial(const TetMesh<float>& mesh, Sources sources,
                          PropagateOptions options = {}) {
  options.accuracy = Accuracy::fast();
  return solve(Serial{}, mesh, sources, options).distance;
}

/// How far the serial executor's distances move with the order of updates.
Difference spread_of(const TetMesh<float>& mesh, Sources sources,
                     const std::vector<float>& distance) {
  Difference spread;
  const auto add = [&](const PropagateOptions& options) {
    const Difference d = difference(distance, serial(mesh, sources, options));
    spread = {std::max(spread.mean, d.mean), std::max(spread.max, d.max), spread.fits && d.fits};
  };
  PropagateOptions options;
  for (const double step : {0.25, 0.5, 2., 3., 5.}) {
    options.step = step;
    add(options);
  }
  options.schedule = Schedule::priority;
  add(options);
  return spread;
}

void check_close(const Difference& found, const Difference& spread) {
  CAPTURE(found.mean, found.max, spread.mean, spread.max);
  CHECK(found.fits);
  CHECK(found.mean <= std::max(1e-4, 2 * spread.mean));
  CHECK(found.max <= std::max(1e-3, 2 * spread.max));
}

/// From `count` sources at once, some inside of tetrahedra.
std::vector<PointSource> some_sources(const Solid& s, std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<PointSource> sources;
  for (std::size_t n = 0; n < count; ++n) {
    const Index t = below(random, s.tets.size());
    sources.push_back((n + seed) % 3 == 2 ? PointSource::in(t, {.1, .2, .3, .4})
                                          : PointSource::at(s.tets[t][0]));
  }
  return sources;
}

void compare_with_serial(const Solid& s, std::size_t count, unsigned turns) {
  const auto mesh = s.mesh<float>();
  GLWorkspace workspace;
  DistanceField<float> field;
  for (unsigned turn = 0; turn < turns; ++turn) {
    const auto sources = some_sources(s, count, turn);
    const auto known = solve(Serial{}, mesh, Sources(sources), by_labels());
    solve(GL{}, mesh, sources, {}, workspace, field);
    check_close(difference(known.distance, field.distance),
                spread_of(mesh, sources, known.distance));
    CHECK(field.complete);
    CHECK(field.statistics.reached_simplices == known.statistics.reached_simplices);
    REQUIRE(field.label.size() == known.label.size());
    std::size_t others = 0;
    for (std::size_t v = 0; v < known.label.size(); ++v) others += known.label[v] != field.label[v];
    CHECK(others <= known.label.size() / 50);  // equally near to both
  }
}

/// The device's errors, with mean and worst at most these; the worst, which a few vertices just
/// behind an edge have, may be as large as it is with some other order, of the serial executor or
/// of a team. Returns the mean.
double check_errors(const Solid& s, Index source, const std::vector<double>& exact, double worst) {
  const auto mesh = s.mesh<float>();
  const PointSource at = PointSource::at(source);
  const Errors e = compare(solve(GL{}, mesh, at).distance, exact);
  PropagateOptions options;
  for (const double step : {0.25, 0.5, 1., 2., 3.}) {
    options.step = step;
    worst = std::max(worst, compare(serial(mesh, Sources(&at, 1), options), exact).max);
  }
  if (openmp_built())
    worst = std::max(
        worst, compare(solve(OpenMP{.threads = 1}, mesh, at, by_labels()).distance, exact).max);
  CAPTURE(source, e.mean, e.max, worst);
  CHECK(e.fits);
  CHECK(e.max <= worst * (1 + 1e-5));
  return e.mean;
}

}  // namespace

TEST_CASE("a convex solid on a device is exact", "[gl]") {
  if (!device()) return;
  const Solid s = solid_cube(7);
  for (const Index source : {s.nearest(0, 0, 0), s.nearest(.4, .5, .6)})
    CHECK(check_errors(s, source, straight(s, s.positions[source]), 2e-6) < 1e-6);
}

TEST_CASE("around a reflex edge and over a wall on a device", "[gl]") {
  if (!device()) return;
  const Solid l = l_shape(12), w = walled(16);
  const Position around[] = {{1, 0, 0},   {.9, .3, .4}, {0, 0, 1},    {1, 0, 1},
                             {.8, 0, .5}, {.1, .9, .2}, {.3, .8, .9}, {.7, .2, .1}};
  double mean = 0;
  for (const Position& from : around) {
    const Index a = l.nearest(from[0], from[1], from[2]);
    mean += check_errors(l, a, around_l(l, l.positions[a]), 1e-2);
  }
  CHECK(mean < 1e-4 * double(std::size(around)));
  for (const Position& from : {Position{0, 0, 0}, {.25, .5, .5}, {0, 1, .3}}) {
    const Index a = w.nearest(from[0], from[1], from[2]);
    CHECK(check_errors(w, a, over_wall(w, w.positions[a]), 1e-2) < 1e-3);
  }
}

TEST_CASE("solids on a device agree with the serial executor", "[gl]") {
  if (!device()) return;
  for (const std::size_t count : {1u, 6u}) {
    CAPTURE(count);
    compare_with_serial(solid_cube(6), count, 3);
    compare_with_serial(l_shape(8), count, 3);
    compare_with_serial(walled(8), count, 3);
    compare_with_serial(edge_touch(6), count, 3);
    compare_with_serial(vertex_touch(6), count, 3);
  }
}

TEST_CASE("solids with exact answers on a device", "[gl]") {
  if (!device()) return;
  struct Source {
    const char* name;
    Index vertex;
  };
  for (const Source& s :
       {Source{"cube_10k", 8}, {"notch_10k", 14}, {"maze_10k", 32}, {"cavity_10k", 170}}) {
    const auto truth = read_solid_truth(s.name, s.vertex);
    if (!truth) continue;
    const auto mesh = truth->solid.mesh<float>();
    const PointSource source = PointSource::at(s.vertex);
    const auto known = serial(mesh, Sources(&source, 1));
    const auto found = solve(GL{}, mesh, source).distance;
    const Errors by_serial = compare(known, truth->exact), by_device = compare(found, truth->exact);
    CAPTURE(s.name, by_serial.mean, by_device.mean);
    CHECK(by_device.fits);
    CHECK(by_device.mean <= 1.2 * by_serial.mean + 1e-5);
    check_close(difference(known, found), spread_of(mesh, Sources(&source, 1), known));
  }
}

TEST_CASE("solids on a device: again and again, with little room at first", "[gl]") {
  if (!device()) return;
  const Solid s = walled(8);
  const auto mesh = s.mesh<float>();
  const auto sources = some_sources(s, 3, 4);
  const auto known = serial(mesh, sources);
  const Difference spread = spread_of(mesh, sources, known);
  GL narrow;
  narrow.queue = 16;
  GLWorkspace workspace, small;
  DistanceField<float> field;
  for (int n = 0; n < 30; ++n) {
    solve(GL{}, mesh, sources, {}, workspace, field);
    check_close(difference(known, field.distance), spread);
  }
  solve(narrow, mesh, sources, {}, small, field);
  CHECK(small.growths() > 0);
  check_close(difference(known, field.distance), spread);
}

TEST_CASE("solids on a device: radius, budget, what is refused", "[gl]") {
  if (!device()) return;
  const Solid s = solid_cube(8);
  const auto mesh = s.mesh<float>();
  const PointSource source = PointSource::at(0);
  const auto all = straight(s, s.positions[0]);
  PropagateOptions options;
  options.radius = 0.4;
  const auto near = solve(GL{}, mesh, source, options);
  for (std::size_t v = 0; v < all.size(); ++v) {
    if (std::abs(all[v] - 0.4) < 1e-5) continue;
    CHECK(std::isinf(near.distance[v]) == (all[v] > 0.4));
    if (all[v] < 0.4) CHECK(double(near.distance[v]) == Approx(all[v]).epsilon(1e-5));
  }
  CHECK(near.statistics.expansions < mesh.tet_count() / 4);
  options = {};
  options.max_expansions = 200;
  const auto some = solve(GL{}, mesh, source, options);
  CHECK(!some.complete);
  CHECK(some.statistics.expansions <= 200);
  CHECK(std::isinf(some.distance[s.nearest(1, 1, 1)]));
  options = {};
  options.visibility = Visibility::centroid;
  CHECK_THROWS_AS(solve(GL{}, mesh, source, options), UsageError);
  options = {};
  options.accuracy = Accuracy::accurate();
  CHECK_THROWS_WITH(solve(GL{}, mesh, source, options), Catch::Contains("by the accuracy fast"));
}

TEST_CASE("a solid by lengths alone on a device", "[gl]") {
  const auto context = device();
  if (!context) return;
  for (const Solid& s : {solid_cube(7), l_shape(8), edge_touch(5)}) {
    const TetMesh<float> mesh(s.positions.size(), s.tets, s.lengths());
    const PointSource sources[] = {PointSource::at(0), PointSource::in(3, {.1, .2, .3, .4})};
    const auto known = serial(mesh, sources);
    check_close(difference(known, solve(GL{}, mesh, sources).distance),
                spread_of(mesh, sources, known));
  }
}

TEST_CASE("one field a source in a solid on a device", "[gl]") {
  if (!device()) return;
  const Solid s = l_shape(6);
  const auto mesh = s.mesh<float>();
  const auto sources = some_sources(s, 9, 2);
  const std::size_t vertices = mesh.vertex_count();
  for (const std::size_t bytes : {std::size_t{1} << 30, std::size_t{400000}}) {
    GL executor;
    executor.batch_bytes = bytes;  // all at once, or a few at a time
    GLWorkspace workspace;
    std::vector<float> each(sources.size() * vertices);
    CHECK(solve_each(executor, mesh, sources, {}, workspace, each));
    for (std::size_t k = 0; k < sources.size(); ++k) {
      const Sources one(&sources[k], 1);
      const auto known = serial(mesh, one);
      check_close(difference(known, std::span<const float>(each).subspan(k * vertices, vertices)),
                  spread_of(mesh, one, known));
    }
  }
}

}  // namespace plexway::testing::solid_test
