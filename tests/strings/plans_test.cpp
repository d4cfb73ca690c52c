#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <random>
#include <vector>

#include <plexway/simplicial/kuhn_grid.hpp>
#include <plexway/solid/tet_mesh.hpp>

#include "data/cell_lattice.hpp"
#include "data/cell_plans.hpp"
#include "data/crack_plans.hpp"
#include "strings/solver.hpp"

namespace plexway::testing::plans_test {

// Strings in prisms over random plans, against visibility graphs: exact to rounding.

namespace {

using Random = std::mt19937;
using samples::CellPlan;
constexpr double infinity = std::numeric_limits<double>::infinity();

double share(Random& random) { return static_cast<double>(random()) / 4294967296.; }

template <class Real>
std::vector<double> distances(const TetMesh<Real>& mesh, const std::vector<Index>& sources,
                              const std::vector<double>& offsets = {}) {
  const detail::strings::MediaSpace space(
      std::make_shared<const detail::strings::SolidSpace>(mesh));
  detail::strings::Solver solver(space);
  std::vector<detail::strings::Source> from;
  for (std::size_t n = 0; n < sources.size(); ++n) {
    detail::strings::Source source;
    source.point = mesh.inside_vertex(sources[n]);
    source.at = space.point(source.point);
    source.offset = n < offsets.size() ? offsets[n] / mesh.unit() : 0;
    from.push_back(source);
  }
  REQUIRE(solver.solve(from, {}));
  std::vector<double> found;
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    found.push_back(solver.distance(mesh.inside_vertex(v)) * mesh.unit());
  return found;
}

/// The same through a space of one medium.
std::vector<double> through_media(const CellPlan& plan, Index source) {
  detail::strings::Parts parts;
  for (const auto& p : plan.places) parts.points.push_back({p[0], p[1], p[2]});
  parts.tets = plan.tets;
  parts.slow_tets.assign(plan.tets.size(), 1);
  const detail::strings::MediaSpace space(parts);
  detail::strings::Solver solver(space);
  detail::strings::Source from;
  from.point = source;
  from.at = space.point(source);
  REQUIRE(solver.solve({&from, 1}));
  std::vector<double> found;
  for (Index p = 0; p < plan.places.size(); ++p) found.push_back(solver.distance(p) * space.unit());
  return found;
}

/// Turned and moved, so that coordinates are no round numbers.
std::vector<std::array<double, 3>> moved(std::vector<std::array<double, 3>> places) {
  const auto turn = [](double& a, double& b, double angle) {
    const double along = std::cos(angle) * a - std::sin(angle) * b;
    b = std::sin(angle) * a + std::cos(angle) * b;
    a = along;
  };
  for (auto& [x, y, z] : places) {
    turn(x, y, .7);
    turn(y, z, .4);
    x += 100, y += 100, z += 100;
  }
  return places;
}

/// The worst, too long and too short.
std::array<double, 2> compare(const std::vector<double>& found, const std::vector<double>& truth) {
  std::array<double, 2> worst = {0, 0};
  for (std::size_t v = 0; v < truth.size(); ++v) {
    if (!(truth[v] < infinity)) {
      CHECK(found[v] == infinity);
      continue;
    }
    REQUIRE(found[v] < infinity);
    const double off = truth[v] > 0 ? found[v] / truth[v] - 1 : found[v];
    worst = {std::max(worst[0], off), std::max(worst[1], -off)};
  }
  return worst;
}

TEST_CASE("strings over plans of cells are exact") {
  for (const double left_out : {.05, .2, .28, .35}) {
    Random random(1);
    for (int plan = 0; plan < 40; ++plan) {
      const CellPlan cells(random, left_out);
      const auto source = static_cast<Index>(random() % cells.places.size());
      const TetMesh<double> mesh(cells.places, cells.tets);
      const std::vector<double> truth = cells.truth(source);
      for (const bool media : {false, true}) {
        const auto [more, less] =
            compare(media ? through_media(cells, source) : distances(mesh, {source}), truth);
        CAPTURE(left_out, plan, media);
        CHECK(more < 1e-12);
        CHECK(less < 1e-12);
      }
      // Corners in one line do not stand in each other's way, whatever precision fields have.
      const TetMesh<float> turned(moved(cells.places), cells.tets);
      const auto [more, less] = compare(distances(turned, {source}), truth);
      CAPTURE(left_out, plan);
      CHECK(more < 1e-12);
      CHECK(less < 1e-12);
    }
  }
}

TEST_CASE("strings from several sources with offsets are the least of single fields") {
  for (const std::size_t count : {2u, 5u, 20u, 100u}) {
    Random random(3);
    for (int plan = 0; plan < 25; ++plan) {
      const CellPlan cells(random, .28);
      std::vector<Index> sources;
      std::vector<double> offsets, truth(cells.places.size(), infinity);
      for (std::size_t n = 0; n < count; ++n) {
        sources.push_back(static_cast<Index>(random() % cells.places.size()));
        offsets.push_back(random() % 2 == 0 ? 0 : 2 * share(random));
        const auto one = cells.truth(sources.back());
        for (std::size_t v = 0; v < truth.size(); ++v)
          truth[v] = std::min(truth[v], offsets.back() + one[v]);
      }
      const TetMesh<double> mesh(cells.places, cells.tets);
      const auto [more, less] = compare(distances(mesh, sources, offsets), truth);
      CAPTURE(count, plan);
      CHECK(more < 1e-12);
      CHECK(less < 1e-12);
    }
  }
}

TEST_CASE("all vertices of a side are sources of a cube whose vertices are moved") {
  constexpr std::size_t cells = 8;
  const KuhnGrid<3> grid({cells, cells, cells}, {1., 1., 1.});
  Random random(7);
  for (const double thin : {1., .5}) {
    std::vector<std::array<double, 3>> places;
    std::vector<Index> side;
    for (Index v = 0; v < grid.vertex_count(); ++v) {
      places.push_back(grid.position(v));
      for (double& x : places.back())
        if (x > .5 && x < cells - .5) x += .5 * share(random) - .25;
      if (places.back()[2] == 0) side.push_back(v);
      places.back()[2] *= thin;
    }
    const TetMesh<double> mesh(places, grid.simplices());
    const auto found = distances(mesh, side);
    for (std::size_t v = 0; v < places.size(); ++v) {
      double truth = infinity;
      for (const Index s : side) {
        const auto &a = places[v], &b = places[s];
        truth = std::min(truth, std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]));
      }
      CAPTURE(thin, v);
      CHECK(std::abs(found[v] - truth) < 1e-12);
    }
  }
}

