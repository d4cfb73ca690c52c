// Sizes beside each other that a precision does not hold are refused with the place; what is not
// refused is right. And whatever does not end is ended.

#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include <plexway/error.hpp>
#include <plexway/simplicial/simplicial_complex.hpp>
#include <plexway/solve.hpp>

#include "complexes/test_meshes.hpp"
#include "complexes/test_solids.hpp"
#include "executors/threads/crew.hpp"
#include "labels/front.hpp"
#include "labels/wavefront.hpp"
#include "labels/workspace_state.hpp"
#include "with_accuracy.hpp"

namespace plexway::testing::extremes_test {

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
    void far_ahead(Index) const {}
    void ahead(Index) const {}
  };
  struct Rule {
    std::function<float(Index)> distance;
  };

  Rule rule_;
  [[nodiscard]] const Rule& rule() const { return rule_; }
  template <class Front, class Rounds>
  [[nodiscard]] auto expander(Front& front, bool, const Rounds&) const {
    return Expander<Front>{front};
  }
  template <class Spread>
  void run(const Spread& spread) const {
    spread(false);
  }
};

using Queue = DualQueue<float>;
using Front = Wavefront<float, Gaining::Label, Queue, false>;

}  // namespace

TEST_CASE("labels that improve without end are given up, alone and by a team") {
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

  workspace.start(2, false);
  labels[0] = {1e30F};
  Front front = make();
  front.accept(0, 0, labels[0], 1e30F, 0);
  const Team team(OpenMP{.threads = 1});
  const TeamCrew<float, false> crew(team, workspace, 1, 1, options);
  Gaining gaining = {{[&](Index s) { return labels[s].distance; }}};
  CHECK_THROWS_WITH(crew.run(gaining, front, 2), Contains("labels keep improving without end"));
  CHECK_NOTHROW(check_end(endless_after(1000), 1000));
}

}  // namespace plexway::testing::extremes_test
