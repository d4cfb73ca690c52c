// What holds for a propagation on a device whatever the domain: queues that grow, budgets, radius,
// progress, repeats, bad options.

#include <catch2/catch.hpp>

#include <plexway/executors/gl.hpp>
#include <plexway/solve.hpp>

#include "complexes/test_meshes.hpp"
#include "gl/device.hpp"
#include "with_accuracy.hpp"

namespace plexway::testing::rounds_test {

namespace {

Surface hills(Index n) {
  Surface s = grid(n, n);
  for (Position& p : s.positions) p[2] = 0.2 * std::sin(9 * p[0]) * std::cos(7 * p[1]);
  return s;
}

std::vector<PointSource> some_sources(std::size_t vertices, std::size_t count) {
  std::vector<PointSource> sources;
  for (std::size_t n = 0; n < count; ++n)
    sources.push_back(PointSource::at(static_cast<Index>((n * 7919 + 5) % vertices)));
  return sources;
}

}  // namespace

TEST_CASE("queues on a device that are too short grow and nothing is lost", "[gl]") {
  if (!device()) return;
  // Around every vertex the surface is flat: whatever the order, the result is the same.
  const Surface s = grid(40, 30, 4, 3);
  const auto mesh = s.mesh<float>();
  for (const std::size_t count : {1u, 30u}) {
    const auto sources = some_sources(s.positions.size(), count);
    const auto serial = plexway::solve(Serial{}, mesh, sources, by_labels());
    for (const std::size_t queue : {1u, 2u, 17u, 100u}) {
      GL executor;
      executor.queue = queue;
      GLWorkspace workspace;
      DistanceField<float> field;
      plexway::solve(executor, mesh, sources, {}, workspace, field);
      const Difference found = difference(serial.distance, field.distance);
      CAPTURE(count, queue, workspace.growths(), found.mean, found.max);
      CHECK((workspace.growths() > 0) == (queue < 100 || count > 1));
      CHECK(found.fits);
      CHECK(found.max < 1e-5);
      CHECK(field.statistics.reached_simplices == mesh.face_count());
      plexway::solve(executor, mesh, sources, {}, workspace, field);  // what grew stays
      CHECK(workspace.growths() == 0);
      CHECK(difference(serial.distance, field.distance).max < 1e-5);
    }
  }
}

TEST_CASE("queues grow where labels are put in between rounds", "[gl]") {
  if (!device()) return;
  const Surface s = bow_tie(8);  // the other half is entered through its pinch
  const auto mesh = s.mesh<float>();
  const PointSource source = PointSource::at(3);
  const auto serial = plexway::solve(Serial{}, mesh, source, by_labels());
  GL executor;
  executor.queue = 1;
  GLWorkspace workspace;
  DistanceField<float> field;
  plexway::solve(executor, mesh, std::span<const PointSource>(&source, 1), {}, workspace, field);
  CHECK(workspace.growths() > 0);
  CHECK(difference(serial.distance, field.distance).fits);
  CHECK(difference(serial.distance, field.distance).max < 1e-5);
}

TEST_CASE("two hundred repeats on a device are the same to the last bit", "[gl]") {
  if (!device()) return;
  const Surface s = hills(60);  // fronts of several work groups
  const auto mesh = s.mesh<float>();
  const auto sources = some_sources(s.positions.size(), 3);
  GLWorkspace workspace;
  DistanceField<float> first, field;
  plexway::solve(GL{}, mesh, sources, {}, workspace, first);
  int same = 0;
  for (int n = 0; n < 200; ++n) {
    GL executor;
    GLWorkspace narrow;
    executor.queue = n % 20 == 19 ? 64 : 0;  // queues that overflow make no difference
    plexway::solve(executor, mesh, sources, {}, n % 20 == 19 ? narrow : workspace, field);
    CHECK((narrow.growths() > 0) == (n % 20 == 19));
    same += field.distance == first.distance && field.label == first.label &&
            field.statistics.expansions == first.statistics.expansions;
  }
  CHECK(same == 200);
}

TEST_CASE("within the radius a device finds what it finds without, beyond nothing", "[gl]") {
  if (!device()) return;
  const Surface s = grid(30, 30);
  const auto mesh = s.mesh<float>();
  PropagateOptions options;
  options.radius = 0.4;
  const PointSource source = PointSource::at(200);
  const auto all = plexway::solve(GL{}, mesh, source);
  const auto some = plexway::solve(GL{}, mesh, source, options);
  CHECK(some.complete);
  CHECK(some.statistics.reached_simplices < mesh.face_count());
  for (std::size_t v = 0; v < all.distance.size(); ++v) {
    if (all.distance[v] < 0.3999F) CHECK(some.distance[v] == Approx(all.distance[v]).epsilon(1e-5));
    if (all.distance[v] > 0.4001F) CHECK(std::isinf(some.distance[v]));
  }
}

TEST_CASE("an expansion budget ends a propagation on a device early", "[gl]") {
  if (!device()) return;
  const Surface s = grid(20, 20);
  const auto mesh = s.mesh<float>();
  const PointSource source = PointSource::at(210);
  const auto all = plexway::solve(GL{}, mesh, source);
  CHECK(all.complete);
  PropagateOptions options;
  for (const std::size_t budget : {0u, 1u, 40u, 333u}) {
    options.max_expansions = budget;
    const auto some = plexway::solve(GL{}, mesh, source, options);
    CAPTURE(budget);
    CHECK_FALSE(some.complete);
    CHECK(some.statistics.expansions <= budget);
    CHECK(some.distance[210] == 0);
    std::size_t finite = 0;
    for (std::size_t v = 0; v < all.distance.size(); ++v) {
      finite += !std::isinf(some.distance[v]);
      CHECK(some.distance[v] >= all.distance[v] * (1 - 1e-5F));
    }
    CHECK(finite < all.distance.size());
    CHECK(finite > 1);
  }
}

TEST_CASE("progress on a device is told and may cancel", "[gl]") {
  if (!device()) return;
  const auto mesh = grid(60, 60).mesh<float>();
  const PointSource source = PointSource::at(0);
  PropagateOptions options;
  std::size_t calls = 0, last = 0;
  options.progress = [&](const Progress& p) {
    ++calls;
    CHECK(p.expansions >= last);
    CHECK(p.simplices == mesh.face_count());
    CHECK(p.reached <= p.simplices);
    last = p.expansions;
    return true;
  };
  GLWorkspace workspace;
  DistanceField<float> field;
  const std::span<const PointSource> sources(&source, 1);
  plexway::solve(GL{}, mesh, sources, options, workspace, field);
  CHECK(calls > 1);
  const auto before = field.distance;
  options.progress = [](const Progress&) { return false; };
  CHECK_THROWS_AS(plexway::solve(GL{}, mesh, sources, options, workspace, field), Cancelled);
  plexway::solve(GL{}, mesh, sources, {}, workspace, field);  // and the workspace is as good as new
  CHECK(difference(before, field.distance).max < 1e-5);
}

TEST_CASE("a workspace on a device may meet another domain", "[gl]") {
  if (!device()) return;
  GLWorkspace workspace;
  DistanceField<float> field;
  const PointSource source = PointSource::at(0);
  const std::span<const PointSource> sources(&source, 1);
  for (const Index n : {5u, 20u, 9u}) {
    const auto mesh = grid(n, n).mesh<float>();
    plexway::solve(GL{}, mesh, sources, {}, workspace, field);
    CHECK(field.distance.size() == (n + 1) * (n + 1));
    CHECK(difference(plexway::solve(Serial{}, mesh, source, by_labels()).distance, field.distance)
              .max < 1e-5);
  }
  CHECK(workspace.bytes() > 0);
}

TEST_CASE("the gl executor refuses what it cannot do", "[gl]") {
  if (!device()) return;
  const auto mesh = grid(3, 3).mesh<float>();
  const PointSource source = PointSource::at(0);
  const auto solve = [&](const PropagateOptions& options) {
    return plexway::solve(GL{}, mesh, source, options);
  };
  PropagateOptions options;
  options.schedule = Schedule::priority;
  CHECK_THROWS_AS(solve(options), UsageError);
  options = {};
  options.visibility = Visibility::tuned;
  CHECK_THROWS_AS(solve(options), UsageError);
  options = {};
  options.step = 0;
  CHECK_THROWS_AS(solve(options), UsageError);
  CHECK_THROWS_AS(plexway::solve(GL{}, mesh, PointSource::at(99)), UsageError);
  CHECK_THROWS_AS(plexway::solve(GL{}, mesh, std::span<const PointSource>()), UsageError);
  GL nowhere;
  nowhere.device = 77;
  CHECK_THROWS_AS(plexway::solve(nowhere, mesh, source), UsageError);
}

}  // namespace plexway::testing::rounds_test
