#include <algorithm>
#include <array>
#include <atomic>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <random>
#include <thread>
#include <utility>
#include <vector>

#include <plexway/mixed.hpp>
#include <plexway/solid.hpp>
#include <plexway/solve.hpp>
#include <plexway/surface.hpp>

#include "strings/solid_strings.hpp"

// Between points of a convex body the shortest path outside of it runs on its surface: what exact
// windows find there is the truth for strings around it.

namespace plexway::testing::round_obstacles_test {
using namespace detail;
namespace {

using Position = std::array<double, 3>;

/// An octahedron cut into four so many times, its vertices on an ellipsoid: all edges are convex.
struct Body {
  std::vector<Position> positions = {{1, 0, 0},  {-1, 0, 0}, {0, 1, 0},
                                     {0, -1, 0}, {0, 0, 1},  {0, 0, -1}};
  std::vector<std::array<Index, 3>> faces = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                                             {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};

  Body(int times, double stretch) {
    for (; times > 0; --times) {
      std::map<std::pair<Index, Index>, Index> middle;
      const auto between = [&](Index a, Index b) {
        const auto [at, is_new] =
            middle.insert({std::minmax(a, b), static_cast<Index>(positions.size())});
        if (is_new) {
          Position p;
          for (std::size_t i = 0; i < 3; ++i) p[i] = positions[a][i] + positions[b][i];
          const double length = std::hypot(p[0], p[1], p[2]);
          for (double& x : p) x /= length;
          positions.push_back(p);
        }
        return at->second;
      };
      std::vector<std::array<Index, 3>> cut;
      for (const auto& [a, b, c] : faces) {
        const Index ab = between(a, b), bc = between(b, c), ca = between(c, a);
        cut.insert(cut.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
      }
      faces = cut;
    }
    for (Position& p : positions) p[0] *= stretch;
  }
};

/// Two layers of prisms around it.
struct Shell {
  std::vector<Position> positions;
  std::vector<std::array<Index, 4>> tets;

  explicit Shell(const Body& body) {
    for (const double scale : {1., 1.2, 1.5})
      for (const Position& p : body.positions)
        positions.push_back({scale * p[0], scale * p[1], scale * p[2]});
    const auto n = static_cast<Index>(body.positions.size());
    for (Index low : {Index{0}, n})
      for (auto face : body.faces) {
        std::sort(face.begin(), face.end());  // neighbours cut what they share alike
        const auto [a, b, c] = face;
        const Index high = low + n;
        tets.push_back({low + a, low + b, low + c, high + c});
        tets.push_back({low + a, low + b, high + b, high + c});
        tets.push_back({low + a, high + a, high + b, high + c});
      }
  }
};

struct Off {
  double mean = 0, low = 0, high = 0;

  Off(const std::vector<double>& found, std::size_t first, const std::vector<double>& truth) {
    for (std::size_t v = 0; v < truth.size(); ++v) {
      if (!(truth[v] > 0)) continue;
      const double by = found[first + v] / truth[v] - 1;
      mean += std::abs(by) / static_cast<double>(truth.size());
      low = std::min(low, by);
      high = std::max(high, by);
    }
  }
};

}  // namespace

TEST_CASE("around round bodies strings are as long as exact windows on them, and never shorter") {
  for (const auto& [times, stretch] : {std::pair{2, 1.}, {3, 1.}, {3, 1.7}}) {
    const Body body(times, stretch);
    const Shell shell(body);
    const TriangleMesh<double> surface(body.positions, body.faces);
    const TetMesh<double> solid(shell.positions, shell.tets);
    // With a wire it is a mixed domain.
    MixedComplex<double> mixed;
    const auto whole = mixed.add(solid, shell.positions);
    const auto n = body.positions.size();
    Position beyond = shell.positions[2 * n];
    beyond[0] += 3;
    const std::vector<Position> ends = {shell.positions[2 * n], beyond};
    const std::vector<std::array<Index, 2>> edge = {{0, 1}};
    mixed.weld(whole, mixed.add(Wireframe<double>(ends, edge), ends));
    PropagateOptions exactly;
    exactly.accuracy = Accuracy::exact();
    for (const std::size_t from : {std::size_t{0}, std::size_t{7}, n / 2, n - 1}) {
      const auto source = static_cast<Index>(from);
      const auto truth = solve(Serial{}, surface, PointSource::at(source), exactly);
      const Off flat(solve(Serial{}, solid, PointSource::at(source)).distance, 0, truth.distance);
      const Off wired(solve(Serial{}, mixed, PointSource::at(whole.vertex(source))).distance,
                      whole.first_vertex, truth.distance);
      CAPTURE(times, stretch, from, flat.mean, flat.high, wired.mean, wired.high);
      CHECK(flat.low > -1e-9);
      CHECK(flat.mean < 1e-4);
      CHECK(flat.high < 3e-3);
      CHECK(wired.low > -1e-9);
      CHECK(wired.mean < 5e-4);
      CHECK(wired.high < 1e-2);
    }
  }
}

// Who makes offers, and in which order, does not matter.
TEST_CASE("strings by threads in any order: the same bits, paths too") {
  const Shell shell(Body(4, 1.3));
  const TetMesh<double> mesh(shell.positions, shell.tets);
  const auto space = space_of(mesh);
  const strings::Source source = source_at(*space, 0, 0);
  const auto solve = [&](strings::Solver& solver, const strings::Threads& threads,
                         double radius = std::numeric_limits<double>::infinity()) {
    strings::Limits limits;
    limits.threads = threads;
    limits.radius = radius;
    CHECK(solver.solve({&source, 1}, limits));
  };
  std::size_t shared = 0;
  std::mt19937 random(1);
  const auto backwards = [&](std::size_t count, const strings::Threads::Work& work) {
    shared += count;
    for (std::size_t i = count; i-- > 0;) work(i, random() % 3);
  };
  const auto by_two = [](std::size_t count, const strings::Threads::Work& work) {
    std::atomic<std::size_t> next{0};
    const auto take = [&](std::size_t thread) {
      for (std::size_t i = 0; (i = next++) < count;) work(i, thread);
    };
    std::thread other(take, 1);
    take(0);
    other.join();
  };
  strings::Solver one(*space), other(*space), two(*space), near(*space);
  solve(one, {});
  const double radius = one.distance(static_cast<Index>(mesh.vertex_count() / 2));
  solve(near, {}, radius);
  solve(other, {3, backwards});
  solve(two, {2, by_two});
  CHECK(shared > mesh.vertex_count() / 2);
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    CAPTURE(v);
    REQUIRE(one.distance(v) == other.distance(v));
    REQUIRE(one.distance(v) == two.distance(v));
    CHECK(near.distance(v) >= one.distance(v) * (1 - 1e-9));
    if (one.distance(v) <= radius) CHECK(near.distance(v) <= one.distance(v) * (1 + 1e-9));
    const auto path = one.path(v).points, again = other.path(v).points;
    REQUIRE(path.size() == again.size());
    for (std::size_t k = 0; k < path.size(); ++k) CHECK(norm(path[k] - again[k]) == 0);
  }
}

}  // namespace plexway::testing::round_obstacles_test
