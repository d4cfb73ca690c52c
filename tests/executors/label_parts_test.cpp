#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <map>
#include <random>
#include <vector>

#include <plexway/solve.hpp>

#include "complexes/jittered.hpp"
#include "executors/check_scene.hpp"
#include "executors/parity.hpp"
#include "executors/parts_testing.hpp"
#include "executors/piece_testing.hpp"
#include "with_accuracy.hpp"

namespace plexway::testing::label_parts_test {

// Surfaces in parts by labels (`fast`); windows are in surface_parts_test.cpp.

namespace {

// Of pieces of a triangle or two, where each vertex is at a cut, and larger ones.
constexpr Scheduler schedulers[] = {{1, 1, 25},  {2, 1, 25},  {3, 2, 25}, {4, 1, 25},
                                    {1, 3, 120}, {3, 1, 120}, {1, 1, 3},  {3, 2, 3}};

template <class Real, class Known>
double worst_of(const Surface& s, const std::vector<Real>& found, const Known& known) {
  double worst = 0;
  for (std::size_t v = 0; v < found.size(); ++v)
    worst = std::max(worst, std::abs(static_cast<double>(found[v]) - known(s.positions[v])));
  return worst;
}

}  // namespace

TEMPLATE_TEST_CASE("label parts: the same bits whatever the processes and threads", "[threads]",
                   float, double) {
  unsigned seed = 0;
  for (const Surface& s : surfaces())
    for (const Visibility visibility : visibilities)
      for (const std::size_t count : {1u, 5u}) {
        PropagateOptions options = by_labels();
        options.visibility = visibility;
        if (visibility == Visibility::saddles && count == 5) options.schedule = Schedule::fifo;
        const auto sources = mixed_sources(s, count, ++seed);
        const auto whole = solve(Serial{}, s.mesh<TestType>(), sources, options);
        std::map<std::size_t, Joined<TestType>> first;  // of each size of pieces
        for (const Scheduler& scheduler : schedulers) {
          if (visibility != Visibility::saddles && scheduler.ranks > 2) continue;
          const auto field = solve_in_parts<TestType>(s, scheduler, sources, options);
          INFO("surface " << seed << ", visibility " << static_cast<int>(visibility) << ", ranks "
                          << scheduler.ranks << ", pieces of " << scheduler.piece);
          CHECK((field.sound() && field.complete));
          CHECK(field.accuracy == Accuracy::fast());
          CHECK(field.statistics.reached_simplices == whole.statistics.reached_simplices);
          CHECK(parity(whole, field).reached_by_one == 0);
          CHECK(same_bits(field, first.try_emplace(scheduler.piece, field).first->second));
        }
      }
}

// Where the step is exact the order of work cannot matter, nor the cut.
TEMPLATE_TEST_CASE("label parts: a plane, and around corners", "", float, double) {
  const double rounding = sizeof(TestType) == 4 ? 4e-6 : 1e-12;
  std::mt19937 random(5);
  const Surface plane = jittered(14, 2);
  for (int i = 0; i < 6; ++i) {
    // At vertices, inside triangles and on edges, which may be a cut.
    const Index f = below(random, plane.faces.size());
    const double b = .1 + .8 * uniform(random), c = i < 3 ? 0 : (1 - b) * uniform(random);
    const PointSource source =
        i == 0 ? PointSource::at(plane.faces[f][0]) : PointSource::in(f, {b, c, 1 - b - c});
    Position p{};
    const double share[] = {i == 0 ? 1 : b, i == 0 ? 0 : c, i == 0 ? 0 : 1 - b - c};
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t d = 0; d < 2; ++d) p[d] += share[k] * plane.positions[plane.faces[f][k]][d];
    const auto known = [&](const Position& q) { return std::hypot(q[0] - p[0], q[1] - p[1]); };
    CHECK(worst_of(plane, solve(Serial{}, plane.mesh<TestType>(), source, by_labels()).distance,
                   known) < rounding);
    for (const std::size_t piece : {2u, 9u, 60u})
      for (const std::size_t ranks : {1u, 3u}) {
        CAPTURE(i, piece, ranks);
        const auto field =
            solve_in_parts<TestType>(plane, {ranks, 1, piece}, {source}, by_labels());
        CHECK(worst_of(plane, field.distance, known) < rounding);
        CHECK(field.sound());
      }
  }
  // Around corners, and over vertices where sheets only touch.
  for (const Surface& s : {random_polygon(5, 400, 300, 3), bow_tie(12)}) {
    const auto mesh = s.mesh<TestType>();
    for (unsigned seed = 1; seed <= 2; ++seed) {
      const auto sources = random_sources(mesh, 1, seed);
      const auto whole = solve(Serial{}, mesh, sources, by_labels());
      for (const std::size_t piece : {2u, 9u, 60u}) {
        const Parity p =
            parity(whole, solve_in_parts<TestType>(s, {2, 1, piece}, sources, by_labels()));
        CAPTURE(seed, piece, p.worst);
        CHECK(p.reached_by_one == 0);
        CHECK(p.worst < 4 * rounding);
      }
    }
  }
}

