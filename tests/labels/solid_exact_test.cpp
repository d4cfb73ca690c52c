#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <numeric>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include <plexway/simplicial/kuhn_grid.hpp>
#include <plexway/solid/tet_mesh.hpp>
#include <plexway/solve.hpp>
#include <plexway/solve/workspace.hpp>

#include "complexes/test_solids.hpp"
#include "exact_data.hpp"
#include "labels/solid_closed_forms.hpp"
#include "labels/solid_solving.hpp"

namespace plexway::testing::solid_exact_test {

namespace {

// Solids with exact distances.

struct SolidTruth {
  Solid solid;
  std::vector<double> exact;
};

// TetGen's files, 0-based, without attributes; nothing, and a warning, where they are missing.
std::optional<SolidTruth> read_solid_truth(const std::string& name, Index source) {
  const std::filesystem::path folder = exact_file("solids", name + ".node").parent_path();
  if (folder.empty()) {
    WARN("not measured: no " << name);
    return {};
  }
  SolidTruth truth;
  std::size_t count = 0, skip = 0;
  std::ifstream nodes(folder / (name + ".node"));
  nodes >> count >> skip >> skip >> skip;
  truth.solid.positions.resize(count);
  for (Position& p : truth.solid.positions) nodes >> skip >> p[0] >> p[1] >> p[2];
  std::ifstream tets(folder / (name + ".ele"));
  tets >> count >> skip >> skip;
  truth.solid.tets.resize(count);
  for (Tet& t : truth.solid.tets) tets >> skip >> t[0] >> t[1] >> t[2] >> t[3];
  truth.exact = exact_values(folder / (name + ".v" + std::to_string(source) + ".txt"));
  REQUIRE(nodes);
  REQUIRE(tets);
  REQUIRE(truth.exact.size() == truth.solid.positions.size());
  return truth;
}

}  // namespace

TEST_CASE("a convex solid is exact") {
  for (const double jitter : {0.0, 0.2}) {
    const Solid s = moved(solid_cube(9, jitter), 3.7, {5, -2, 1});
    for (const Index source : {Index(0), s.nearest(5, 0, 2), Index(999)}) {
      const auto field = plexway::solve(Serial{}, s.mesh<double>(), PointSource::at(source));
      const Errors e = compare(field.distance, straight(s, s.positions[source]));
      CAPTURE(jitter, source, e.max);
      CHECK(e.fits);
      CHECK(e.max < 1e-12);
      const double updates = static_cast<double>(field.statistics.updates);
      CHECK(updates < 1.05 * static_cast<double>(s.tets.size()));
      const Errors f = compare(solve(s.mesh<float>(), PointSource::at(source)),
                               straight(s, s.positions[source]));
      CHECK(f.fits);
      CHECK(f.max < 2e-5);
    }
  }
}

TEST_CASE("a convex solid is exact from inside a tetrahedron, by any schedule") {
  const Solid s = solid_cube(6);
  for (const std::array<double, 4>& b : {std::array<double, 4>{.1, .2, .3, .4},
                                         {.25, .25, .25, .25},
                                         {.5, .5, 0, 0},
                                         {0, 1, 0, 0},
                                         {0, .3, .3, .4}})
    for (const Index tet : {Index(0), Index(700)})
      for (const Schedule schedule : schedules) {
        Position at = {0, 0, 0};
        for (std::size_t i = 0; i < 4; ++i)
          for (std::size_t d = 0; d < 3; ++d) at[d] += b[i] * s.positions[s.tets[tet][i]][d];
        PropagateOptions options;
        options.schedule = schedule;
        const Errors e =
            compare(solve(s.mesh<double>(), PointSource::in(tet, b), options), straight(s, at));
        CAPTURE(tet, e.max, name(options));
        CHECK(e.max < 1e-11);
      }
}

TEST_CASE("around one reflex edge") {
  for (const Index n : {6u, 12u, 16u}) {
    const Solid s = l_shape(n);
    for (const Position& from : {Position{1, 0, 0}, {1, .5, .5}, {.9, .3, .4}, {0, 0, 1}}) {
      const Index source = s.nearest(from[0], from[1], from[2]);
      const Errors e = compare(solve(s.mesh<double>(), PointSource::at(source)),
                               around_l(s, s.positions[source]));
      CAPTURE(n, source, e.mean, e.max, e.below);
      CHECK(e.fits);
      CHECK(e.mean < 1e-12);
      CHECK(e.max < 1e-8);
    }
  }
}

TEST_CASE("over a thick wall") {
  const Solid s = walled(16);
  for (const Position& from : {Position{0, 0, 0}, {.25, .5, .5}, {0, 1, .3}}) {
    const Index source = s.nearest(from[0], from[1], from[2]);
    const Errors e = compare(solve(s.mesh<double>(), PointSource::at(source)),
                             over_wall(s, s.positions[source]));
    CAPTURE(source, e.mean, e.max, e.below);
    CHECK(e.fits);
    CHECK(e.mean < 1e-12);
    CHECK(e.max < 1e-8);
  }
}

TEST_CASE("through an edge that two solids share") {
  const Solid s = edge_touch(8);
  const Index source = s.nearest(0, 0, 0);
  std::vector<double> exact;
  for (const Position& p : s.positions) {
    const double one = std::sqrt(.5), two = std::hypot(p[0] - .5, p[1] - .5);
    exact.push_back(std::max(p[0], p[1]) > .5 ? over(one + two, p[2])
                                              : std::hypot(p[0], p[1], p[2]));
  }
  const Errors e = compare(solve(s.mesh<double>(), PointSource::at(source)), exact);
  CAPTURE(e.mean, e.max, e.below);
  CHECK(e.fits);
  CHECK(e.mean < 1e-2);
  for (const Visibility visibility : {Visibility::centroid, Visibility::upper_bound}) {
    PropagateOptions options;
    options.visibility = visibility;
    const Errors plain = compare(solve(s.mesh<double>(), PointSource::at(source), options), exact);
    CAPTURE(name(options), plain.mean, plain.below);
    CHECK(plain.fits);
    CHECK(plain.mean < 5e-2);
    if (visibility == Visibility::upper_bound) CHECK(plain.below > -1e-12);
  }
}

TEST_CASE("through a vertex that two solids share") {
  const Solid s = vertex_touch(6);
  const Index source = s.nearest(0, 0, 0);
  std::vector<double> exact;
  for (const Position& p : s.positions)
    exact.push_back(std::max({p[0], p[1], p[2]}) > .5
                        ? std::sqrt(.75) + std::hypot(p[0] - .5, p[1] - .5, p[2] - .5)
                        : std::hypot(p[0], p[1], p[2]));
  for (const Visibility visibility : solid_visibilities) {
    PropagateOptions options;
    options.visibility = visibility;
    const Errors e = compare(solve(s.mesh<double>(), PointSource::at(source), options), exact);
    CAPTURE(name(options), e.mean, e.max);
    CHECK(e.fits);
    if (visibility == Visibility::saddles) CHECK(e.max < 1e-11);
  }
}

TEST_CASE("upper bounds are bounds, and lengths alone give the plain step") {
  for (const Solid& s : {solid_cube(7), l_shape(8)}) {
    const Index source = s.nearest(1, 0, 0);
    const auto exact = around_l(s, s.positions[source]);
    PropagateOptions options;
    options.visibility = Visibility::upper_bound;
    const TetMesh<double> lengths(s.positions.size(), s.tets, s.lengths());
    CHECK(!lengths.embedded());
    const bool convex = s.mesh<double>().summary().reflex_edges == 0;
    for (const auto& d : {solve(s.mesh<double>(), PointSource::at(source), options),
                          solve(lengths, PointSource::at(source), options)}) {
      const Errors e = compare(d, convex ? straight(s, s.positions[source]) : exact);
      CAPTURE(convex, e.mean, e.max, e.below);
      CHECK(e.fits);
      CHECK(e.below > -1e-9);
      CHECK(e.mean < 1e-1);
    }
    const Errors plain = compare(solve(lengths, PointSource::at(source)),
                                 convex ? straight(s, s.positions[source]) : exact);
    CAPTURE(plain.mean, plain.below);
    CHECK(plain.fits);
    CHECK(plain.mean < 1e-2);
  }
}

TEMPLATE_TEST_CASE("grids given by lengths alone are exact", "", float, double) {
  for (const Index n : {6u, 12u})
    for (const Position& stretch : {Position{1, 1, 1}, {3, 1, 1}, {1, 1, 3}}) {
      Solid s = solid_cube(n, 0);
      for (Position& p : s.positions)
        for (std::size_t i = 0; i < 3; ++i) p[i] *= stretch[i];
      const TetMesh<TestType> mesh(s.positions.size(), s.tets, s.lengths());
      for (const Index source : {Index{0}, static_cast<Index>(s.positions.size() / 2), n}) {
        const Errors e =
            compare(solve(mesh, PointSource::at(source)), straight(s, s.positions[source]));
        CAPTURE(n, source, stretch[0], e.mean, e.max, e.below);
        CHECK(e.fits);
        CHECK(e.max < (sizeof(TestType) == 4 ? 5e-6 : 1e-14));
      }
    }
}

namespace {

using Position = std::array<double, 3>;
using Corners = std::array<Index, 4>;

double distance(const Position& a, const Position& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

}  // namespace

TEMPLATE_TEST_CASE("two sources in one tetrahedron both count", "", float, double) {
  const std::vector<Position> positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0},
                                           {0, 0, 1}, {1, 1, 1}, {-1, -1, -1}};
  const std::vector<Corners> tets = {{0, 1, 2, 3}, {4, 1, 2, 3}, {5, 0, 2, 3}};
  const TetMesh<TestType> mesh(positions, tets);
  const std::vector<PointSource> sources = {PointSource::in(0, {.7, .1, .1, .1}),
                                            PointSource::in(0, {.1, .7, .1, .1})};
  const std::array<Position, 2> at = {{{.1, .1, .1}, {.7, .1, .1}}};
  const auto field = solve(Serial{}, mesh, sources, {});
  for (Index v = 0; v < 5; ++v) {  // all of these are in sight of both
    const double first = distance(positions[v], at[0]), second = distance(positions[v], at[1]);
    CHECK(field.distance[v] == Approx(std::min(first, second)));
    CHECK(field.label[v] == (first < second ? 0u : 1u));
  }
}

