#include <catch2/catch.hpp>

#include <plexway/error.hpp>
#include <plexway/solve.hpp>

#include "complexes/test_wires.hpp"
#include "kernel/hinge.hpp"
#include "labels/solving.hpp"

namespace plexway::testing::wireframe_test {

namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

template <class Real>
constexpr double exact_to = sizeof(Real) == 4 ? 1e-6 : 1e-14;

template <class Real>
bool agrees(const DistanceField<Real>& field, const std::vector<double>& exact) {
  const Errors e = compare(field.distance, exact);
  CAPTURE(e.max);
  CHECK(e.fits);
  return e.max <= exact_to<Real>;
}

Wires line(Index edges, double length) {
  Wires w{edges + 1, {}, {}};
  for (Index i = 0; i < edges; ++i) w.add(i, i + 1, length);
  return w;
}

/// The unit square lattice, corner (i, j) at i n + j.
Wires lattice(Index n) {
  Wires w{n * n, {}, {}};
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j) {
      if (i > 0) w.add(i * n + j, (i - 1) * n + j, 1);
      if (j > 0) w.add(i * n + j, i * n + j - 1, 1);
    }
  return w;
}

}  // namespace

TEMPLATE_TEST_CASE("wireframe: lattices and circles have closed forms", "", float, double) {
  const Index n = 40;
  const auto taxi = solve(Serial{}, lattice(n).wireframe<TestType>(), PointSource::at(7 * n + 9));
  for (int i = 0; i < int(n); ++i)
    for (int j = 0; j < int(n); ++j)
      REQUIRE(double(taxi.distance[std::size_t(i * int(n) + j)]) ==
              std::abs(i - 7) + std::abs(j - 9));

  std::vector<Position> corners;
  std::vector<std::array<Index, 2>> edges;
  const Index m = 90;
  for (Index i = 0; i < m; ++i) {
    const double angle = 2 * std::numbers::pi * i / m;
    corners.push_back({std::cos(angle), std::sin(angle), 0.5});
    edges.push_back({i, (i + 1) % m});
  }
  const auto round = solve(Serial{}, Wireframe<TestType>(corners, edges), PointSource::at(10));
  for (Index i = 0; i < m; ++i) {
    const double steps = std::min((i + m - 10) % m, (10 + m - i) % m);
    CHECK(double(round.distance[i]) == Approx(steps * 2 * std::sin(std::numbers::pi / m)));
  }
}

TEMPLATE_TEST_CASE("wireframe: any graph, any schedule, any size of lengths", "", float, double) {
  for (unsigned seed = 0; seed < 24; ++seed) {
    const double spread = seed % 3 == 0 ? 6 : 0.5;
    const Wires wires = random_wires(seed, 40 + 10 * seed, 30 + 16 * seed, spread);
    const auto w = wires.wireframe<TestType>();
    const Index source = 3 * seed % Index(wires.vertices);
    const std::vector<double> exact = edge_distances(wires, source);
    for (const Schedule schedule : schedules)
      for (const double step : {1e-3, 1., 1e5}) {
        PropagateOptions options;
        options.schedule = schedule;
        options.step = step;
        CAPTURE(seed, name(options), step);
        REQUIRE(agrees(solve(Serial{}, w, PointSource::at(source), options), exact));
      }
  }
}

TEMPLATE_TEST_CASE("wireframe: the hinge kernel of a vertex comes down to sigma + length", "",
                   float, double) {
  using Kernel = detail::kernel::HingeKernel<TestType, 0>;
  const TestType none_in_a_point[1] = {0};
  const auto pose = Kernel::make_pose(none_in_a_point);
  TestType sigma = TestType(.7);
  const auto wires = random_wires(3, 500, 900).wireframe<TestType>();
  for (const auto& arc : wires.arcs()) {
    const TestType squared[1] = {arc.length * arc.length};
    if (squared[0] < std::numeric_limits<TestType>::min()) continue;  // it went under
    const auto S = Kernel::locate(pose, squared);
    REQUIRE(Kernel::carry(pose, S, sigma, S, false, 0).sigma == sigma + arc.length);
    sigma = arc.length;
  }
}

