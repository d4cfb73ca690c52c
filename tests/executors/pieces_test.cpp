#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <random>

#include <plexway/solve.hpp>

#include "executors/parity.hpp"
#include "executors/piece_testing.hpp"
#include "labels/solving.hpp"
#include "labels/workspace_state.hpp"
#include "with_accuracy.hpp"

namespace plexway::testing::pieces_test {

// Surfaces by pieces (OpenMP::piece), by labels; windows are in window_pieces_test.cpp.

namespace {

PropagateOptions fast() { return at(Accuracy::fast()); }

template <class Real>
void check_same_bits(const TriangleMesh<Real>& mesh, const PropagateOptions& options,
                     std::size_t size, unsigned seed) {
  Workspace<Real> workspace;
  DistanceField<Real> first, field;
  for (const std::size_t count : {1u, 6u}) {
    const auto sources = random_sources(mesh, count, seed);
    solve(pieces(1, size), mesh, sources, options, workspace, first);
    for (const int threads : {2, 3, 8}) {
      if (threads != 2 && options.visibility != Visibility::saddles) continue;
      solve(pieces(threads, size), mesh, sources, options, workspace, field);
      CHECK(same_bits(first, field));
    }
    // Whatever the workspace did before.
    solve(Serial{}, mesh, sources, options, workspace, field);
    solve(pieces(2, 2 * size), mesh, sources, options, workspace, field);
    solve(pieces(2, size), mesh, sources, options, workspace, field);
    CHECK(same_bits(first, field));
  }
}

}  // namespace

TEMPLATE_TEST_CASE("pieces: the same bits with any number of threads", "[threads]", float, double) {
  unsigned seed = 0;
  for (const Surface& s : surfaces())
    for (const Visibility visibility : visibilities)
      for (const Schedule schedule : {Schedule::dual_queue, Schedule::fifo}) {
        if (schedule == Schedule::fifo && visibility != Visibility::saddles) continue;
        PropagateOptions options = fast();
        options.visibility = visibility;
        options.schedule = schedule;
        INFO("surface " << seed << " " << name(options));
        check_same_bits(s.mesh<TestType>(), options, 40, ++seed);
      }
  check_same_bits(two_speeds<TestType>(16), fast(), 30, ++seed);
}

TEST_CASE("pieces: 200 solves on eight threads are one", "[threads]") {
  const auto mesh = sphere(4).mesh<float>();
  check_200_solves(mesh, random_sources(mesh, 5, 1), 40, fast());
}

TEMPLATE_TEST_CASE("pieces: a single one is the serial loop", "", float, double) {
  for (const Surface& s : surfaces()) {
    const auto mesh = s.mesh<TestType>();
    const auto sources = random_sources(mesh, 3, 7);
    CHECK(same_bits(solve(Serial{}, mesh, sources, fast()),
                    solve(pieces(2, mesh.face_count()), mesh, sources, fast())));
  }
}

// Where the step is exact the order of work cannot matter.
TEMPLATE_TEST_CASE("pieces: exact where Serial is", "", float, double) {
  const double rounding = sizeof(TestType) == 4 ? 4e-6 : 1e-12;
  for (const std::size_t size : {10u, 64u, 200u}) {
    const Surface flat = random_polygon(5, 400, 300, 3);
    const auto mesh = grid(30, 20, 3, 2).mesh<TestType>();
    const Surface s = grid(30, 20, 3, 2);
    std::mt19937 random(static_cast<unsigned>(size));
    for (int i = 0; i < 4; ++i) {
      const Index source = below(random, s.positions.size());
      const auto field = solve(pieces(2, size), mesh, PointSource::at(source), fast());
      double worst = 0;
      for (std::size_t v = 0; v < s.positions.size(); ++v) {
        const auto &p = s.positions[v], &q = s.positions[source];
        const double exact = std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
        worst = std::max(worst, std::abs(static_cast<double>(field.distance[v]) - exact));
      }
      CHECK(worst < rounding);
    }
    // Around corners, and over vertices where sheets only touch.
    for (const Surface& other : {flat, slit_square(14), bow_tie(12)}) {
      const auto bent = other.mesh<TestType>();
      for (unsigned seed = 1; seed <= 2; ++seed) {
        const auto sources = random_sources(bent, 1, seed);
        const Parity p = parity(solve(Serial{}, bent, sources, fast()),
                                solve(pieces(2, size), bent, sources, fast()));
        INFO("size " << size << ", seed " << seed);
        CHECK(p.reached_by_one == 0);
        CHECK(p.worst < 4 * rounding);
      }
    }
  }
}

TEST_CASE("pieces: as accurate as Serial on curved surfaces") {
  double serial = 0, by_pieces = 0, worst_serial = 0, worst = 0;
  Workspace<float> workspace;
  DistanceField<float> field;
  each_known_surface(100'000, [&](const KnownSurface& known) {
    const PointSource source[] = {known.source};
    const auto error = [&](double& most) {
      const ExactError e = error_of(field.distance, known.exact);
      if (!known.needles()) most = std::max(most, e.worst);
      return e.mean;
    };
    solve(Serial{}, known.mesh, source, fast(), workspace, field);
    serial += error(worst_serial);
    // At single vertices any order of one thread's is as good: on beetle_car another step of
    // Serial's is 5 % short at the vertex where pieces are.
    PropagateOptions other = fast();
    other.step = 2;
    solve(Serial{}, known.mesh, source, other, workspace, field);
    error(worst_serial);
    solve(pieces(2, 2048), known.mesh, source, fast(), workspace, field);
    by_pieces += error(worst);
  });
  REQUIRE(serial > 0);
  CHECK(by_pieces < 1.05 * serial);
  CHECK(worst < 1.5 * worst_serial);
}