TEST_CASE("a long row of blocks that touch at vertices is reached to its end") {
  std::vector<Position> positions = {{0, 0, 0}};
  std::vector<Corners> tets;
  const Index blocks = 200;
  for (Index k = 0; k < blocks; ++k) {  // from (k, k, k) to the next, with three points between
    const double x = k;
    const Index first = static_cast<Index>(positions.size() - 1);
    for (const Position& p : {Position{x + 1, x, x}, Position{x, x + 1, x}, Position{x, x, x + 1},
                              Position{x + 1, x + 1, x + 1}})
      positions.push_back(p);
    tets.push_back({first, first + 1, first + 2, first + 3});
    tets.push_back({first + 4, first + 1, first + 2, first + 3});
  }
  const TetMesh<double> mesh(positions, tets);
  const auto field = solve(Serial{}, mesh, PointSource::at(0));
  CHECK(field.complete);
  for (Index k = 1; k <= blocks; ++k)
    CHECK(field.distance[4 * k] == Approx(k * std::sqrt(3.)).epsilon(1e-9));
  for (const double d : field.distance) CHECK(d < std::numeric_limits<double>::infinity());
}

TEMPLATE_TEST_CASE("a stray vertex costs the others no digits", "", float, double) {
  std::vector<Position> positions = {
      {5e6, 5e6, 5e6}, {5e6 + 1, 5e6, 5e6}, {5e6, 5e6 + 1, 5e6}, {5e6, 5e6, 5e6 + 1}, {0, 0, 0}};
  const std::vector<Corners> tets = {{0, 1, 2, 3}};
  const TetMesh<TestType> mesh(positions, tets);
  const auto field = solve(Serial{}, mesh, PointSource::at(1));
  CHECK(field.distance[0] == Approx(1).epsilon(1e-6));
  CHECK(field.distance[2] == Approx(std::sqrt(2.)).epsilon(1e-6));
  CHECK(field.distance[4] == std::numeric_limits<TestType>::infinity());
}

