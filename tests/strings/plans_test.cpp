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

#include "data/crack_plans.hpp"
#include "strings/solver.hpp"

// Strings in prisms over random plans, against visibility graphs: exact to rounding.

namespace plexway::testing::strings_plans_test {
namespace {

using Random = std::mt19937;
constexpr double infinity = std::numeric_limits<double>::infinity();

double share(Random& random) { return static_cast<double>(random()) / 4294967296.; }

std::vector<double> distances(const TetMesh<double>& mesh, const std::vector<Index>& sources,
                              const std::vector<double>& offsets = {}) {
  const strings::MediaSpace space(std::make_shared<const strings::SolidSpace>(mesh));
  strings::Solver solver(space);
  std::vector<strings::Source> from;
  for (std::size_t n = 0; n < sources.size(); ++n) {
    strings::Source source;
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

/// Cells, some left out at random, as cubes of tetrahedra; two high.
struct CellPlan {
  static constexpr int cells = 8, high = 2;
  std::vector<char> out = std::vector<char>(cells * cells);
  std::vector<std::array<double, 3>> places;
  std::vector<std::array<int, 2>> corner;  // of the plan, below each
  std::vector<std::array<Index, 4>> tets;

  CellPlan(Random& random, double left_out) {
    for (char& o : out) o = share(random) < left_out ? 1 : 0;
    constexpr int side = cells + 1;
    std::vector<Index> number(side * side * (high + 1), none);
    const auto vertex = [&](const std::array<int, 3>& at) {
      Index& n = number[static_cast<std::size_t>((at[2] * side + at[1]) * side + at[0])];
      if (n == none) {
        n = static_cast<Index>(places.size());
        places.push_back({double(at[0]), double(at[1]), double(at[2])});
        corner.push_back({at[0], at[1]});
      }
      return n;
    };
    for (int k = 0; k < high; ++k)
      for (int j = 0; j < cells; ++j)
        for (int i = 0; i < cells; ++i) {
          if (!is_cell(i, j)) continue;
          std::array<std::size_t, 3> axis = {0, 1, 2};
          do {
            std::array<int, 3> at = {i, j, k};
            std::array<Index, 4> tet = {vertex(at), 0, 0, 0};
            for (std::size_t e = 0; e < 3; ++e) {
              ++at[axis[e]];
              tet[e + 1] = vertex(at);
            }
            tets.push_back(tet);
          } while (std::next_permutation(axis.begin(), axis.end()));
        }
  }
  [[nodiscard]] bool is_cell(int i, int j) const {
    return i >= 0 && j >= 0 && i < cells && j < cells &&
           out[static_cast<std::size_t>(j * cells + i)] == 0;
  }
  /// Along a row of the grid one of the cells beside each step is enough; else no cell that is left
  /// out may be crossed.
  [[nodiscard]] bool sees(const std::array<int, 2>& a, const std::array<int, 2>& b) const {
    const int dx = b[0] - a[0], dy = b[1] - a[1];
    if (dx == 0 || dy == 0) {
      for (int x = std::min(a[0], b[0]); x < std::max(a[0], b[0]); ++x)
        if (!is_cell(x, a[1]) && !is_cell(x, a[1] - 1)) return false;
      for (int y = std::min(a[1], b[1]); y < std::max(a[1], b[1]); ++y)
        if (!is_cell(a[0], y) && !is_cell(a[0] - 1, y)) return false;
      return true;
    }
    for (int j = std::min(a[1], b[1]); j < std::max(a[1], b[1]); ++j)
      for (int i = std::min(a[0], b[0]); i < std::max(a[0], b[0]); ++i) {
        if (is_cell(i, j)) continue;
        int left = 0, right = 0;
        for (const int c : {0, 1, 2, 3}) {
          const int side = dx * (j + c / 2 - a[1]) - dy * (i + c % 2 - a[0]);
          left += side > 0;
          right += side < 0;
        }
        if (left > 0 && right > 0) return false;
      }
    return true;
  }
  [[nodiscard]] std::vector<double> truth(Index source) const {
    constexpr int side = cells + 1;
    const auto corner_at = [](int n) { return std::array<int, 2>{n % side, n / side}; };
    std::vector<double> flat(side * side, infinity);
    std::vector<char> done(side * side, 0);
    const auto at = [](int n) { return static_cast<std::size_t>(n); };
    flat[at(corner[source][1] * side + corner[source][0])] = 0;
    for (;;) {
      int next = -1;
      for (int n = 0; n < side * side; ++n)
        if (done[at(n)] == 0 && flat[at(n)] < infinity &&
            (next < 0 || flat[at(n)] < flat[at(next)]))
          next = n;
      if (next < 0) break;
      done[at(next)] = 1;
      const auto a = corner_at(next);
      for (int n = 0; n < side * side; ++n) {
        const auto b = corner_at(n);
        const double by = flat[at(next)] + std::hypot(a[0] - b[0], a[1] - b[1]);
        if (by < flat[at(n)] && sees(a, b)) flat[at(n)] = by;
      }
    }
    std::vector<double> truth;
    for (std::size_t v = 0; v < places.size(); ++v)
      truth.push_back(std::hypot(flat[at(corner[v][1] * side + corner[v][0])],
                                 places[v][2] - places[source][2]));
    return truth;
  }
};

/// The same through a space of one medium.
std::vector<double> through_media(const CellPlan& plan, Index source) {
  strings::Parts parts;
  for (const auto& p : plan.places) parts.points.push_back({p[0], p[1], p[2]});
  parts.tets = plan.tets;
  parts.slow_tets.assign(plan.tets.size(), 1);
  const strings::MediaSpace space(parts);
  strings::Solver solver(space);
  strings::Source from;
  from.point = source;
  from.at = space.point(source);
  REQUIRE(solver.solve({&from, 1}));
  std::vector<double> found;
  for (Index p = 0; p < plan.places.size(); ++p) found.push_back(solver.distance(p) * space.unit());
  return found;
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

TEST_CASE("strings around cracks that join are exact") {
  using Cracks = std::vector<samples::CrackPlan::Crack>;
  const std::vector<Cracks> all = {
      {{{2, 3}, {6, 3}}},                                      // one
      {{{2, 3}, {6, 3}}, {{6, 3}, {6, 6}}},                    // an L
      {{{2, 3}, {6, 3}}, {{4, 3}, {4, 0}}},                    // a T, to the rim
      {{{2, 3}, {6, 3}}, {{2, 3}, {2, 6}}, {{6, 3}, {6, 6}}},  // a U
  };
  for (const Cracks& cracks : all)
    for (const double jitter : {0., .1}) {
      Random random(5);
      const samples::CrackPlan plan(8, cracks, jitter, [&] { return share(random); });
      const auto solid = plan.solid(.3);
      const TetMesh<double> mesh(solid.places, solid.tets);
      const std::size_t floor = plan.places().size();
      for (int n = 0; n < 12; ++n) {
        const auto source = static_cast<Index>(random() % floor);
        if (plan.on_crack(source)) continue;
        const auto flat = plan.distances(source);
        std::vector<double> truth;
        for (std::size_t v = 0; v < solid.places.size(); ++v)
          truth.push_back(std::hypot(flat[v % floor], solid.places[v][2]));
        const auto [more, less] = compare(distances(mesh, {source}), truth);
        CAPTURE(cracks.size(), jitter, source);
        CHECK(more < 1e-12);
        CHECK(less < 2e-7);  // the truth goes around ends at 1e-8
      }
    }
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

}  // namespace
}  // namespace plexway::testing::strings_plans_test
