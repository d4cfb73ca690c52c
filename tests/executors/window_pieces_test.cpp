#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

#include <plexway/solve.hpp>

#include "complexes/jittered.hpp"
#include "executors/parity.hpp"
#include "executors/piece_testing.hpp"
#include "with_accuracy.hpp"

namespace plexway::testing::window_pieces_test {

// Windows by pieces (OpenMP::piece): the bits of Serial where they are exact, as accurate where
// they are merged, and the same with any number of threads.

namespace {

/// Sources at vertices, inside triangles and with offsets.
template <class Real>
std::vector<PointSource> mixed_sources(const TriangleMesh<Real>& mesh, std::size_t count,
                                       unsigned seed) {
  std::vector<PointSource> sources = random_sources(mesh, count, seed);
  if (count == 1) return sources;
  std::mt19937 random(seed);
  sources[1] = PointSource::in(below(random, mesh.face_count()), {.2, .3, .5});
  sources.back().offset = 0.01;
  return sources;
}

}  // namespace

TEST_CASE("pieces: exact windows have the bits of Serial", "[threads]") {
  unsigned seed = 0;
  for (const Surface& s : surfaces()) {
    const auto mesh = s.mesh<double>();
    Workspace<double> alone, workspace;
    DistanceField<double> field, by_pieces;
    for (const std::size_t count : {1u, 5u}) {
      const auto sources = mixed_sources(mesh, count, ++seed);
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
      const auto sources = mixed_sources(mesh, count, ++seed);
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

TEST_CASE("pieces: 200 solves by windows on eight threads are one", "[threads]") {
  const auto mesh = sphere(4).mesh<float>();
  check_200_solves(mesh, random_sources(mesh, 5, 1), 40, {});
}

TEMPLATE_TEST_CASE("pieces: a single one has the bits of Serial by windows", "", float, double) {
  for (const Surface& s : surfaces()) {
    const auto mesh = s.mesh<TestType>();
    const auto sources = random_sources(mesh, 3, 7);
    CHECK(same_bits(solve(Serial{}, mesh, sources),
                    solve(pieces(2, mesh.face_count()), mesh, sources)));
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

TEST_CASE("pieces: merged windows are as accurate as Serial's on curved surfaces") {
  double serial = 0, by_pieces = 0, worst_serial = 0, worst = 0;
  Workspace<float> workspace;
  DistanceField<float> field;
  each_known_surface(60'000, [&](const KnownSurface& known) {
    const PointSource source[] = {known.source};
    const auto error = [&](double& most) {
      CHECK(field.accuracy == Accuracy::accurate());
      const ExactError e = error_of(field.distance, known.exact);
      most = std::max(most, e.worst);
      return e.mean;
    };
    solve(Serial{}, known.mesh, source, {}, workspace, field);
    serial += error(worst_serial);
    solve(pieces(2, 2048), known.mesh, source, {}, workspace, field);
    by_pieces += error(worst);
  });
  REQUIRE(serial > 0);
  INFO("worst " << worst << ", Serial's " << worst_serial);
  CHECK(by_pieces < 1.05 * serial);
  CHECK(worst <= 5e-3);  // as much as is asked of Serial's; which vertex is worst is chance
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

TEST_CASE("pieces: a budget of windows is kept to the last one", "[threads]") {
  check_budget(grid(60, 60).mesh<float>(), 200, {});
}

TEST_CASE("pieces: windows report to the calling thread, and can be cancelled", "[threads]") {
  check_reports(pieces(4, 2000), grid(200, 200).mesh<float>(), {});
}

TEST_CASE("pieces: every vertex a source of windows, and offsets far apart", "[threads]") {
  check_every_vertex_a_source({}, 1e-4);
}

}  // namespace plexway::testing::window_pieces_test