// Vertices between the cells of several sources in a solid: each knows its own source, though no
// tetrahedron around it may have its label.

TEST_CASE("several sources in a cube: straight lines, whoever works") {
  std::mt19937 random(5);
  const auto share = [&] { return static_cast<double>(random()) / 4294967296.; };
  constexpr std::size_t n = 9;
  const KuhnGrid<3> grid({n, n, n}, {1, 1, 1});
  const auto tets = grid.simplices();
  for (const std::size_t count : {2, 5, 20, 200, 600}) {
    std::vector<std::array<double, 3>> places;
    for (Index v = 0; v < grid.vertex_count(); ++v) {
      places.push_back(grid.position(v));
      for (double& x : places.back())
        if (x > .5 && x < n - .5) x += .3 * share() - .15;
    }
    const TetMesh<double> cube(places, tets);
    std::vector<PointSource> sources;
    std::vector<double> truth(places.size(), std::numeric_limits<double>::infinity());
    for (std::size_t k = 0; k < count; ++k) {
      const auto v = static_cast<Index>(random() % places.size());
      sources.push_back(PointSource::at(v));
      sources.back().offset = count % 2 == 0 ? 0 : 2 * share();
      for (std::size_t w = 0; w < places.size(); ++w)
        truth[w] = std::min(truth[w], sources[k].offset + std::hypot(places[w][0] - places[v][0],
                                                                     places[w][1] - places[v][1],
                                                                     places[w][2] - places[v][2]));
    }
    const auto field = solve(Serial{}, cube, sources);
    for (std::size_t w = 0; w < places.size(); ++w) {
      CAPTURE(count, w);
      CHECK(std::abs(field.distance[w] - truth[w]) <= 1e-12);
      const PointSource& s = sources[field.label[w]];
      CHECK(std::abs(s.offset +
                     std::hypot(places[w][0] - places[s.vertex][0],
                                places[w][1] - places[s.vertex][1],
                                places[w][2] - places[s.vertex][2]) -
                     truth[w]) <= 1e-12);
    }
    for (const int threads : {1, 2, 3, 8}) {
      const auto by_team = solve(OpenMP{threads}, cube, sources);
      for (std::size_t w = 0; w < places.size(); ++w)
        CHECK(std::abs(by_team.distance[w] - truth[w]) <= 1e-12);
    }
  }
}