// Behind the tip of a slit labels hear of it from their neighbours, over a cut a superstep late: in
// some cuts, of the whole in pieces too, a few are lit that should not be.
TEST_CASE("label parts: around the tip of a slit") {
  const Surface s = slit_square(14);
  const auto mesh = s.mesh<double>();
  double worst = 0;
  std::size_t solves = 0, off = 0;
  for (unsigned seed = 1; seed <= 60; ++seed) {
    const auto sources = random_sources(mesh, 1, seed);
    const auto exact = solve(Serial{}, mesh, sources, at(Accuracy::exact()));
    for (const std::size_t piece : {9u, 20u, 40u, 80u}) {
      const auto field = solve_in_parts<double>(s, {1, 1, piece}, sources, by_labels());
      const double here = parity(exact, field).worst;
      worst = std::max(worst, here);
      off += here > 1e-3;
      ++solves;
    }
  }
  CAPTURE(worst, off);
  CHECK(off < solves / 20);
  CHECK(worst < .1);
}

TEST_CASE("label parts: as accurate on curved surfaces as the whole in pieces") {
  // One order is as good as another, and at some vertices chance: of several cuts.
  constexpr std::size_t cuts[] = {1000, 2048, 4096};
  double serial = 0, in_parts = 0, in_pieces = 0, worst_in_pieces = 0, worst = 0;
  each_known_surface(60'000, [&](const KnownSurface& known) {
    const auto error = [&](const DistanceField<float>& field, double& most) {
      const ExactError e = error_of(field.distance, known.exact);
      if (!known.needles()) most = std::max(most, e.worst);
      return e.mean;
    };
    double unused = 0;
    serial += error(solve(Serial{}, known.mesh, known.source, by_labels()), unused);
    for (const std::size_t piece : cuts) {
      constexpr double share = 1. / std::size(cuts);
      in_parts += share * error(solve_in_parts<float>(known.surface, {2, 1, piece}, {known.source},
                                                      by_labels()),
                                worst);
      in_pieces += share * error(solve(pieces(1, piece), known.mesh, known.source, by_labels()),
                                 worst_in_pieces);
    }
  });
  REQUIRE(serial > 0);
  INFO("mean " << in_parts / serial << " of Serial's, of the whole in pieces " << in_pieces / serial
               << "; worst " << worst << " and " << worst_in_pieces);
  CHECK(in_parts < 1.05 * in_pieces);
  CHECK(worst < 1.5 * worst_in_pieces);
}

TEST_CASE("label parts: a radius and a budget are kept") {
  check_radius_in_parts(by_labels(), 3e-2);
  check_budget_in_parts(by_labels());
}

TEST_CASE("label parts: every vertex a source, the same bits every time", "[threads]") {
  const Surface s = sphere(3);
  std::vector<PointSource> sources;
  for (Index v = 0; v < s.positions.size(); ++v) sources.push_back(PointSource::at(v));
  const auto all = solve_in_parts<float>(s, {3, 1, 30}, sources, by_labels());
  CHECK(all.sound());
  for (Index v = 0; v < s.positions.size(); ++v) {
    CHECK(all.distance[v] == 0);
    CHECK(all.label[v] == v);
  }
  const std::vector<PointSource> few = {PointSource::at(20), PointSource::at(150)};
  const auto once = solve_in_parts<float>(s, {1, 1, 30}, few, by_labels());
  for (const Scheduler& scheduler : {Scheduler{2, 1, 30}, Scheduler{2, 2, 30}})
    CHECK(same_bits(once, solve_in_parts<float>(s, scheduler, few, by_labels(), 100)));
}

// Too many windows wait there: who did not ask for them by name gets labels.
TEST_CASE("label parts: a tube that is long and thin, as the whole is solved") {
  constexpr Index sides = 3, rows = 30'000;
  const Surface s = prism(sides, rows, 300);
  const PointSource source = PointSource::at(1);
  // Unrolled, as far as labels are exact.
  const auto worst_of_tube = [&](const DistanceField<float>& field) {
    double worst = 0;
    for (Index v = 0; v < s.positions.size(); ++v) {
      const double known = std::hypot(v % sides == 1 ? 0 : 1, s.positions[v][2]);
      if (v != 1)
        worst = std::max(worst, std::abs(static_cast<double>(field.distance[v]) / known - 1));
    }
    return worst;
  };
  const auto whole = solve(Serial{}, s.mesh<float>(), source);
  REQUIRE(whole.statistics.windows_gave_up > 0);
  const double serial = worst_of_tube(whole);
  std::vector<Joined<float>> found;
  for (const std::size_t ranks : {1u, 3u}) {
    found.push_back(solve_in_parts<float>(s, {ranks, 1, 16384}, {source}));
    const auto& field = found.back();
    CHECK(field.statistics.windows_gave_up > 0);
    CHECK(field.accuracy == Accuracy::fast());
    CHECK(field.sound());
    CHECK(worst_of_tube(field) < 1.5 * serial);
  }
  CHECK(same_bits(found[0], found[1]));
}

}  // namespace plexway::testing::label_parts_test
