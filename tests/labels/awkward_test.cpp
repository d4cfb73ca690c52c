#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>
#include <random>
#include <string>

#include <plexway/error.hpp>
#include <plexway/simplicial/simplicial_complex.hpp>
#include <plexway/solve.hpp>

#include "complexes/test_meshes.hpp"
#include "complexes/test_solids.hpp"
#include "labels/front.hpp"
#include "labels/wavefront.hpp"
#include "labels/workspace_state.hpp"
#include "windows/windows_solving.hpp"
#include "with_accuracy.hpp"

namespace plexway::testing::awkward_test {
using namespace detail;

namespace {

// Surfaces that no solver was drawn for. Each is given to check(surface, source).

/// Triangles between any three of up to `most` points more than six.
template <class Check>
void each_soup(unsigned seeds, Index most, const Check& check) {
  for (unsigned seed = 1; seed <= seeds; ++seed) {
    std::mt19937 random(seed);
    const Index points = 6 + below(random, most);
    const Surface s = soup(points, 2 + below(random, 3 * points), seed);
    check(s, below(random, points));
    check(s, s.faces[0][0]);
  }
}

/// Grids of n by n cells and spheres: manifold, with angles from next to nothing to far beyond a
/// full turn, and folded over.
template <class Check>
void each_crumpled(unsigned seeds, Index n, const Check& check) {
  for (unsigned seed = 1; seed <= seeds; ++seed) {
    std::mt19937 random(seed);
    Surface s = grid(n, n);
    for (Position& p : s.positions)
      for (double& c : p) c = uniform(random) * (seed % 2 ? 1 : std::pow(10, 6 * uniform(random)));
    check(s, below(random, s.positions.size()));
    Surface closed = sphere(2);
    for (Position& p : closed.positions)
      for (double& c : p) c *= std::pow(10, 3 * uniform(random));
    check(closed, below(random, closed.positions.size()));
  }
}

/// With triangles that have no area, and edges that have no length.
template <class Check>
void each_flat(const Check& check) {
  std::mt19937 random(4);
  for (int kind = 0; kind < 5; ++kind) {
    Surface s = grid(8, 8);
    for (Position& p : s.positions) {
      if (kind == 0) p[1] = 0;                                 // all on a line
      if (kind == 1) p = {0, 0, 0};                            // all in a point
      if (kind == 2 && uniform(random) < .4) p = {.5, .5, 0};  // many in one
      if (kind == 3) p[0] = std::round(3 * p[0]) / 3;          // rows of slivers
      if (kind == 4) p[1] = p[1] < .5 ? 0 : p[1];
    }
    check(s, 0);
    check(s, 40);
  }
}

/// Which vertices hang together, over edges and vertices alike.
std::vector<Index> pieces(const Surface& s) {
  std::vector<Index> parent(s.positions.size());
  std::iota(parent.begin(), parent.end(), Index{0});
  const auto find = [&](Index v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (const Face& f : s.faces)
    for (std::size_t i = 1; i < 3; ++i) parent[find(f[0])] = find(f[i]);
  for (Index v = 0; v < parent.size(); ++v) parent[v] = find(v);
  return parent;
}

/// Finite exactly where a path leads, never NaN, 0 at the source.
template <class Real>
void check_reach(const Surface& s, Index source) {
  const auto mesh = s.mesh<Real>();
  const std::vector<Index> piece = pieces(s);
  const auto check = [&](const std::vector<double>& d, const std::string& how) {
    CAPTURE(how, source, s.positions.size(), s.faces.size());
    bool right = true;
    for (Index v = 0; v < d.size(); ++v)
      right &= !std::isnan(d[v]) && d[v] >= 0 && std::isfinite(d[v]) == (piece[v] == piece[source]);
    CHECK(right);
    CHECK(d[source] == 0);
  };
  for (const Schedule schedule : schedules)
    for (const Accuracy accuracy : window_accuracies) {
      PropagateOptions options;
      options.schedule = schedule;
      check(solve_windows(mesh, {PointSource::at(source)}, accuracy, options), name(accuracy));
    }
  for (const Visibility visibility : visibilities)
    for (const Schedule schedule : schedules)
      for (const bool vectorised : {true, false}) {
        PropagateOptions options;
        options.visibility = visibility;
        options.schedule = schedule;
        options.vectorised = vectorised;
        check(solve(mesh, PointSource::at(source), options), name(options));
      }
}

}  // namespace

TEMPLATE_TEST_CASE("soups of triangles: finite exactly where a path leads", "", float, double) {
#ifdef PLEXWAY_SANITIZED
  const unsigned seeds = 10;
#else
  const unsigned seeds = 60;
#endif
  each_soup(seeds, 60, check_reach<TestType>);
}

TEMPLATE_TEST_CASE("crumpled grids: finite everywhere", "", float, double) {
#ifdef PLEXWAY_SANITIZED
  const unsigned seeds = 4;
#else
  const unsigned seeds = 20;
#endif
  each_crumpled(seeds, 14, check_reach<TestType>);
}

TEMPLATE_TEST_CASE("zero-area triangles and zero-length edges", "", float, double) {
  each_flat(check_reach<TestType>);
}

TEMPLATE_TEST_CASE("on a line distances are along it", "", float, double) {
  Surface s = grid(8, 3);
  for (Position& p : s.positions) p[1] = 0;
  const Errors e = compare(solve(s.mesh<TestType>(), PointSource::at(0)), straight(s, {0, 0, 0}));
  CHECK(e.max < 1e-5);
}

TEMPLATE_TEST_CASE("a point has no distances", "", float, double) {
  Surface s;
  for (int i = 0; i < 4; ++i) s.add(1, 2, 3);
  s.quad(0, 1, 2, 3);
  for (const double d : solve(s.mesh<TestType>(), PointSource::at(1))) {
    CHECK(d >= 0);
    CHECK(d < 1e-25);
  }
}

TEMPLATE_TEST_CASE("lengths that no triangle has", "", float, double) {
  std::mt19937 random(12);
  const Surface s = grid(9, 9);
  for (int n = 0; n < 40; ++n) {
    std::vector<std::array<double, 3>> lengths = lengths_of(s);
    std::map<std::pair<Index, Index>, double> length;
    for (std::size_t f = 0; f < s.faces.size(); ++f)
      for (std::size_t i = 0; i < 3; ++i)
        lengths[f][i] = length
                            .try_emplace(std::minmax(s.faces[f][i], s.faces[f][(i + 1) % 3]),
                                         uniform(random) < .1 ? 0 : uniform(random))
                            .first->second;
    const TriangleMesh<TestType> mesh(s.positions.size(), s.faces, lengths);
    const auto check = [&](const std::vector<double>& found, const std::string& how) {
      bool fine = true;
      for (const double d : found) fine &= d >= 0 && d < 1e3;
      CAPTURE(n, how);
      CHECK(fine);
    };
    PropagateOptions options;
    for (const Accuracy accuracy : window_accuracies)
      for (const Schedule schedule : schedules) {
        options.schedule = schedule;
        check(solve_windows(mesh, {PointSource::at(50)}, accuracy, options), name(accuracy));
      }
    options.schedule = Schedule::priority;
    for (const Visibility visibility : visibilities) {
      options.visibility = visibility;
      check(solve(mesh, PointSource::at(50), options), name(options));
    }
  }
}

TEMPLATE_TEST_CASE("an edge without length between two of different length", "", float, double) {
  const std::vector<Face> faces = {{0, 1, 2}, {2, 1, 3}};
  const std::vector<std::array<double, 3>> lengths = {{1, 0, .4}, {0, .7, .9}};
  const TriangleMesh<TestType> mesh(4, faces, lengths);
  for (const Visibility visibility : visibilities) {
    PropagateOptions options;
    options.visibility = visibility;
    options.schedule = Schedule::priority;
    CAPTURE(name(options));
    for (const double d : solve(mesh, PointSource::at(0), options)) CHECK(d <= 3);
  }
}

TEMPLATE_TEST_CASE("other components and unreferenced vertices are out of reach", "", float,
                   double) {
  Surface s = grid(6, 6);
  const Index lone = s.add(.5, .5), a = s.add(5, 0), b = s.add(6, 0), c = s.add(5, 1);
  s.triangle(a, b, c);
  check_reach<TestType>(s, 10);
  check_reach<TestType>(s, b);
  check_reach<TestType>(s, lone);
}

// Sizes beside each other that a precision does not hold are refused with the place; what is not
// refused is right. And whatever does not end is ended.

using Catch::Contains;

namespace {

PointSource from(Index vertex) { return PointSource::at(vertex); }

// The corner (1, 1) of a flat square of cells, last of its vertices, moved away along the diagonal:
// between all others the straight line stays inside.
Surface with_far_corner(double away) {
  Surface s = grid(12, 12);
  s.positions.back() = {away, away, 0};
  return s;
}

template <class Real>
double largest_error(const Surface& s) {
  double worst = 0;
  for (const Accuracy accuracy : {Accuracy::fast(), Accuracy::usual()}) {
    const auto d = plexway::solve(Serial{}, s.mesh<Real>(), from(17), at(accuracy)).distance;
    for (std::size_t v = 0; v + 1 < s.positions.size(); ++v) {
      const auto &p = s.positions[v], &q = s.positions[17];
      const double exact = std::hypot(p[0] - q[0], p[1] - q[1]);
      worst = std::max(worst, std::abs(static_cast<double>(d[v]) - exact));
    }
  }
  return worst;
}

// Metric lengths of a grid in which triangle `slow` takes `times` as long.
std::vector<std::array<double, 3>> lengths_of(const Surface& s, std::size_t slow, double times,
                                              bool two_edges) {
  std::vector<std::array<double, 3>> lengths(s.faces.size());
  for (std::size_t f = 0; f < s.faces.size(); ++f)
    for (std::size_t i = 0; i < 3; ++i) {
      const auto &p = s.positions[s.faces[f][i]], &q = s.positions[s.faces[f][(i + 1) % 3]];
      lengths[f][i] = std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
      if (f == slow) lengths[f][i] *= two_edges && i == 0 ? 1 : times;
    }
  if (two_edges) lengths[slow][2] = lengths[slow][1];
  return lengths;
}

template <class Real>
TriangleMesh<Real> refracting(const Surface& s, std::size_t slow, double times, bool two_edges) {
  SurfaceHints hints;
  hints.refracts = true;
  return {s.positions.size(), s.faces, lengths_of(s, slow, times, two_edges), hints};
}

}  // namespace

TEST_CASE("a vertex far away is right or refused on surfaces") {
  for (const double away : {1e2, 1e4, 1e7}) {
    INFO(away);
    CHECK(largest_error<float>(with_far_corner(away)) < 2e-3);
    CHECK(largest_error<double>(with_far_corner(away)) < 2e-3);
  }
  CHECK(largest_error<double>(with_far_corner(1e25)) < 2e-3);
  CHECK_THROWS_AS(with_far_corner(1e25).mesh<float>(), PrecisionError);
  CHECK_THROWS_WITH(with_far_corner(1e25).mesh<float>(),
                    Contains("face 0: its longest edge") && Contains("use double"));
  CHECK_THROWS_WITH(with_far_corner(1e200).mesh<double>(),
                    Contains("face 0: its longest edge") && Contains("a vertex far off"));
}

TEST_CASE("triangles that measure an edge too differently are refused, with both") {
  Surface s = grid(12, 12, 12, 12);
  std::mt19937 random(3);
  for (auto& p : s.positions) p[2] = 0.4 * uniform(random);
  // Just within what is taken, a triangle that is much slower is gone around, wherever it is and
  // whatever its shape: as with one that is a hundred times as slow.
  for (const std::size_t slow : {30u, 101u, 202u})
    for (const bool two_edges : {false, true})
      for (const int corner : {-1, 0, 1, 2}) {
        const Index source = corner < 0 ? 7 : s.faces[slow][static_cast<std::size_t>(corner)];
        const auto wanted =
            plexway::solve(Serial{}, refracting<double>(s, slow, 100, two_edges), from(source))
                .distance;
        const auto twice =
            plexway::solve(Serial{}, refracting<double>(s, slow, two_edges ? 6e5 : 1e11, two_edges),
                           from(source))
                .distance;
        const auto once =
            plexway::solve(Serial{}, refracting<float>(s, slow, two_edges ? 300 : 1e5, two_edges),
                           from(source))
                .distance;
        double worst = 0;
        for (std::size_t v = 0; v < wanted.size(); ++v) {
          if (!(wanted[v] > 0)) continue;
          worst = std::max({worst, std::abs(twice[v] / wanted[v] - 1),
                            std::abs(static_cast<double>(once[v]) / wanted[v] - 1)});
        }
        INFO(slow << ' ' << two_edges << ' ' << corner);
        CHECK(worst < 0.05);
      }
  CHECK_THROWS_AS(refracting<float>(s, 30, 1e6, true), PrecisionError);
  CHECK_THROWS_AS(refracting<double>(s, 30, 1e9, true), PrecisionError);
  CHECK_THROWS_WITH(refracting<double>(s, 30, 1e30, false),
                    Contains("faces ") && Contains("30") && Contains("measure the edge between"));
}

TEST_CASE("a vertex far away is right or refused in solids") {
  const auto solve = [](double away, auto real) {
    Solid cube = solid_cube(6, 0);
    const std::size_t far = cube.positions.size() - 1;
    cube.positions[far] = {away, away, away};
    const TetMesh<decltype(real)> mesh(cube.positions, cube.tets);
    const auto d = plexway::solve(Serial{}, mesh, from(0)).distance;
    double worst = 0;
    for (std::size_t v = 1; v < far; ++v) {
      const auto &p = cube.positions[v], &q = cube.positions[0];
      const double exact = std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
      worst = std::max(worst, std::abs(static_cast<double>(d[v]) / exact - 1));
    }
    return worst;
  };
  CHECK(solve(100, float{}) < 1e-4);
  CHECK(solve(1e6, double{}) < 1e-9);
  CHECK_THROWS_AS(solve(1e9, float{}), PrecisionError);
  CHECK_THROWS_WITH(solve(1e9, float{}), Contains("tet ") && Contains("use double"));
  CHECK_THROWS_WITH(solve(1e20, double{}), Contains("beyond double precision"));
}

TEST_CASE("lengths far apart are right or refused without coordinates") {
  const std::vector<std::array<Index, 4>> tets = {{0, 1, 2, 3}, {4, 5, 6, 7}};
  const auto lengths = [](double large) {
    std::array<double, 6> one, other;
    one.fill(1);
    other.fill(large);
    return std::vector<std::array<double, 6>>{one, other};
  };
  const auto check = [&](auto make) {
    for (const double large : {1., 1e5}) {
      const auto d = plexway::solve(Serial{}, make(large), from(0)).distance;
      for (Index v = 1; v < 4; ++v) CHECK(static_cast<double>(d[v]) == Approx(1));
    }
    CHECK_THROWS_AS(make(1e20), PrecisionError);
  };
  check([&](double large) { return TetMesh<float>(8, tets, lengths(large)); });
  check([&](double large) { return SimplicialComplex<float, 3>(8, tets, lengths(large)); });
  const TetMesh<double> twice(8, tets, lengths(1e20));
  CHECK(plexway::solve(Serial{}, twice, from(0)).distance[3] == Approx(1));
}

TEST_CASE("edges of a wireframe that single precision does not hold are refused by number") {
  const std::vector<std::array<Index, 2>> edges = {{0, 1}, {1, 2}, {2, 3}};
  const std::vector<double> lengths = {1, 1e-30, 1e12};
  CHECK_THROWS_WITH(Wireframe<float>(4, edges, lengths), Contains("edge 1: its length"));
  const Wireframe<double> wires(4, edges, lengths);
  CHECK(plexway::solve(Serial{}, wires, from(1)).distance ==
        std::vector<double>{1, 0, 1e-30, 1e12});
}

TEST_CASE("distances that are no numbers of a precision are refused, not infinite") {
  Surface s = grid(3, 3);
  for (auto& p : s.positions)
    for (double& c : p) c *= 1e60;
  const auto mesh = s.mesh<float>();  // knows its unit in double
  CHECK_THROWS_AS(plexway::solve(Serial{}, mesh, from(0)), PrecisionError);
  CHECK_THROWS_AS(plexway::solve(OpenMP{.threads = 2}, mesh, from(0)), PrecisionError);
  CHECK(plexway::solve(Serial{}, s.mesh<double>(), from(0)).distance[3] == Approx(1e60));
  const Wireframe<float> wires(2, std::vector<std::array<Index, 2>>{{0, 1}},
                               std::vector<double>{1e60});
  CHECK_THROWS_AS(plexway::solve(Serial{}, wires, from(0)), PrecisionError);
}

namespace {

// One simplex that finds a better path to itself each time: what no domain may do.
struct Gaining {
  struct Label {
    float distance;
  };
  template <class Front>
  struct Expander {
    Front& front;
    void operator()(Index s) const {
      const Label better = {front.label(s).distance * (1 - 0x1p-20F)};
      front.accept(s, 0, better, better.distance, 0);
    }
  };
};

using Queue = DualQueue<float>;
using Front = Wavefront<float, Gaining::Label, Queue, false>;

}  // namespace

TEST_CASE("labels that improve without end are given up") {
  const PropagateOptions options;
  WorkspaceState<float> workspace;
  workspace.front.reserve(2);
  workspace.start(2, false);
  Gaining::Label labels[3] = {{1e30F}, {1e30F}, {0}};
  const auto make = [&] {
    return Front(workspace.marks, labels,
                 Queue(workspace.front, std::numeric_limits<float>::infinity()), nullptr, 2, 1,
                 options);
  };
  Front alone = make();
  const Gaining::Expander<Front> expand = {alone};
  alone.accept(0, 0, labels[0], 1e30F, 0);
  const auto forever = [&] {
    Index s = 0;
    do {
      while (alone.next(s, [&](Index t) { return labels[t].distance; })) expand(s);
    } while (alone.take_stock(0));
  };
  CHECK_THROWS_AS(forever(), EndlessError);

  CHECK_NOTHROW(check_end(endless_after(1000), 1000));
}

}  // namespace plexway::testing::awkward_test
