// Wireframes on a GL device: shortest paths along edges, which do not depend on the order of
// updates. Against plain relaxation in double, and against the serial executor.

#include <catch2/catch.hpp>

#include <plexway/executors/gl.hpp>
#include <plexway/solve.hpp>

#include "complexes/test_wires.hpp"
#include "gl/device.hpp"

namespace plexway::testing::wireframe_test {

namespace {

Wires lattice(Index n) {
  Wires w{std::size_t{n} * n * n, {}, {}};
  std::mt19937 random(4);
  const auto at = [n](Index i, Index j, Index k) { return (i * n + j) * n + k; };
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j)
      for (Index k = 0; k < n; ++k) {
        if (i + 1 < n) w.add(at(i, j, k), at(i + 1, j, k), 0.5 + uniform(random));
        if (j + 1 < n) w.add(at(i, j, k), at(i, j + 1, k), 0.5 + uniform(random));
        if (k + 1 < n) w.add(at(i, j, k), at(i, j, k + 1), 0.5 + uniform(random));
      }
  return w;
}

struct Named {
  const char* name;
  Wires wires;
};

std::vector<Named> many_kinds() {
  Wires star{2000, {}, {}};
  for (Index v = 1; v < 2000; ++v) star.add(0, v, 1 + v % 7);
  Wires chain{1500, {}, {}};
  for (Index v = 1; v < 1500; ++v) chain.add(v - 1, v, 0.1 * (1 + v % 3));
  return {{"lattice", lattice(9)},
          {"sparse, several components", random_wires(1, 400, 300)},
          {"dense", random_wires(2, 200, 1500)},
          {"lengths of very different size", random_wires(3, 500, 1200, 4)},
          {"star", star},
          {"chain", chain}};
}

}  // namespace

TEST_CASE("wireframes of many kinds on a device", "[gl]") {
  if (!device()) return;
  for (const Named& one : many_kinds()) {
    INFO(one.name);
    const auto wireframe = one.wires.wireframe<float>();
    std::mt19937 random(6);
    GLWorkspace workspace;
    DistanceField<float> field;
    for (int turn = 0; turn < 4; ++turn) {
      const PointSource source = PointSource::at(one.wires.edges[below(random, 100)][0]);
      const std::span<const PointSource> sources(&source, 1);
      solve(GL{}, wireframe, sources, {}, workspace, field);
      const Difference exact = difference(edge_distances(one.wires, source.vertex), field.distance);
      CHECK(exact.fits);
      CHECK(exact.max < 1e-5);
      const auto serial = solve(Serial{}, wireframe, source);
      CHECK(field.distance == serial.distance);  // the least of the same sums
      CHECK(field.statistics.reached_simplices == serial.statistics.reached_simplices);
      CHECK(field.complete);
    }
  }
}

TEST_CASE("wireframes on a device: several sources, inside edges, with offsets", "[gl]") {
  if (!device()) return;
  for (const Named& one : many_kinds()) {
    INFO(one.name);
    const auto wireframe = one.wires.wireframe<float>();
    std::mt19937 random(16);
    std::vector<PointSource> sources;
    for (int n = 0; n < 7; ++n) {
      const Index e = below(random, one.wires.edges.size());
      sources.push_back(n % 2 == 0 ? PointSource::at(one.wires.edges[e][0])
                                   : PointSource::in(e, {0.25, 0.75}));
      sources.back().offset = n == 3 ? 0.7 : 0;
    }
    for (const std::size_t queue : {0u, 1u}) {
      GL executor;
      executor.queue = queue;
      GLWorkspace workspace;
      DistanceField<float> field;
      solve(executor, wireframe, sources, {}, workspace, field);
      const auto serial = solve(Serial{}, wireframe, sources);
      CHECK(field.distance == serial.distance);
      std::vector<DistanceField<float>> alone;
      for (const PointSource& s : sources) alone.push_back(solve(Serial{}, wireframe, s));
      for (std::size_t v = 0; v < field.label.size(); ++v) {
        INFO("vertex " << v);
        if (std::isinf(field.distance[v])) {
          CHECK(field.label[v] == none);
          continue;
        }
        REQUIRE(field.label[v] < sources.size());
        CHECK(alone[field.label[v]].distance[v] == Approx(field.distance[v]).epsilon(1e-5));
      }
    }
  }
}

TEST_CASE("wireframes on a device: radius, budget, one field a source", "[gl]") {
  if (!device()) return;
  const Wires wires = lattice(8);
  const auto wireframe = wires.wireframe<float>();
  const PointSource source = PointSource::at(77);
  PropagateOptions options;
  options.radius = 3;
  CHECK(solve(GL{}, wireframe, source, options).distance ==
        solve(Serial{}, wireframe, source, options).distance);
  options = {};
  options.max_expansions = 100;
  const auto early = solve(GL{}, wireframe, source, options);
  CHECK_FALSE(early.complete);
  CHECK(early.statistics.expansions <= 100);
  std::vector<PointSource> sources;
  for (Index n = 0; n < 40; ++n) sources.push_back(PointSource::at(n * 11));
  const std::size_t vertices = wireframe.vertex_count();
  std::vector<float> all(sources.size() * vertices);
  for (const std::size_t bytes : {std::size_t{1} << 30, std::size_t{50000}}) {
    GL executor;
    executor.batch_bytes = bytes;
    GLWorkspace workspace;
    CHECK(solve_each(executor, wireframe, sources, {}, workspace, all));
    for (std::size_t k = 0; k < sources.size(); ++k) {
      const std::vector<float> row(all.begin() + static_cast<std::ptrdiff_t>(k * vertices),
                                   all.begin() + static_cast<std::ptrdiff_t>((k + 1) * vertices));
      CHECK(row == solve(Serial{}, wireframe, sources[k]).distance);
    }
  }
}

}  // namespace plexway::testing::wireframe_test
