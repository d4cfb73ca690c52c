// Solids on a GL device, by the literal step, against closed forms, and beside one thread against
// strings.

#include <algorithm>
#include <catch2/catch.hpp>
#include <random>
#include <vector>

#include <plexway/executors/gl.hpp>
#include <plexway/solve.hpp>

#include "gl/device.hpp"
#include "labels/solid_closed_forms.hpp"
#include "with_accuracy.hpp"

namespace plexway::testing::solid_test {

namespace {

using Sources = std::span<const PointSource>;

/// Mean errors of a device and of one thread beside strings, which are exact. The order of work
/// decides now and then which of two paths a tetrahedron keeps, and no order is right.
struct BesideExact {
  double device = 0, one_thread = 0;

  void add(const TetMesh<double>& mesh, Sources sources, const std::vector<float>& known,
           const std::vector<float>& found) {
    const std::vector<double> exact = solve(Serial{}, mesh, sources).distance;
    const Errors there = compare(found, exact);
    CAPTURE(there.mean, there.max);
    CHECK(there.fits);
    CHECK(there.mean < 5e-3);
    CHECK(there.max < .1);
    device += there.mean;
    one_thread += compare(known, exact).mean;
  }
};

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

void check_beside_one_thread(const Solid& s, std::size_t count, unsigned turns,
                             BesideExact& beside) {
  const auto mesh = s.mesh<float>();
  GLWorkspace workspace;
  DistanceField<float> field;
  for (unsigned turn = 0; turn < turns; ++turn) {
    const auto sources = some_sources(s, count, turn);
    const auto known = solve(Serial{}, mesh, sources, by_labels());
    solve(GL{}, mesh, sources, {}, workspace, field);
    beside.add(s.mesh<double>(), sources, known.distance, field.distance);
    CHECK(field.complete);
    CHECK(field.statistics.reached_simplices == known.statistics.reached_simplices);
    if (count == 1) continue;
    REQUIRE(field.label.size() == known.label.size());
    std::size_t others = 0;
    for (std::size_t v = 0; v < known.label.size(); ++v) others += known.label[v] != field.label[v];
    CHECK(others <= known.label.size() / 50);  // equally near to both
  }
}

/// The device's mean error, and the worst.
Errors errors_of(const Solid& s, Index source, const std::vector<double>& exact) {
  const Errors e = compare(solve(GL{}, s.mesh<float>(), PointSource::at(source)).distance, exact);
  CHECK(e.fits);
  return e;
}

}  // namespace

TEST_CASE("solids with closed forms on a device", "[gl]") {
  if (!device()) return;
  const Solid c = solid_cube(7), l = l_shape(12), w = walled(16);
  double mean = 0;
  const auto add = [&](const Errors& e) {
    CAPTURE(e.mean, e.max);
    CHECK(e.mean < 5e-3);
    CHECK(e.max < .1);
    mean += e.mean;
  };
  for (const Index a : {c.nearest(0, 0, 0), c.nearest(.4, .5, .6)})
    add(errors_of(c, a, straight(c, c.positions[a])));
  for (const Position& from : {Position{1, 0, 0}, {.9, .3, .4}, {0, 0, 1}, {.1, .9, .2}}) {
    const Index a = l.nearest(from[0], from[1], from[2]);
    add(errors_of(l, a, around_l(l, l.positions[a])));
  }
  for (const Position& from : {Position{0, 0, 0}, {.25, .5, .5}, {0, 1, .3}}) {
    const Index a = w.nearest(from[0], from[1], from[2]);
    add(errors_of(w, a, over_wall(w, w.positions[a])));
  }
  CHECK(mean < 9 * 2.5e-3);
}

TEST_CASE("solids on a device are as near to exact as one thread", "[gl]") {
  if (!device()) return;
  BesideExact beside;
  for (const std::size_t count : {1u, 6u}) {
    CAPTURE(count);
    check_beside_one_thread(solid_cube(6), count, 3, beside);
    check_beside_one_thread(l_shape(8), count, 3, beside);
    check_beside_one_thread(walled(8), count, 3, beside);
    check_beside_one_thread(edge_touch(6), count, 3, beside);
    check_beside_one_thread(vertex_touch(6), count, 3, beside);
  }
  CAPTURE(beside.device, beside.one_thread);
  CHECK(beside.device <= 1.1 * beside.one_thread);
}

TEST_CASE("solids on a device: again and again, with little room at first", "[gl]") {
  if (!device()) return;
  const Solid s = walled(8);
  const auto mesh = s.mesh<float>();
  const auto sources = some_sources(s, 3, 4);
  GL narrow;
  narrow.queue = 16;
  GLWorkspace workspace, small;
  DistanceField<float> field;
  solve(GL{}, mesh, sources, {}, workspace, field);
  const auto known = field.distance;
  for (int n = 0; n < 30; ++n) {
    solve(GL{}, mesh, sources, {}, workspace, field);
    CHECK(field.distance == known);
  }
  solve(narrow, mesh, sources, {}, small, field);
  CHECK(small.growths() > 0);
  CHECK(field.distance == known);
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
  options = {};
  options.visibility = Visibility::centroid;
  CHECK_THROWS_AS(solve(GL{}, mesh, source, options), UsageError);
  options = {};
  options.accuracy = Accuracy::accurate();
  CHECK_THROWS_WITH(solve(GL{}, mesh, source, options), Catch::Contains("by the accuracy fast"));
}

TEST_CASE("a solid by lengths alone on a device", "[gl]") {
  if (!device()) return;
  BesideExact beside;
  for (const Solid& s : {solid_cube(7), l_shape(8), edge_touch(5)}) {
    const TetMesh<float> mesh(s.positions.size(), s.tets, s.lengths());
    const PointSource sources[] = {PointSource::at(0), PointSource::in(3, {.1, .2, .3, .4})};
    beside.add(s.mesh<double>(), sources, solve(Serial{}, mesh, sources, by_labels()).distance,
               solve(GL{}, mesh, sources).distance);
  }
  CAPTURE(beside.device, beside.one_thread);
  CHECK(beside.device <= 1.1 * beside.one_thread);
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
      const auto alone = solve(GL{}, mesh, sources[k]).distance;
      CHECK(std::equal(alone.begin(), alone.end(),
                       each.begin() + static_cast<std::ptrdiff_t>(k * vertices)));
    }
  }
}

}  // namespace plexway::testing::solid_test