TEMPLATE_TEST_CASE("solids: scale and place do not matter", "", float, double) {
  const Solid s = l_shape(6);
  const Index source = s.nearest(1, 0, 0);
  const auto base = solve(s.mesh<TestType>(), PointSource::at(source));
  for (const double scale : {1e-6, 1e6}) {
    Solid scaled = s;
    for (Position& p : scaled.positions)
      for (double& x : p) x *= scale;
    auto d = solve(scaled.mesh<TestType>(), PointSource::at(source));
    for (double& x : d) x /= scale;
    const Errors e = compare(d, base);
    CHECK(e.max < (sizeof(TestType) == 4 ? 1e-5 : 1e-9));
  }
  Solid offset = s;
  for (Position& p : offset.positions)
    for (double& x : p) x += 1e6;
  const Errors e = compare(solve(offset.mesh<TestType>(), PointSource::at(source)), base);
  CHECK(e.max < 1e-4);
}

TEST_CASE("solids: order and orientation do not matter") {
  const Solid s = l_shape(6);
  const Index source = s.nearest(1, 0, 0);
  const auto base = solve(s.mesh<double>(), PointSource::at(source));
  std::mt19937 random(3);
  std::vector<Index> place(s.positions.size());
  std::iota(place.begin(), place.end(), Index{0});
  for (std::size_t i = place.size(); i > 1; --i) std::swap(place[i - 1], place[below(random, i)]);
  Solid mixed = s;
  for (std::size_t v = 0; v < place.size(); ++v) mixed.positions[place[v]] = s.positions[v];
  for (Tet& t : mixed.tets) {
    for (Index& v : t) v = place[v];
    std::swap(t[below(random, 4)], t[below(random, 4)]);
  }
  for (std::size_t i = mixed.tets.size(); i > 1; --i)
    std::swap(mixed.tets[i - 1], mixed.tets[below(random, i)]);
  const auto found = solve(mixed.mesh<double>(), PointSource::at(place[source]));
  std::vector<double> back(found.size());
  for (std::size_t v = 0; v < place.size(); ++v) back[v] = found[place[v]];
  CHECK(compare(back, base).max < 1e-9);
}

TEST_CASE("solids: there and back") {
  const Solid s = l_shape(8);
  const Index a = s.nearest(1, 0, .25), b = s.nearest(0, 1, .75);
  const auto mesh = s.mesh<double>();
  CHECK(solve(mesh, PointSource::at(a))[b] ==
        Approx(solve(mesh, PointSource::at(b))[a]).epsilon(1e-9));
}