TEMPLATE_TEST_CASE("wireframe: a source anywhere on an edge", "", float, double) {
  const Wires wires = random_wires(8, 80, 120);
  const auto w = wires.wireframe<TestType>();
  for (Index e = 0; e < wires.edges.size(); e += 3)
    for (const double t : {0., .25, .6, 1.}) {
      std::vector<double> start(wires.vertices, inf);
      double &a = start[wires.edges[e][0]], &b = start[wires.edges[e][1]];
      a = std::min(a, 2 + t * wires.lengths[e]);
      b = std::min(b, 2 + (1 - t) * wires.lengths[e]);
      PointSource source = PointSource::in(e, {1 - t, t});
      source.offset = 2;
      CAPTURE(e, t);
      REQUIRE(agrees(solve(Serial{}, w, source), edge_distances(wires, start)));
    }
  // On a loop both ways lead to the same vertex.
  const Wireframe<TestType> loop(2, std::vector<std::array<Index, 2>>{{1, 1}, {0, 1}},
                                 std::vector<double>{4, 1});
  CHECK(solve(Serial{}, loop, PointSource::in(0, {.25, .75})).distance ==
        std::vector<TestType>{2, 1});
}

TEMPLATE_TEST_CASE("wireframe: several sources, offsets and labels", "", float, double) {
  for (unsigned seed = 0; seed < 12; ++seed) {
    const Wires wires = random_wires(seed, 120, 200);
    const auto w = wires.wireframe<TestType>();
    const std::vector<PointSource> sources = {{.vertex = 5},
                                              {.vertex = 60, .offset = .3},
                                              PointSource::in(17, {.5, .5}),
                                              {.vertex = 5},
                                              {.vertex = 100, .offset = 1e3}};
    std::vector<std::vector<double>> alone;
    for (const PointSource& s : sources) {
      std::vector<double> start(wires.vertices, inf);
      if (s.vertex != none) {
        start[s.vertex] = s.offset;
      } else {
        for (const Index v : wires.edges[17]) start[v] = .5 * wires.lengths[17];
      }
      alone.push_back(edge_distances(wires, start));
    }
    std::vector<double> exact(wires.vertices, inf);
    for (const auto& d : alone)
      for (std::size_t v = 0; v < d.size(); ++v) exact[v] = std::min(exact[v], d[v]);
    for (const Schedule schedule : schedules) {
      PropagateOptions options;
      options.schedule = schedule;
      const auto field = solve(Serial{}, w, sources, options);
      REQUIRE(agrees(field, exact));
      REQUIRE(field.label.size() == wires.vertices);
      CHECK(field.label[5] == 0);
      CHECK(field.distance[5] == 0);
      for (std::size_t v = 0; v < wires.vertices; ++v) {
        if (std::isinf(exact[v])) {
          REQUIRE(field.label[v] == none);
        } else {
          REQUIRE(field.label[v] < sources.size());
          REQUIRE(alone[field.label[v]][v] == Approx(exact[v]).epsilon(1e-6));
        }
      }
    }
  }
}

TEMPLATE_TEST_CASE("wireframe: radius, budget, progress and cancelling", "", float, double) {
  const Wires wires = line(100000, .5);
  const auto w = wires.wireframe<TestType>();
  PropagateOptions options;
  options.radius = 100;
  const auto near = solve(Serial{}, w, PointSource::at(1000), options);
  for (Index v = 0; v < wires.vertices; ++v) {
    const double d = .5 * std::abs(double(v) - 1000);
    REQUIRE(double(near.distance[v]) == (d <= 100 ? d : inf));
  }
  CHECK(near.complete);
  CHECK(near.statistics.expansions < 500);

  options = {};
  options.max_expansions = 50;
  const auto part = solve(Serial{}, w, PointSource::at(1000), options);
  CHECK_FALSE(part.complete);
  CHECK(part.statistics.expansions == 50);
  CHECK(part.distance[1010] == 5);
  CHECK(std::isinf(part.distance[1100]));
  options.max_expansions = wires.vertices;  // just enough
  CHECK(solve(Serial{}, w, PointSource::at(0), options).complete);
  options.max_expansions = 0;
  CHECK_FALSE(solve(Serial{}, w, PointSource::at(0), options).complete);

  options = {};
  std::vector<Progress> calls;
  options.progress = [&](const Progress& p) { return calls.push_back(p), true; };
  const auto whole = solve(Serial{}, w, PointSource::at(0), options);
  REQUIRE(calls.size() == 1);
  CHECK(calls[0].expansions == 65536);
  CHECK(calls[0].reached == 65537);
  CHECK(calls[0].simplices == wires.vertices);
  CHECK(calls[0].distance == 32768);
  CHECK(whole.statistics.expansions == wires.vertices);
  CHECK(whole.statistics.updates == wires.vertices);
  CHECK(whole.statistics.reached_simplices == wires.vertices);
  options.progress = [](const Progress&) { return false; };
  CHECK_THROWS_AS(solve(Serial{}, w, PointSource::at(0), options), Cancelled);
}

