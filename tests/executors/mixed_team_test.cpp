#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/solve.hpp>

#include "data/mixed_pieces.hpp"
#include "executors/parity.hpp"
#include "executors/piece_testing.hpp"
#include "labels/mixed_domains.hpp"

namespace plexway::testing::mixed_team_test {

// Mixed domains by a team: one thread solves them, or all of them what is one surface.

namespace {

constexpr int team_sizes[] = {1, 2, 3, 8};

/// Pieces of one precision, welded where they are close.
template <class Real>
struct Built {
  template <class Shape>
  void add(const Shape& shape, double speed = 1) {
    auto timed = shape.positions;
    for (samples::Position& p : timed)
      for (double& x : p) x /= speed;
    if constexpr (requires { shape.tets; })
      complex.add(TetMesh<Real>(timed, shape.tets), shape.positions);
    else if constexpr (requires { shape.faces; })
      complex.add(TriangleMesh<Real>(timed, shape.faces), shape.positions);
    else
      complex.add(Wireframe<Real>(timed, shape.edges), shape.positions);
    const auto pieces = complex.pieces();
    const auto last = pieces.back();
    const std::vector<typename MixedComplex<Real>::Piece> others(pieces.begin(), pieces.end() - 1);
    for (const auto& other : others) complex.weld(other, last, {.tolerance = 1e-9});
  }
  MixedComplex<Real> complex;
};

template <class Real>
struct Named {
  std::string name;
  MixedComplex<Real> domain;
};

/// Solids in layers, a block with a skin and wires, sheets and wires that meet in lines.
template <class Real>
std::vector<Named<Real>> domains() {
  using namespace samples;
  std::vector<Named<Real>> all;
  Built<Real> layers, wired, rooms, blocks;
  const double speeds[] = {1, 2, .7, 1.4};
  const auto in_layers =
      blocks_of({{.25, .5, .75}, {std::begin(speeds), std::end(speeds)}}, 12, .15, 3);
  for (std::size_t k = 0; k < in_layers.size(); ++k) layers.add(in_layers[k], speeds[k]);
  all.push_back({"layers", layers.complex});
  wired.add(block({0, 0, 0}, {1, 1, 1}, 8));
  wired.add(sheet({0, 0, 1}, {1, 0, 0}, {0, 1, 0}, 8, 8), 2);
  for (int i = 0; i < 9; i += 2)
    for (int j = 1; j < 9; j += 3) {
      std::vector<Position> line;
      for (int k = 0; k < 9; ++k) line.push_back({i / 8., j / 8., k / 8.});
      wired.add(rod(line), 1 + .5 * (i + j));
    }
  // Large enough that threads share its strings.
  wired.add(block({1, 0, 0}, {2, 1, 1}, 8));
  all.push_back({"wired", wired.complex});
  rooms.add(sheet({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 12, 12));
  rooms.add(sheet({1, 0, 0}, {0, 0, 1}, {0, 1, 0}, 12, 12), 2);
  rooms.add(rod({{0, 0, 0}, {-1, 0, 0}, {-1, 0, 1}, {0, 0, 1}, {1, 0, 1}}), 1.5);
  rooms.add(sheet({0, 0, 1}, {1, 0, 0}, {0, 1, 0}, 12, 12));
  all.push_back({"rooms", rooms.complex});
  blocks.add(block({0, 0, 0}, {1, 1, 1}, 6));
  blocks.add(block({1, 0, 0}, {2, 1, 1}, 6));
  blocks.add(block({1, 1, 0}, {2, 2, 1}, 6), 2);
  blocks.add(rod({{0, 0, 1}, {1, 0, 2}, {2, 2, 1}}), 3);
  all.push_back({"blocks", blocks.complex});
  return all;
}

template <class Domain>
std::vector<PointSource> sources_in(const Domain& domain, std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<PointSource> sources;
  for (std::size_t i = 0; i < count; ++i) {
    sources.push_back(PointSource::at(static_cast<Index>(random() % domain.vertex_count())));
    sources.back().offset = .01 * static_cast<double>(i);
  }
  return sources;
}

}  // namespace

TEMPLATE_TEST_CASE("mixed domains have Serial's bits with any number of threads", "[threads]",
                   float, double) {
  if (!openmp_built()) return;
  unsigned seed = 0;
  for (const auto& [name, domain] : domains<TestType>()) {
    Workspace<TestType> workspace;
    DistanceField<TestType> alone, field;
    for (const std::size_t count : {1u, 4u})
      for (const bool bounded : {false, true}) {
        PropagateOptions options;
        if (bounded) options.radius = .6;
        const auto sources = sources_in(domain, count, ++seed);
        solve(Serial{}, domain, sources, options, workspace, alone);
        for (const int threads : team_sizes) {
          solve(OpenMP{.threads = threads}, domain, sources, options, workspace, field);
          INFO(name << ", seed " << seed << ", threads " << threads);
          CHECK(same_bits(alone, field));
        }
      }
  }
}

TEST_CASE("a team refracts paths in layers, and goes over welds", "[threads]") {
  if (!openmp_built()) return;
  using namespace mixed_domains;
  for (const int threads : {2, 8}) {
    const OpenMP team{.threads = threads};
    const Layers layers = {{.5}, {1, 2}};
    Welded two(3);
    const auto blocks = blocks_of(layers, 8, .15, 3);
    two.weld(two.add(blocks[0], 1), two.add(blocks[1], 2));
    for (const Index source : {Index{200}, Index{50}}) {
      const Position from = two.positions[source];
      const auto e = errors(
          two, source, [&](Index v) { return layers.time(from, two.positions[v]); }, team);
      CAPTURE(threads, source, e.mean, e.worst, e.low);
      CHECK(e.mean < 1e-5);
      CHECK(e.worst < 3e-3);
      CHECK(e.low > -1e-9);
    }
    // Over a sheet that sticks out of a block, along a wire from its far edge.
    Welded flag(5);
    const auto solid = flag.add(block({0, 0, 0}, {1, 1, 1}, 8));
    const auto plate = flag.add(sheet({-1, 0, 1}, {1, 0, 0}, {0, 1, 0}, 8, 8));
    const auto wire = flag.add(rod({{-1, .5, 1}, {-2, .5, 1}, {-3, .5, 1}}));
    flag.weld(solid, plate);
    flag.weld(plate, wire);
    const auto e = errors(
        flag, wire.vertex(2),
        [&](Index v) {
          const Position& p = flag.positions[v];
          if (Welded::of(wire, v)) return p[0] + 3;
          if (Welded::of(plate, v)) return 2 + std::hypot(p[0] + 1, p[1] - .5);
          // Unfolded about the edge between them; straight on where the way is on the face.
          return 2 + std::hypot(1 + std::hypot(p[0], p[2] - 1), p[1] - .5);
        },
        team);
    CAPTURE(threads, e.mean, e.worst, e.low);
    CHECK(e.worst < 1e-9);
  }
}

TEST_CASE("mixed domains by a team: budgets, progress, and an end in between", "[threads]") {
  if (!openmp_built()) return;
  for (const auto& [name, domain] : domains<double>()) {
    const PointSource source[] = {PointSource::at(0)};
    Workspace<double> workspace;
    DistanceField<double> whole, field;
    solve(OpenMP{.threads = 3}, domain, source, {}, workspace, whole);
    INFO(name);
    for (const std::size_t most : {std::size_t{0}, std::size_t{1}, whole.statistics.expansions / 2,
                                   whole.statistics.expansions / 4}) {
      PropagateOptions options;
      options.max_expansions = most;
      const auto alone = solve(Serial{}, domain, source, options);
      CHECK(!alone.complete);
      CHECK(alone.statistics.expansions == most);
      for (const int threads : team_sizes) {
        solve(OpenMP{.threads = threads}, domain, source, options, workspace, field);
        CHECK(same_bits(alone, field));
      }
    }
    // Each budget ends where there is nothing left to do.
    PropagateOptions enough;
    enough.max_expansions = 4 * whole.statistics.expansions;
    CHECK(solve(OpenMP{.threads = 3}, domain, source, enough).complete);
  }
  // Two blocks at once, as the wire between them is fast.
  Built<double> large;
  large.add(samples::block({0, 0, 0}, {1, 1, 1}, 12));
  large.add(samples::block({2, 0, 0}, {3, 1, 1}, 12));
  large.add(samples::rod({{0, 0, 0}, {2, 0, 0}}), 50);
  const PointSource source[] = {PointSource::at(0)};
  const auto caller = std::this_thread::get_id();
  Workspace<double> workspace;
  DistanceField<double> whole, field;
  const OpenMP team{.threads = 4};
  solve(team, large.complex, source, {}, workspace, whole);
  std::size_t told = 0, most = 0;
  bool elsewhere = false, back = false;
  PropagateOptions options;
  options.progress = [&](const Progress& progress) {
    ++told;
    elsewhere = elsewhere || std::this_thread::get_id() != caller;
    back = back || progress.expansions < most;
    most = progress.expansions;
    return true;
  };
  solve(team, large.complex, source, options, workspace, field);
  CHECK(told > 2);
  CHECK(!elsewhere);
  CHECK(!back);
  CHECK(most <= field.statistics.expansions);
  CHECK(same_bits(whole, field));
  options.progress = [](const Progress&) { return false; };
  CHECK_THROWS_AS(solve(team, large.complex, source, options, workspace, field), Cancelled);
  solve(team, large.complex, source, {}, workspace, field);
  CHECK(same_bits(whole, field));
}

TEST_CASE("a mixed domain that joins to one complex goes as that", "[threads]") {
  if (!openmp_built()) return;
  using namespace mixed_domains;
  Welded block_of_two(0);
  const auto a = block_of_two.add(block({0, 0, 0}, {1, 1, 1}, 6));
  block_of_two.weld(a, block_of_two.add(block({1, 0, 0}, {2, 1, 1}, 6)));
  Welded fold(0);
  const auto b = fold.add(sheet({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 16, 16));
  fold.weld(b, fold.add(sheet({1, 0, 0}, {0, 0, 1}, {0, 1, 0}, 16, 16)));
  for (const auto* domain : {&block_of_two, &fold}) {
    const Index source = 40;
    const Position from = domain->positions[source];
    const auto first = solve(pieces(1, 60), domain->complex, PointSource::at(source));
    for (const int threads : team_sizes)
      CHECK(same_bits(first, solve(pieces(threads, 60), domain->complex, PointSource::at(source))));
    double worst = 0;
    for (Index v = 0; v < domain->positions.size(); ++v) {
      const Position& p = domain->positions[v];
      const double exact = domain == &fold && p[2] > 0
                               ? std::hypot(1 - from[0] + p[2], p[1] - from[1])
                               : samples::distance(from, p);
      worst = std::max(worst, std::abs(first.distance[v] - exact));
    }
    CHECK(worst < 1e-9);
  }
}

}  // namespace plexway::testing::mixed_team_test
