#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <new>
#include <random>
#include <vector>

#include <plexway/solve.hpp>

#include "complexes/jittered.hpp"
#include "executors/parity.hpp"
#include "executors/parts_testing.hpp"
#include "executors/piece_testing.hpp"
#include "labels/solving.hpp"
#include "labels/workspace_state.hpp"
#include "with_accuracy.hpp"

namespace plexway::testing::pieces_test {
using namespace detail;

// Surfaces by pieces (OpenMP::piece), by labels and by windows.

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
  for (const PropagateOptions& options : {fast(), PropagateOptions{}})
    check_200_solves(mesh, random_sources(mesh, 5, 1), 40, options);
}

TEMPLATE_TEST_CASE("pieces: a single one is the serial loop", "", float, double) {
  for (const Surface& s : surfaces()) {
    const auto mesh = s.mesh<TestType>();
    const auto sources = random_sources(mesh, 3, 7);
    for (const PropagateOptions& options : {fast(), PropagateOptions{}})
      CHECK(same_bits(solve(Serial{}, mesh, sources, options),
                      solve(pieces(2, mesh.face_count()), mesh, sources, options)));
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

// The worst errors on curved surfaces, of Serial and by pieces, whose means are alike.
std::array<double, 2> worst_on_curved(std::size_t faces, const PropagateOptions& options) {
  double serial = 0, by_pieces = 0;
  std::array<double, 2> worst = {};
  const bool labels = options.accuracy == Accuracy::fast();
  Workspace<float> workspace;
  DistanceField<float> field;
  each_known_surface(faces, [&](const KnownSurface& known) {
    const PointSource source[] = {known.source};
    const auto error = [&](double& most) {
      CHECK(field.accuracy == options.accuracy);
      const ExactError e = error_of(field.distance, known.exact);
      if (!labels || !known.needles()) most = std::max(most, e.worst);
      return e.mean;
    };
    solve(Serial{}, known.mesh, source, options, workspace, field);
    serial += error(worst[0]);
    if (labels) {
      // At single vertices any order of one thread's is as good: on beetle_car another step of
      // Serial's is 5 % short at the vertex where pieces are.
      PropagateOptions other = options;
      other.step = 2;
      solve(Serial{}, known.mesh, source, other, workspace, field);
      error(worst[0]);
    }
    solve(pieces(2, 2048), known.mesh, source, options, workspace, field);
    by_pieces += error(worst[1]);
  });
  REQUIRE(serial > 0);
  CHECK(by_pieces < 1.05 * serial);
  return worst;
}

TEST_CASE("pieces: as accurate as Serial on curved surfaces") {
  const auto [serial, by_pieces] = worst_on_curved(100'000, fast());
  CHECK(by_pieces < 1.5 * serial);
}

TEST_CASE("pieces: merged windows are as accurate as Serial's on curved surfaces") {
  // As much as is asked of Serial's; which vertex is worst is chance.
  CHECK(worst_on_curved(60'000, at(Accuracy::accurate()))[1] <= 5e-3);
}

TEST_CASE("pieces: what the digest of a domain threw leaves none behind") {
  PieceMemory memory;
  const auto mesh = grid(2, 2).mesh<float>();
  CHECK_THROWS_AS(memory.digest_of(mesh, []() -> unsigned { throw std::bad_alloc(); }),
                  std::bad_alloc);
  CHECK(memory.digest_of(mesh, [] { return 7u; }) == 7);
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
  check_every_vertex_a_source({}, 1e-4);
}

TEST_CASE("pieces: a budget is kept to the last expansion", "[threads]") {
  for (const PropagateOptions& options : {fast(), PropagateOptions{}})
    check_budget(grid(60, 60).mesh<float>(), 200, options);
}

TEST_CASE("pieces: reports to the calling thread, and can be cancelled", "[threads]") {
  const Surface s = grid(200, 200);
  const Workspace<float> workspace = check_reports(pieces(4, 2000), s.mesh<float>(), fast());
  check_reports(pieces(4, 2000), s.mesh<float>(), {});
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

// Windows by pieces (OpenMP::piece): the bits of Serial where they are exact, as accurate where
// they are merged, and the same with any number of threads.

TEST_CASE("pieces: exact windows have the bits of Serial", "[threads]") {
  unsigned seed = 0;
  for (const Surface& s : surfaces()) {
    const auto mesh = s.mesh<double>();
    Workspace<double> alone, workspace;
    DistanceField<double> field, by_pieces;
    for (const std::size_t count : {1u, 5u}) {
      const auto sources = mixed_sources(s, count, ++seed);
      const auto options = at(Accuracy::exact());
      solve(Serial{}, mesh, sources, options, alone, field);
      for (const std::size_t size : {120u, 25u})
        for (const int threads : {1, 2, 3, 8}) {
          if (size == 120 && threads != 2) continue;
          solve(pieces(threads, size), mesh, sources, options, workspace, by_pieces);
          INFO("surface " << seed << ", pieces of " << size << ", threads " << threads);
          CHECK(by_pieces.distance == field.distance);
          CHECK(by_pieces.complete);
          CHECK(by_pieces.accuracy == Accuracy::exact());
          CHECK(by_pieces.error == field.error);
        }
    }
  }
}

TEMPLATE_TEST_CASE("pieces: merged windows have the same bits with any number of threads",
                   "[threads]", float, double) {
  unsigned seed = 0;
  for (const Surface& s : surfaces()) {
    const auto mesh = s.mesh<TestType>();
    Workspace<TestType> workspace;
    DistanceField<TestType> first, field;
    for (const std::size_t count : {1u, 5u}) {
      const auto sources = mixed_sources(s, count, ++seed);
      const auto options = at(Accuracy::accurate());
      solve(pieces(1, 40), mesh, sources, options, workspace, first);
      for (const int threads : {2, 3, 8}) {
        solve(pieces(threads, 40), mesh, sources, options, workspace, field);
        INFO("surface " << seed << ", threads " << threads);
        CHECK(same_bits(first, field));
        CHECK(first.error == field.error);
      }
      // Whatever the workspace did before.
      solve(pieces(2, 80), mesh, sources, at(Accuracy::fast()), workspace, field);
      solve(Serial{}, mesh, sources, options, workspace, field);
      solve(pieces(2, 40), mesh, sources, options, workspace, field);
      CHECK(same_bits(first, field));
      CHECK(first.error == field.error);
    }
  }
}

// Flat ground and its folds: the closed form is the straight line.
TEST_CASE("pieces: windows in planes, around corners and over vertices that only touch") {
  for (const std::size_t size : {10u, 64u, 200u}) {
    const Surface flat = grid(30, 20, 3, 2);
    const auto mesh = flat.mesh<double>();
    std::mt19937 random(static_cast<unsigned>(size));
    for (int i = 0; i < 3; ++i) {
      const Index source = below(random, flat.positions.size());
      for (const Accuracy accuracy : {Accuracy::exact(), Accuracy::accurate()}) {
        const auto field = solve(pieces(2, size), mesh, PointSource::at(source), at(accuracy));
        double worst = 0;
        for (std::size_t v = 0; v < flat.positions.size(); ++v) {
          const auto &p = flat.positions[v], &q = flat.positions[source];
          const double exact = std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
          worst = std::max(worst, std::abs(field.distance[v] - exact));
        }
        CHECK(worst < (accuracy == Accuracy::exact() ? 1e-12 : 1e-3));
      }
    }
    for (const Surface& other : {random_polygon(5, 400, 300, 3), slit_square(14), bow_tie(12)}) {
      const auto bent = other.mesh<double>();
      for (unsigned seed = 1; seed <= 2; ++seed) {
        const auto sources = random_sources(bent, 1, seed);
        const auto exact = solve(Serial{}, bent, sources, at(Accuracy::exact()));
        const auto team = solve(pieces(2, size), bent, sources, at(Accuracy::accurate()));
        const auto alone = solve(Serial{}, bent, sources, at(Accuracy::accurate()));
        const Parity p = parity(exact, team), q = parity(exact, alone);
        INFO("size " << size << ", seed " << seed << ": " << q.worst << " by one");
        CHECK(p.reached_by_one == 0);
        CHECK(p.worst < std::max(2 * q.worst, 1e-3));
      }
    }
  }
}

// All triangles at that edge have the point, the other piece's too: a window over the edge would
// light them through a single point.
TEMPLATE_TEST_CASE("pieces: windows from points on edges, inside pieces and between them", "",
                   float, double) {
  for (const Index n : {20u, 60u}) {
    const Surface s = jittered(n, n);
    const auto mesh = s.mesh<TestType>();
    // What a point inside a triangle comes to; single precision merges more.
    constexpr bool once = sizeof(TestType) < sizeof(double);
    constexpr double most = once ? 1e-3 : 1e-4, most_mean = once ? 8e-6 : 2e-7;
    std::mt19937 random(n);
    Workspace<TestType> workspace;
    DistanceField<TestType> serial, team;
    for (int i = 0; i < 30; ++i) {
      const Index f = below(random, s.faces.size());
      std::array<double, 3> b{};
      const std::size_t e = below(random, 3);
      b[e] = .05 + .9 * uniform(random);
      b[(e + 1) % 3] = 1 - b[e];
      Position at_source{};
      for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t j = 0; j < 2; ++j) at_source[j] += b[k] * s.positions[s.faces[f][k]][j];
      const auto off = [&](const DistanceField<TestType>& field) {
        Parity p;
        for (std::size_t v = 0; v < s.positions.size(); ++v) {
          const double exact =
              std::hypot(s.positions[v][0] - at_source[0], s.positions[v][1] - at_source[1]);
          const double miss = std::abs(static_cast<double>(field.distance[v]) - exact);
          p.worst = std::max(p.worst, miss / std::max(exact, 1. / n));
          p.mean += miss / std::max(exact, 1. / n) / static_cast<double>(s.positions.size());
        }
        return p;
      };
      const PointSource sources[] = {PointSource::in(f, b)};
      INFO(n << " by " << n << ", source " << i << " in triangle " << f);
      solve(Serial{}, mesh, sources, at(Accuracy::accurate()), workspace, serial);
      CHECK(off(serial).worst < most);
      CHECK(off(serial).mean < most_mean);
      for (const std::size_t size : {64u, 10u}) {
        solve(pieces(2, size), mesh, sources, at(Accuracy::accurate()), workspace, team);
        CHECK(off(team).worst < most);
        CHECK(off(team).mean < most_mean);
      }
      if (n == 60 || once) continue;
      solve(Serial{}, mesh, sources, at(Accuracy::exact()), workspace, serial);
      CHECK(off(serial).worst < 1e-12);
      solve(pieces(2, 64), mesh, sources, at(Accuracy::exact()), workspace, team);
      CHECK(team.distance == serial.distance);
    }
  }
}

// Too near to a corner for light over the edges there to be told from the corner's.
TEMPLATE_TEST_CASE("pieces: windows from points that all but lie at a vertex, by one thread too",
                   "", float, double) {
  constexpr bool once = sizeof(TestType) < sizeof(double);
  const Surface s = jittered(12, 5);
  const auto mesh = s.mesh<TestType>();
  std::mt19937 random(7);
  Workspace<TestType> workspace;
  DistanceField<TestType> field;
  for (const double off : {1e-3, 2.5e-5, 1e-6, 1e-8, 9e-10, 3e-11, 1e-13, 3e-16})
    for (int i = 0; i < 6; ++i) {
      const Index f = below(random, s.faces.size());
      const std::size_t c = below(random, 3);
      std::array<double, 3> b{};
      b[(c + 1) % 3] = i % 3 == 1 ? 0 : off;
      b[(c + 2) % 3] = i % 3 == 2 ? 0 : off;
      b[c] = 1 - b[(c + 1) % 3] - b[(c + 2) % 3];
      Position at_source{};
      for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t j = 0; j < 2; ++j) at_source[j] += b[k] * s.positions[s.faces[f][k]][j];
      const PointSource sources[] = {PointSource::in(f, b)};
      const auto worst = [&] {
        double most = 0;
        for (std::size_t v = 0; v < s.positions.size(); ++v) {
          const auto& p = s.positions[v];
          const double exact = std::hypot(p[0] - at_source[0], p[1] - at_source[1]);
          const double miss = std::abs(static_cast<double>(field.distance[v]) - exact);
          most = std::max(most, miss / std::max(exact, 1. / 12));
        }
        return most;
      };
      INFO(off << " off corner " << c << " of triangle " << f);
      solve(Serial{}, mesh, sources, at(Accuracy::accurate()), workspace, field);
      CHECK(worst() < 3e-4);
      solve(pieces(2, 64), mesh, sources, at(Accuracy::accurate()), workspace, field);
      CHECK(worst() < 3e-4);
      if (once) continue;
      solve(Serial{}, mesh, sources, at(Accuracy::exact()), workspace, field);
      // Below 1e-9 by way of the corner: there and back.
      const Position& corner = s.positions[s.faces[f][c]];
      const double way = std::hypot(corner[0] - at_source[0], corner[1] - at_source[1]);
      CHECK(worst() < (off < 1e-9 ? 12 * 2 * way : 0) + 1e-13);
      const auto serial = field.distance;
      solve(pieces(2, 64), mesh, sources, at(Accuracy::exact()), workspace, field);
      CHECK(field.distance == serial);
    }
}

TEST_CASE("pieces: windows from points on edges of several triangles, and whose a vertex is") {
  for (const Surface& s : {sheets(3, 10), sheets(5, 6), moebius(60, 8), cube(8)}) {
    const auto mesh = s.mesh<double>();
    std::mt19937 random(2);
    for (int i = 0; i < 6; ++i) {
      std::vector<PointSource> sources;
      for (int k = 0; k < 2; ++k) {
        // Of the edges that several triangles share the first ones; then any.
        const Index f = i < 3 ? static_cast<Index>(2 * i + k) : below(random, s.faces.size());
        std::array<double, 3> b{};
        const std::size_t e = below(random, 3);
        b[e] = .1 + .8 * uniform(random);
        b[(e + 1) % 3] = 1 - b[e];
        sources.push_back(PointSource::in(f, b));
      }
      sources[1].offset = .1;
      const auto exact = solve(Serial{}, mesh, sources, at(Accuracy::exact()));
      const auto serial = solve(Serial{}, mesh, sources, at(Accuracy::accurate()));
      const auto team = solve(pieces(2, 24), mesh, sources, at(Accuracy::accurate()));
      CHECK(solve(pieces(2, 24), mesh, sources, at(Accuracy::exact())).distance == exact.distance);
      const Parity p = parity(exact, team), q = parity(exact, serial);
      INFO("source " << i << ", worst of Serial " << q.worst);
      CHECK(p.reached_by_one == 0);
      CHECK(p.worst < std::max(2 * q.worst, 1e-3));
    }
  }
}

TEST_CASE("pieces: windows keep a radius", "[threads]") {
  const auto mesh = sphere(4).mesh<double>();
  const auto whole = solve(Serial{}, mesh, PointSource::at(5), at(Accuracy::exact()));
  for (const Accuracy accuracy : {Accuracy::exact(), Accuracy::accurate()}) {
    PropagateOptions options = at(accuracy);
    options.radius = *std::max_element(whole.distance.begin(), whole.distance.end()) / 3;
    const auto field = solve(pieces(4, 50), mesh, PointSource::at(5), options);
    std::size_t beyond = 0, wrong = 0;
    for (std::size_t v = 0; v < field.distance.size(); ++v) {
      beyond += std::isinf(field.distance[v]);
      const bool near = whole.distance[v] <= options.radius * (1 - 1e-3);
      const bool far = whole.distance[v] > options.radius * (1 + 1e-3);
      wrong += (near && std::isinf(field.distance[v])) || (far && !std::isinf(field.distance[v]));
      if (!std::isinf(field.distance[v]))
        wrong += std::abs(field.distance[v] - whole.distance[v]) > 1e-3 * whole.distance[v];
    }
    CHECK(beyond > field.distance.size() / 4);
    CHECK(wrong == 0);
    if (accuracy == Accuracy::exact())
      CHECK(field.distance == solve(Serial{}, mesh, PointSource::at(5), options).distance);
  }
}

}  // namespace plexway::testing::pieces_test