TEMPLATE_TEST_CASE("wireframe: no input makes it quadratic", "", float, double) {
  // First in first out brings news from the far end one vertex a round: every distance is improved
  // as often as there are vertices beyond. Within one step of the dual queue that would happen too.
  const auto hub_and_chain = [](Index n) {
    Wires wires{n + 1, {}, {}};
    for (Index i = 1; i <= n; ++i) wires.add(0, i, 2 + double(n - i) / n);
    for (Index i = 1; i < n; ++i) wires.add(i, i + 1, 1e-6);
    return wires.wireframe<TestType>();
  };
  PropagateOptions as_they_come;
  as_they_come.schedule = Schedule::fifo;
  const auto slow = solve(Serial{}, hub_and_chain(1000), PointSource::at(0), as_they_come);
  CHECK(slow.statistics.expansions > 200 * 1000);

  const Index n = 20000;
  const auto w = hub_and_chain(n);
  const auto field = solve(Serial{}, w, PointSource::at(0));
  CHECK(field.statistics.expansions < 20 * n);
  PropagateOptions options;
  options.schedule = Schedule::priority;
  const auto settled = solve(Serial{}, w, PointSource::at(0), options);
  CHECK(settled.statistics.expansions == n + 1);
  CHECK(field.distance == settled.distance);
  for (Index i = 1; i <= n; i += 499)
    CHECK(double(field.distance[i]) == Approx(2 + 1e-6 * (n - i)).epsilon(1e-3));
}

TEMPLATE_TEST_CASE("wireframe: lengths of very different size", "", float, double) {
  const Wires wires = random_wires(77, 20000, 60000, 6);
  const auto w = wires.wireframe<TestType>();
  PropagateOptions options;
  options.schedule = Schedule::priority;
  const auto settled = solve(Serial{}, w, PointSource::at(2), options);
  const auto field = solve(Serial{}, w, PointSource::at(2));
  CHECK(field.distance == settled.distance);
  CHECK(field.statistics.expansions < 12 * wires.vertices);
}

TEMPLATE_TEST_CASE("wireframe: a workspace is used again, also for something else", "", float,
                   double) {
  Workspace<TestType> workspace;
  DistanceField<TestType> field;
  const PointSource one[] = {PointSource::at(3)};
  const PointSource two[] = {PointSource::at(3), PointSource::at(4)};
  const Surface surface = grid(5, 5);
  const auto mesh = surface.mesh<TestType>();
  for (const unsigned seed : {1u, 2u, 3u}) {
    const Wires wires = random_wires(seed, 50 * seed, 80 * seed);
    const auto w = wires.wireframe<TestType>();
    solve(Serial{}, w, two, {}, workspace, field);
    CHECK(field.label.size() == wires.vertices);
    solve(Serial{}, w, one, {}, workspace, field);
    CHECK(field.label.empty());
    CHECK(agrees(field, edge_distances(wires, 3)));
    solve(Serial{}, mesh, one, {}, workspace, field);
    CHECK(field.distance[0] == Approx(.6));
  }
}

TEMPLATE_TEST_CASE("wireframe: the distance at a source is its offset, and scale is free", "",
                   float, double) {
  Wires wires = random_wires(9, 100, 150);
  const auto plain = solve(Serial{}, wires.wireframe<TestType>(), PointSource::at(7));
  for (const double offset : {0., 1e-20, .1, 3., 1e9})
    CHECK(solve(Serial{}, wires.wireframe<TestType>(), PointSource{.vertex = 7, .offset = offset})
              .distance[7] == static_cast<TestType>(offset));
  for (double& l : wires.lengths) l *= 0x1p40;
  const auto scaled = solve(Serial{}, wires.wireframe<TestType>(), PointSource::at(7));
  for (std::size_t v = 0; v < wires.vertices; ++v)
    REQUIRE(scaled.distance[v] == plain.distance[v] * TestType(0x1p40));
}

TEST_CASE("wireframe: sources and options that make no sense") {
  const auto w = line(4, 1).wireframe<float>();
  const auto refused = [&](const PointSource& source, const PropagateOptions& options = {}) {
    CHECK_THROWS_AS(solve(Serial{}, w, source, options), UsageError);
  };
  refused(PointSource::at(5));
  refused(PointSource::in(4, {.5, .5}));
  refused(PointSource::in(0, {.5, .6}));
  refused(PointSource::in(0, {-.5, 1.5}));
  refused(PointSource::in(0, {.5, .25, .25}));
  refused({.vertex = 0, .offset = -1});
  refused({.vertex = 0, .offset = inf});
  refused({.vertex = 0, .offset = std::nan("")});
  PropagateOptions no_step, no_radius;
  no_step.step = 0;
  refused(PointSource::at(0), no_step);
  no_radius.radius = -1;
  refused(PointSource::at(0), no_radius);
  CHECK_THROWS_AS(solve(Serial{}, w, std::span<const PointSource>()), UsageError);
}

}  // namespace plexway::testing::wireframe_test