TEST_CASE("solids: no path is longer than along edges") {
  for (const Solid& s : {l_shape(6), walled(8), edge_touch(6)}) {
    const auto bound = along_edges(s, 0);
    const auto found = solve(s.mesh<double>(), PointSource::at(0));
    for (std::size_t v = 0; v < bound.size(); ++v) CHECK(found[v] <= bound[v] * (1 + 1e-12));
  }
}

TEST_CASE("solids: tetrahedra without volume keep between the straight line and the edges") {
  // A cube pressed onto a line or flat, or its lowest layer of cells.
  std::mt19937 random(8);
  for (const int axes : {1, 2, 3})
    for (int round = 0; round < 4; ++round) {
      Solid s = solid_cube(4, 0);
      for (Position& p : s.positions) {
        const bool low = p[2] < .3;
        for (double& x : p) x += (axes == 3 ? .06 : .3) * (uniform(random) - .5);
        if (axes == 1) p[1] = 0;
        if (axes < 3 || low) p[2] = 0;
      }
      const auto source = static_cast<Index>(below(random, s.positions.size()));
      const auto bound = along_edges(s, source);
      const auto found = solve(s.mesh<double>(), PointSource::at(source));
      for (std::size_t v = 0; v < bound.size(); ++v) {
        const Position &p = s.positions[v], &q = s.positions[source];
        CAPTURE(axes, round, v);
        CHECK(found[v] <= bound[v] * (1 + 1e-12));
        CHECK(found[v] >= std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]) * (1 - 1e-9));
      }
    }
}

namespace {

// The largest relative error beyond two mean edges from the source.
double worst_far(const std::vector<double>& found, const std::vector<double>& exact, double unit) {
  double worst = 0;
  for (std::size_t v = 0; v < exact.size(); ++v)
    if (exact[v] > 2 * unit) worst = std::max(worst, std::abs(found[v] / exact[v] - 1));
  return worst;
}

// Nothing where the solid is missing.
template <class Real>
std::optional<double> mean_error(const std::string& name, Index source,
                                 double worst_allowed = .04) {
  const auto truth = read_solid_truth(name, source);
  if (!truth) return {};
  const auto mesh = truth->solid.mesh<Real>();
  const auto found = solve(mesh, PointSource::at(source));
  const Errors e = compare(found, truth->exact);
  const double worst = worst_far(found, truth->exact, mesh.unit());
  CAPTURE(name, e.mean, e.max, e.below, worst);
  CHECK(e.fits);
  CHECK(worst <= worst_allowed);
  return e.mean;
}

}  // namespace

TEST_CASE("solids with exact answers, double") {
  CHECK(mean_error<double>("cube_10k", 8).value_or(0) <= 1e-12);
  CHECK(mean_error<double>("maze_10k", 32).value_or(0) <= 5e-12);
  CHECK(mean_error<double>("notch_10k", 14).value() <= 5e-12);
  CHECK(mean_error<double>("notch_100k", 14).value_or(0) <= 5e-12);
  const double cavity = mean_error<double>("cavity_10k", 170).value();
  const double finer_cavity = mean_error<double>("cavity_100k", 650).value_or(0);
  CHECK(cavity <= 1.3e-3);
  CHECK(finer_cavity <= 4e-4);
  CHECK(finer_cavity < cavity / 1.5);
}

TEST_CASE("solids with exact answers, float") {
  CHECK(mean_error<float>("cube_10k", 8).value_or(0) <= 1e-7);
  CHECK(mean_error<float>("maze_10k", 32).value_or(0) <= 1.5e-7);
  CHECK(mean_error<float>("notch_10k", 14).value() <= 1.5e-7);
  CHECK(mean_error<float>("cavity_10k", 170).value() <= 1.3e-3);
}

TEST_CASE("plain steps on solids with exact answers") {
  const SolidTruth truth = read_solid_truth("notch_10k", 14).value();
  PropagateOptions options;
  options.visibility = Visibility::centroid;
  CHECK(compare(solve(truth.solid.mesh<double>(), PointSource::at(14), options), truth.exact).mean <
        2e-3);
  options.visibility = Visibility::upper_bound;
  const Errors bound =
      compare(solve(truth.solid.mesh<double>(), PointSource::at(14), options), truth.exact);
  CHECK(bound.fits);
  CHECK(bound.below > -1e-9);
  CHECK(bound.mean < 7e-2);
}

}  // namespace plexway::testing::solid_exact_test