// Cracks that join, or end at corners of holes: along one face, around the end, and back along the
// other one.
struct CrackProblem {
  std::vector<samples::CrackPlan::Crack> cracks;
  std::vector<samples::CrackPlan::Hole> holes = {};

  void check(double jitter, std::size_t sources) const {
    Random random(5);
    const samples::CrackPlan plan(
        8, cracks, jitter, [&] { return share(random); }, holes);
    const auto solid = plan.solid(.3);
    const TetMesh<double> mesh(solid.places, solid.tets);
    const std::size_t floor = plan.places().size();
    for (std::size_t n = 0; n < sources; ++n) {
      const auto source = static_cast<Index>(sources < floor ? random() % floor : n % floor);
      if (plan.on_crack(source)) continue;
      const auto flat = plan.distances(source);
      std::vector<double> truth;
      for (std::size_t v = 0; v < solid.places.size(); ++v)
        truth.push_back(std::hypot(flat[v % floor], solid.places[v][2]));
      const auto [more, less] = compare(distances(mesh, {source}), truth);
      CAPTURE(cracks.size(), holes.size(), jitter, source);
      CHECK(more < 1e-12);
      CHECK(less < 2e-7);  // the truth goes around ends at 1e-8
    }
  }
};

TEST_CASE("strings around cracks that join are exact") {
  const std::vector<CrackProblem> all = {
      {{{{2, 3}, {6, 3}}}},                                      // one
      {{{{2, 3}, {6, 3}}, {{6, 3}, {6, 6}}}},                    // an L
      {{{{4, 4}, {6, 4}}, {{4, 4}, {4, 7}}}},                    // another one
      {{{{2, 2}, {6, 2}}, {{4, 2}, {4, 6}}}},                    // a T
      {{{{2, 3}, {6, 3}}, {{2, 3}, {2, 6}}, {{6, 3}, {6, 6}}}},  // a U
      {{{{4, 5}, {7, 5}}}, {{{2, 2}, {4, 5}}}},
      {{{{4, 1}, {7, 1}}, {{4, 4}, {4, 6}}}, {{{1, 1}, {4, 4}}}},
      {{{{5, 5}, {8, 5}}, {{4, 7}, {2, 7}}}, {{{2, 1}, {5, 3}}, {{4, 5}, {5, 7}}}},
      {{{{4, 5}, {1, 5}}, {{6, 5}, {8, 5}}}, {{{1, 2}, {2, 4}}, {{4, 3}, {6, 5}}}},
  };
  for (const CrackProblem& problem : all)
    for (const double jitter : {0., .08, .16, .24}) problem.check(jitter, 12);
}

