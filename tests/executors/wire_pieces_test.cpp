#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <span>
#include <vector>

#include <plexway/common/mask.hpp>
#include <plexway/solve.hpp>

#include "complexes/test_wires.hpp"
#include "executors/parity.hpp"
#include "executors/piece_testing.hpp"

namespace plexway::testing::wire_pieces_test {

// Wireframes by pieces (OpenMP::piece): distances have Serial's bits, whatever the pieces, since
// each is the least sum along a path, added from its source on.

namespace {

struct Placed {
  std::vector<std::array<double, 3>> positions;
  std::vector<std::array<Index, 2>> edges;
  template <class Real>
  [[nodiscard]] Wireframe<Real> wireframe() const {
    return Wireframe<Real>(positions, edges);
  }
};

/// Points a unit apart, each pushed by up to `push`; of the struts between them the share `kept`.
Placed lattice(Index nx, Index ny, Index nz, double push, double kept, unsigned seed) {
  std::mt19937 random(seed);
  const auto pushed = [&](Index at) { return at + push * (2 * uniform(random) - 1); };
  Placed p;
  for (Index k = 0; k < nz; ++k)
    for (Index j = 0; j < ny; ++j)
      for (Index i = 0; i < nx; ++i) {
        const auto v = static_cast<Index>(p.positions.size());
        p.positions.push_back({pushed(i), pushed(j), pushed(k)});
        const auto strut = [&](bool there, Index to) {
          if (there && uniform(random) < kept) p.edges.push_back({to, v});
        };
        strut(i > 0, v - 1);
        strut(j > 0, v - nx);
        strut(k > 0, v - nx * ny);
      }
  return p;
}

/// The same by lengths alone, its vertices in any order.
Wires shuffled(const Placed& p, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<Index> place(p.positions.size());
  for (std::size_t v = 0; v < place.size(); ++v) place[v] = static_cast<Index>(v);
  std::shuffle(place.begin(), place.end(), random);
  Wires w{place.size(), {}, {}};
  for (const auto& [a, b] : p.edges) {
    const auto &x = p.positions[a], &y = p.positions[b];
    w.add(place[a], place[b], std::hypot(x[0] - y[0], x[1] - y[1], x[2] - y[2]));
  }
  return w;
}

Wires path(std::size_t vertices) {
  std::mt19937 random(7);
  Wires w{vertices, {}, {}};
  for (Index v = 0; v + 1 < vertices; ++v) w.add(v, v + 1, 0.5 + uniform(random));
  return w;
}

/// A hub that all others hang on, in pairs.
Wires star(std::size_t vertices) {
  Wires w{vertices, {}, {}};
  for (Index v = 1; v < vertices; ++v) {
    w.add(0, v, 1 + 0.01 * (v % 17));
    if (v % 2 == 0) w.add(v - 1, v, 0.3);
  }
  return w;
}

template <class Real>
std::vector<Wireframe<Real>> wireframes() {
  std::vector<Wireframe<Real>> all = {
      lattice(9, 8, 7, 0.3, 1, 1).template wireframe<Real>(),
      lattice(30, 25, 1, 0.3, 0.7, 2).template wireframe<Real>(),  // islands
      lattice(25, 25, 1, 0, 1, 3).template wireframe<Real>(),      // ties everywhere
      shuffled(lattice(8, 8, 8, 0.3, 0.8, 4), 5).template wireframe<Real>(),
      path(700).template wireframe<Real>(),
      star(500).template wireframe<Real>(),
  };
  for (unsigned seed = 1; seed <= 4; ++seed)
    all.push_back(
        random_wires(seed, 500, 400 + 300 * seed, 0.3 * seed * seed).template wireframe<Real>());
  return all;
}

template <class Real>
bool same_distances(const DistanceField<Real>& a, const DistanceField<Real>& b) {
  return a.distance.size() == b.distance.size() &&
         std::memcmp(a.distance.data(), b.distance.data(), a.distance.size() * sizeof(Real)) == 0;
}

/// Vertices, some of them begun at a distance, and a point of an edge.
template <class Real>
std::vector<PointSource> some_sources(const Wireframe<Real>& wires, std::size_t count,
                                      unsigned seed) {
  auto sources = random_sources(wires, count, seed);
  std::mt19937 random(seed);
  for (std::size_t i = 1; i < count; i += 2) sources[i].offset = uniform(random);
  if (count > 2) sources[2] = PointSource::in(below(random, wires.edge_count()), {0.3, 0.7});
  return sources;
}

}  // namespace

TEMPLATE_TEST_CASE("pieces: wireframes have Serial's distances with any number of threads",
                   "[threads]", float, double) {
  unsigned seed = 0;
  for (const Wireframe<TestType>& wires : wireframes<TestType>()) {
    Workspace<TestType> workspace;
    DistanceField<TestType> first, field;
    for (const std::size_t count : {1u, 5u})
      for (const Schedule schedule : {Schedule::dual_queue, Schedule::fifo}) {
        PropagateOptions options;
        options.schedule = schedule;
        const auto sources = some_sources(wires, count, ++seed);
        const auto alone = solve(Serial{}, wires, sources, options);
        solve(pieces(1, 32), wires, sources, options, workspace, first);
        INFO("seed " << seed);
        REQUIRE(first.statistics.supersteps > 0);
        CHECK(same_distances(alone, first));
        CHECK(first.statistics.reached_simplices == alone.statistics.reached_simplices);
        CHECK(first.complete);
        for (const int threads : {2, 3, 8}) {
          solve(pieces(threads, 32), wires, sources, options, workspace, field);
          INFO(threads << " threads");
          CHECK(same_bits(first, field));
        }
        // Whatever was solved before, and whatever the size.
        solve(pieces(2, 100), wires, sources, options, workspace, field);
        CHECK(same_distances(alone, field));
        solve(Serial{}, wires, sources, options, workspace, field);
        solve(pieces(2, 32), wires, sources, options, workspace, field);
        CHECK(same_bits(first, field));
        if (count == 1) continue;
        // A label may be another one's only where both are as near.
        const auto rows = solve_each(Serial{}, wires, std::span<const PointSource>(sources));
        std::size_t wrong = 0;
        for (std::size_t v = 0; v < first.distance.size(); ++v)
          if (std::isinf(first.distance[v]))
            wrong += first.label[v] != none;
          else
            wrong += first.label[v] >= count || rows.row(first.label[v])[v] != first.distance[v];
        CHECK(wrong == 0);
      }
  }
}

TEST_CASE("pieces: wireframes have the lengths of shortest paths") {
  for (unsigned seed = 1; seed <= 6; ++seed) {
    const Wires w = seed % 2 == 0 ? random_wires(seed, 600, 300 * seed, 0.5 * seed)
                                  : shuffled(lattice(9, 9, 6, 0.4, 0.6, seed), seed);
    const auto wires = w.wireframe<double>();
    const auto field = solve(pieces(2, 40), wires, PointSource::at(5));
    const auto exact = edge_distances(w, 5);
    double worst = 0;
    std::size_t unreached = 0;
    for (std::size_t v = 0; v < w.vertices; ++v)
      if (std::isinf(exact[v]))
        unreached += std::isinf(field.distance[v]) ? 0 : 1;
      else
        worst = std::max(worst, std::abs(field.distance[v] - exact[v]) / (exact[v] + 1e-9));
    INFO("seed " << seed);
    CHECK(worst < 1e-13);
    CHECK(unreached == 0);
  }
}

TEST_CASE("pieces: lengths of very different size end in a wireframe, nearest first") {
  for (unsigned seed = 1; seed <= 3; ++seed) {
    const auto wires = random_wires(seed, 2000, 9000, 5).wireframe<double>();
    const auto alone = solve(Serial{}, wires, PointSource::at(3));
    const auto field = solve(pieces(2, 200), wires, PointSource::at(3));
    CHECK(same_distances(alone, field));
  }
}

TEST_CASE("pieces: radius, budgets and cancelling in wireframes", "[threads]") {
  const auto wires = lattice(40, 30, 8, 0.3, 1, 1).wireframe<double>();
  PropagateOptions options;
  options.radius = 7.5;
  const auto sources = some_sources(wires, 4, 3);
  const auto alone = solve(Serial{}, wires, sources, options);
  const auto near = solve(pieces(4, 100), wires, sources, options);
  CHECK(same_distances(alone, near));
  CHECK(std::count(near.distance.begin(), near.distance.end(),
                   std::numeric_limits<double>::infinity()) > 100);
  for (std::size_t v = 0; v < near.distance.size(); ++v)
    if ((near.label[v] == none) != std::isinf(near.distance[v])) FAIL("label of vertex " << v);
  check_budget(wires, 100, {});
  check_reports(pieces(4, 2000), lattice(300, 300, 1, 0.3, 1, 1).wireframe<double>(), {});
}

TEST_CASE("pieces: a masked wireframe is solved behind its mask") {
  const Placed p = lattice(20, 20, 1, 0.2, 1, 2);
  Mask wall(p.positions.size(), p.edges.size());  // with one door
  for (std::size_t e = 0; e < p.edges.size(); ++e) {
    const auto& [a, b] = p.edges[e];
    if (a / 20 == 9 && b / 20 == 10 && a % 20 != 3) wall.close_simplex(static_cast<Index>(e));
  }
  const Wireframe<double> wires(p.positions, wall.open(p.edges));
  const auto alone = solve(Serial{}, wires, PointSource::at(19));
  const auto field = solve(pieces(3, 32), wires, PointSource::at(19));
  CHECK(same_distances(alone, field));
  CHECK(field.distance[399] > 40);
}

TEST_CASE("pieces: 200 solves of a wireframe on eight threads are one", "[threads]") {
  const auto wires = lattice(24, 24, 1, 0, 1, 1).wireframe<float>();
  check_200_solves(wires, some_sources(wires, 5, 2), 48, {});
}

TEST_CASE("pieces: by themselves wireframes go in pieces only where that pays") {
  const auto in_pieces = [](const auto& wires) {
    const auto field = solve(OpenMP{.threads = 2}, wires, PointSource::at(1));
    const auto alone = solve(Serial{}, wires, PointSource::at(1));
    CHECK(same_distances(alone, field));
    if (field.statistics.supersteps == 0) CHECK(same_bits(alone, field));
    return field.statistics.supersteps > 0;
  };
  const Placed plane = lattice(190, 190, 1, 0.3, 1, 1), block = lattice(34, 34, 34, 0.3, 1, 2);
  CHECK(in_pieces(plane.wireframe<float>()));
  CHECK(in_pieces(block.wireframe<float>()));
  CHECK(in_pieces(shuffled(plane, 3).wireframe<float>()));
  CHECK(!in_pieces(lattice(100, 100, 1, 0.3, 1, 1).wireframe<float>()));  // few
  CHECK(!in_pieces(path(40000).wireframe<float>()));                      // a front of one
  CHECK(!in_pieces(random_wires(1, 40000, 120000).wireframe<float>()));   // no neighbourhoods
  Wires unlike = shuffled(plane, 4);
  std::mt19937 random(5);
  for (double& length : unlike.lengths) length = std::pow(10, 3 * (2 * uniform(random) - 1));
  CHECK(!in_pieces(unlike.wireframe<float>()));  // lengths that differ a million times
}

}  // namespace plexway::testing::wire_pieces_test