// A radius, an offset and a source inside a triangle.
TEST_CASE("pieces: radius, offsets and sources inside triangles", "[threads]") {
  const auto mesh = grid(30, 30).mesh<double>();
  PropagateOptions options = fast();
  options.radius = 0.3;
  const PointSource sources[] = {
      {.vertex = 100, .offset = 0.05}, PointSource::in(700, {.2, .3, .5}), PointSource::at(900)};
  const auto alone = solve(Serial{}, mesh, sources, options);
  const auto field = solve(pieces(4, 50), mesh, sources, options);
  CHECK(field.distance[100] == 0.05);
  const Parity p = parity(alone, field);
  CHECK(p.reached_by_one == 0);
  CHECK(p.worst < 1e-12);
  std::size_t beyond = 0;
  for (const double d : field.distance) beyond += std::isinf(d);
  CHECK(beyond > 100);
  for (std::size_t v = 0; v < field.distance.size(); ++v)
    CHECK((field.label[v] == none) == std::isinf(field.distance[v]));
}

TEST_CASE("pieces: every vertex a source, and offsets far apart", "[threads]") {
  check_every_vertex_a_source(fast(), 1.5e-6);
}

TEST_CASE("pieces: a budget is kept to the last expansion", "[threads]") {
  check_budget(grid(60, 60).mesh<float>(), 200, fast());
}

TEST_CASE("pieces: reports to the calling thread, and can be cancelled", "[threads]") {
  const Surface s = grid(200, 200);
  const Workspace<float> workspace = check_reports(pieces(4, 2000), s.mesh<float>(), fast());
  const std::size_t bytes = workspace.state().pieces.bytes();
  CHECK(bytes > 64 * s.faces.size());
  CHECK(workspace.bytes() > bytes);
}

TEST_CASE("pieces: a workspace goes from surface to surface") {
  Workspace<double> workspace;
  DistanceField<double> field;
  for (int i = 0; i < 2; ++i)
    for (const Surface& s : {sphere(3), grid(20, 20), cube(6)}) {
      const auto mesh = s.mesh<double>();
      const auto sources = random_sources(mesh, 2, 5);
      solve(pieces(2, 50), mesh, sources, fast(), workspace, field);
      CHECK(same_bits(field, solve(pieces(1, 50), mesh, sources, fast())));
    }
}

}  // namespace plexway::testing::pieces_test