// From some sources a string leaves one end in the plane of the crack, on the far side of it.
TEST_CASE("strings around a T of cracks that ends on the rim are exact") {
  const std::vector<CrackProblem> to_the_rim = {{{{{2, 3}, {6, 3}}, {{4, 3}, {4, 0}}}},
                                                {{{{2, 3}, {2, 7}}, {{2, 5}, {0, 5}}}}};
  for (const CrackProblem& problem : to_the_rim)
    for (const double jitter : {0., .08, .16}) problem.check(jitter, 1000);
}

TEST_CASE("strings from one side of a crack are as long as those back to it") {
  Random random(7);
  const samples::CrackPlan plan(8, {{{2, 3}, {6, 3}}, {{4, 3}, {4, 6}}}, .1,
                                [&] { return share(random); });
  const auto solid = plan.solid(.3);
  const TetMesh<double> mesh(solid.places, solid.tets);
  std::vector<Index> on;
  for (Index v = 0; v < plan.places().size(); ++v)
    if (plan.on_crack(v)) on.push_back(v);
  REQUIRE(on.size() > 10);
  std::vector<std::vector<double>> from;
  for (const Index v : on) from.push_back(distances(mesh, {v}));
  for (std::size_t i = 0; i < on.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      CAPTURE(on[i], on[j]);
      CHECK(from[i][on[j]] == Approx(from[j][on[i]]).epsilon(1e-12).margin(1e-13));
    }
}

// Strings in lattices of cubes, some left out at random, against the same ones with each cube cut
// in eight: corners where rows of edges meet, and edges and vertices where cubes only touch.

std::vector<double> distances_from(const TetMesh<double>& mesh, Index from) {
  const detail::strings::MediaSpace space(
      std::make_shared<const detail::strings::SolidSpace>(mesh));
  detail::strings::Solver solver(space);
  detail::strings::Source source;
  source.point = mesh.inside_vertex(from);
  source.at = space.point(source.point);
  const std::array sources = {source};
  REQUIRE(solver.solve(sources, {}));
  std::vector<double> found;
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    found.push_back(solver.distance(mesh.inside_vertex(v)) * mesh.unit());
  return found;
}

TEST_CASE("strings in lattices are as long as in finer ones, but for few") {
  std::mt19937 random(1);
  constexpr int side = 5;
  std::size_t all = 0, longer = 0;
  double most = 0;
  for (int n = 0; n < 24; ++n) {
    const auto out = samples::CellLattice::left_out(side, .15, random);
    const samples::CellLattice coarse(side, out, 1), fine(side, out, 2);
    const std::array<int, 3> at = coarse.any_vertex(random);
    const auto found = distances_from({coarse.places, coarse.tets}, coarse.vertex(at)),
               finer = distances_from({fine.places, fine.tets}, fine.vertex(at));
    coarse.each_vertex([&](const std::array<int, 3>& p) {
      const double a = found[coarse.vertex(p)], b = finer[fine.vertex(p)];
      const double straight = std::hypot(p[0] - at[0], p[1] - at[1], p[2] - at[2]);
      CAPTURE(n, at, p);
      REQUIRE(std::isfinite(a) == std::isfinite(b));
      if (!std::isfinite(a)) return;
      CHECK(a >= straight * (1 - 1e-12));
      ++all;
      longer += a > b * (1 + 1e-3);
      if (b > 0) most = std::max(most, a / b - 1);
    });
  }
  CAPTURE(all, longer, most);
  CHECK(all > 4000);
  CHECK(longer * 2000 < all);
  CHECK(most < .01);
}

}  // namespace

}  // namespace plexway::testing::plans_test
