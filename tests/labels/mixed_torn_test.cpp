#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <map>
#include <random>
#include <vector>

#include <plexway/mixed/mixed_complex.hpp>
#include <plexway/simplicial/kuhn_grid.hpp>
#include <plexway/solve.hpp>

#include "data/crack_plans.hpp"
#include "labels/simplex_obstacles.hpp"

namespace mixed_torn_test {

using plexway::testing::distance_between;
using plexway::testing::random_obstacles;
using plexway::testing::uniform;

// Surfaces that lie on a solid, or end on it: nothing that they add makes a path shorter than the
// solid's own, or than the straight line.

namespace {

using namespace plexway;
using Position = std::array<double, 3>;

double apart(const Position& p, const Position& q) {
  return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
}

// Tetrahedra, and triangles of their boundary with vertices of their own.
struct Skinned {
  std::vector<Position> positions, skin;
  std::vector<std::array<Index, 4>> tets;
  std::vector<std::array<Index, 3>> triangles;
  std::vector<Index> on_skin;  // by vertex of the solid, or none

  // Of the faces at the boundary those that `takes`.
  template <class Takes>
  void add_skin(const Takes& takes) {
    std::map<std::array<Index, 3>, int> faces;
    for (const auto& t : tets)
      for (std::size_t i = 0; i < 4; ++i) {
        std::array<Index, 3> face{};
        for (std::size_t j = 0, k = 0; j < 4; ++j)
          if (j != i) face[k++] = t[j];
        std::sort(face.begin(), face.end());
        ++faces[face];
      }
    on_skin.assign(positions.size(), none);
    for (const auto& [face, count] : faces) {
      if (count != 1 || !takes()) continue;
      std::array<Index, 3> own = face;
      for (Index& v : own) {
        if (on_skin[v] == none) {
          on_skin[v] = static_cast<Index>(skin.size());
          skin.push_back(positions[v]);
        }
        v = on_skin[v];
      }
      triangles.push_back(own);
    }
  }
};

Skinned block(const std::array<std::size_t, 3>& cells, const KuhnGrid<3>::Absent& absent) {
  const KuhnGrid<3> grid(cells,
                         {1. / static_cast<double>(cells[0]), 1. / static_cast<double>(cells[1]),
                          1. / static_cast<double>(cells[2])});
  Skinned made;
  for (Index v = 0; v < grid.vertex_count(); ++v) made.positions.push_back(grid.position(v));
  made.tets = grid.simplices(absent);
  return made;
}

TEST_CASE("a solid with a cavity welded to its own boundary has its own distances") {
  const auto inside = [](const auto& cell) {
    return std::all_of(cell.begin(), cell.end(), [](auto c) { return c >= 3 && c < 6; });
  };
  Skinned s = block({9, 9, 9}, inside);
  s.add_skin([] { return true; });
  const TetMesh<double> alone(s.positions, s.tets);
  MixedComplex<double> domain;
  const auto solid = domain.add(alone, s.positions);
  const auto skin = domain.add(TriangleMesh<double>(s.skin, s.triangles), s.skin);
  domain.weld(solid, skin, {.tolerance = 1e-9});
  for (const Index source : {Index{0}, Index{450}, Index{333}}) {
    const auto own = solve(Serial{}, alone, PointSource::at(source));
    const auto both = solve(Serial{}, domain, PointSource::at(solid.vertex(source)));
    for (Index v = 0; v < s.positions.size(); ++v) {
      CAPTURE(source, v);
      if (!std::isfinite(own.distance[v])) continue;
      REQUIRE(both.distance[solid.vertex(v)] == Approx(own.distance[v]).epsilon(1e-9));
    }
  }
}

TEST_CASE("light from a solid bends where a fin ends") {
  const KuhnGrid<3> grid({16, 16, 8}, {.125, .125, .125}, {-1, -1, -1});
  std::vector<Position> block, fin;
  for (Index v = 0; v < grid.vertex_count(); ++v) block.push_back(grid.position(v));
  std::vector<std::array<Index, 3>> triangles;
  for (Index j = 0; j <= 8; ++j)
    for (Index i = 0; i <= 8; ++i) {
      fin.push_back({0, -.5 + i / 8., j / 8.});
      if (i == 0 || j == 0) continue;
      const Index a = (j - 1) * 9 + i - 1;
      triangles.push_back({a, a + 1, a + 10});
      triangles.push_back({a, a + 10, a + 9});
    }
  MixedComplex<double> domain;
  const auto solid = domain.add(TetMesh<double>(block, grid.simplices()), block);
  const auto sheet = domain.add(TriangleMesh<double>(fin, triangles), fin);
  domain.weld(solid, sheet, {.tolerance = 1e-9});
  const Position from = {.25, -.75, -.25};
  const auto field = solve(Serial{}, domain, PointSource::at(solid.vertex(grid.nearest(from))));
  // Over the line y from -.5 to .5 at the fin's foot.
  for (Index v = 0; v < fin.size(); ++v) {
    const double off = std::hypot(from[0], from[2]), z = fin[v][2], span = fin[v][1] - from[1];
    const double y = std::clamp(from[1] + span * off / (off + z), -.5, .5);
    const double truth = std::hypot(off, y - from[1]) + std::hypot(z, fin[v][1] - y);
    CAPTURE(fin[v][1], z);
    REQUIRE(field.distance[sheet.vertex(v)] > truth * (1 - 1e-9));
    CHECK(field.distance[sheet.vertex(v)] < truth * (1 + 2e-3));
  }
  CHECK(field.distance[sheet.vertex(4 * 9)] == Approx(std::sqrt(.1875) + .5).epsilon(1e-9));
}

TEST_CASE("no welding of a random solid with its own surface is below the straight line") {
  std::size_t fields = 0;
  for (unsigned seed = 0; seed < 40; ++seed) {
    std::mt19937 random(seed);
    const auto share = [&] { return std::uniform_real_distribution<double>(0, 1)(random); };
    const std::size_t n = 3 + random() % 3;
    std::vector<char> gone(n * n * n);
    const double empty = .35 * share();
    for (char& cell : gone) cell = share() < empty;
    Skinned s =
        block({n, n, n}, [&](const auto& c) { return gone[c[0] + n * (c[1] + n * c[2])] != 0; });
    if (s.tets.empty()) continue;
    const double moved = random() % 2 == 0 ? 0 : .15 / static_cast<double>(n);
    for (Position& p : s.positions)
      for (double& x : p)
        if (x > .01 && x < .99) x += moved * (2 * share() - 1);
    const double covered = random() % 2 == 0 ? 1 : .2 + .8 * share();
    s.add_skin([&] { return share() < covered; });
    if (s.triangles.empty()) continue;
    MixedComplex<double> domain;
    const auto solid = domain.add(TetMesh<double>(s.positions, s.tets), s.positions);
    const auto skin = domain.add(TriangleMesh<double>(s.skin, s.triangles), s.skin);
    domain.weld(solid, skin, {.tolerance = 1e-9});
    for (const bool in_skin : {false, true}) {
      const Index v = s.tets[random() % s.tets.size()][0];
      const Index f = static_cast<Index>(random() % s.triangles.size());
      Position from = s.positions[v];
      if (in_skin)
        for (std::size_t k = 0; k < 3; ++k)
          from[k] = .5 * s.skin[s.triangles[f][0]][k] + .3 * s.skin[s.triangles[f][1]][k] +
                    .2 * s.skin[s.triangles[f][2]][k];
      const PointSource source = in_skin ? PointSource::in(skin.simplex(f), {.5, .3, .2})
                                         : PointSource::at(solid.vertex(v));
      const auto field = solve(Serial{}, domain, source);
      constexpr double radius = .6;
      const auto near = solve(Serial{}, domain, source, {.radius = radius});
      ++fields;
      const auto check = [&](const auto& piece, const std::vector<Position>& at) {
        for (Index w = 0; w < at.size(); ++w) {
          CAPTURE(seed, in_skin, w);
          const double least = apart(at[w], from) * (1 - 1e-9);
          REQUIRE(field.distance[piece.vertex(w)] >= least);
          const double there = near.distance[piece.vertex(w)];
          REQUIRE(there >= least);
          if (std::isfinite(there)) REQUIRE(there <= radius);
        }
      };
      check(solid, s.positions);
      check(skin, s.skin);
    }
  }
  CHECK(fields > 60);
}

}  // namespace

// Solids cut in two along a plane, with holes or cracks that reach through it.

namespace {

/// Tetrahedra whose centre is beyond a height of one coordinate are another piece; lengths there
/// are divided by its speed.
struct CutInTwo {
  CutInTwo(const std::vector<Position>& places, const std::vector<std::array<Index, 4>>& tets,
           std::size_t coordinate, double height, double speed) {
    std::array<std::map<Index, Index>, 2> number;
    std::vector<MixedComplex<double>::Piece> pieces;
    for (const std::size_t side : {0, 1}) {
      std::vector<Position> own, at;
      std::vector<std::array<Index, 4>> corners;
      for (auto tet : tets) {
        double middle = 0;
        for (const Index v : tet) middle += places[v][coordinate] / 4;
        if ((middle > height) != (side == 1)) continue;
        for (Index& v : tet) {
          const auto [found, is_new] = number[side].try_emplace(v, static_cast<Index>(own.size()));
          if (is_new) {
            at.push_back(places[v]);
            own.push_back(places[v]);
            for (double& x : own.back()) x /= side == 1 ? speed : 1;
            vertex.push_back(v);
          }
          v = found->second;
        }
        corners.push_back(tet);
      }
      pieces.push_back(domain.add(TetMesh<double>(own, corners), at));
    }
    std::vector<std::array<Index, 2>> pairs;
    for (const auto& [v, n] : number[0])
      if (const auto other = number[1].find(v); other != number[1].end())
        pairs.push_back({n, other->second});
    domain.weld(pieces[0], pieces[1], pairs);
  }
  MixedComplex<double> domain;
  std::vector<Index> vertex;  // of the whole, by vertex of the domain
};

}  // namespace

TEST_CASE("a solid full of holes, cut in two, is what it was") {
  // Strings around rings about the hinges' edges were taken for whole ways: out of range.
  for (const unsigned seed : {5u, 6u, 7u}) {
    std::mt19937 random(seed);
    auto obstacles = random_obstacles<3>(seed, 5, 4);
    obstacles.blocks.clear();
    for (std::size_t i = 0; i < 5; ++i)
      for (std::size_t j = 0; j < 5; ++j)
        for (std::size_t k = 0; k < 5; ++k)
          if (uniform(random) < .25) obstacles.blocks.push_back({{i, j, k}, {i + 1, j + 1, k + 1}});
    std::vector<Position> places;
    for (Index v = 0; v < obstacles.grid.vertex_count(); ++v)
      places.push_back(obstacles.grid.position(v));
    const auto tets =
        obstacles.grid.simplices([&](const auto& cell) { return obstacles.is_absent(cell); });
    const TetMesh<double> whole(places, tets);
    for (const double speed : {1., 1.0000001}) {
      const double height = obstacles.grid.planes(2)[1 + random() % 4];
      const CutInTwo cut(places, tets, 2, height, speed);
      for (int n = 0; n < 4; ++n) {
        const auto from = static_cast<Index>(random() % cut.vertex.size());
        const Index source = cut.vertex[from];
        const auto found = solve(Serial{}, cut.domain, PointSource::at(from)).distance;
        const auto right = solve(Serial{}, whole, PointSource::at(source)).distance;
        for (std::size_t w = 0; w < found.size(); ++w) {
          const Index v = cut.vertex[w];
          CAPTURE(seed, speed, source, v, found[w], right[v]);
          REQUIRE(std::isfinite(found[w]) == std::isfinite(right[v]));
          if (!std::isfinite(right[v])) continue;
          CHECK(found[w] >= distance_between(places[v], places[source]) / speed * (1 - 1e-8));
          // Single vertices of either are too far by that much.
          CHECK(found[w] <= right[v] * (1 + 1e-3));
          CHECK(found[w] >= right[v] * (1 - 1e-6));
        }
      }
    }
  }
}

TEST_CASE("cracks that join are not seen through where a solid is cut across them") {
  using Cracks = std::vector<samples::CrackPlan::Crack>;
  constexpr int cells = 8;
  constexpr double speed = 1.1;
  struct {
    Cracks cracks;
    int row;  // of the face between both speeds
  } const problems[] = {
      {{{{4, 4}, {4, 7}}, {{4, 5}, {0, 5}}}, 6},
      {{{{2, 1}, {2, 7}}, {{2, 5}, {6, 5}}}, 3},
      {{{{6, 6}, {6, 1}}, {{6, 3}, {8, 3}}}, 5},
      {{{{2, 2}, {2, 7}}, {{2, 2}, {6, 2}}, {{6, 2}, {6, 7}}}, 4},
  };
  std::mt19937 random(11);
  const auto share = [&] { return uniform(random); };
  double low = 0;
  for (const auto& problem : problems) {
    const samples::CrackPlan plan(cells, problem.cracks, 0, share);
    const auto solid = plan.solid(.3);
    const double height = static_cast<double>(problem.row) / cells;
    const CutInTwo cut(solid.places, solid.tets, 1, height, speed);
    const auto floor = static_cast<Index>(plan.places().size());
    for (std::size_t from = 0; from < cut.vertex.size(); from += 3) {
      const Index source = cut.vertex[from];
      if (source >= floor || plan.on_crack(source)) continue;
      const auto flat = plan.distances(source);
      const auto found =
          solve(Serial{}, cut.domain, PointSource::at(static_cast<Index>(from))).distance;
      for (std::size_t w = 0; w < found.size(); ++w) {
        const Index v = cut.vertex[w];
        // No way is shorter than if all were as fast as the faster piece.
        const double least = std::hypot(flat[v % floor], solid.places[v][2]) / speed;
        CAPTURE(problem.row, source, v, found[w], least);
        CHECK(found[w] >= least * (1 - 1e-6));
        if (least > 1e-9) low = std::min(low, found[w] / least - 1);
      }
    }
  }
  CAPTURE(low);
  CHECK(low > -1e-6);  // -.3 with places alone
}

TEST_CASE("an arm of cracks in the face between two speeds is not seen through") {
  // Where a crack leaves that face the corner is one place with a vertex on either side.
  using Cracks = std::vector<samples::CrackPlan::Crack>;
  constexpr int cells = 8;
  struct {
    Cracks cracks;
    int row;  // of the face
  } const problems[] = {
      {{{{1, 7}, {6, 7}}, {{1, 7}, {1, 4}}}, 7},
      {{{{6, 5}, {1, 5}}, {{6, 5}, {6, 2}}}, 5},
      {{{{5, 3}, {2, 3}}, {{5, 3}, {5, 2}}}, 3},
      {{{{6, 3}, {3, 3}}, {{6, 3}, {6, 0}}, {{3, 3}, {3, 1}}}, 3},
      {{{{3, 5}, {5, 5}}, {{3, 5}, {3, 8}}, {{5, 5}, {5, 7}}}, 5},
      {{{{5, 4}, {2, 4}}, {{5, 4}, {5, 6}}, {{2, 4}, {2, 6}}}, 4},
      {{{{2, 4}, {6, 4}}, {{4, 2}, {4, 6}}}, 4},
  };
  std::mt19937 random(19);
  const auto share = [&] { return uniform(random); };
  double low = 0, high = 0, sum = 0, count = 0;
  for (int round = 0; round < 6; ++round)
    for (const auto& [cracks, row] : problems) {
      const samples::CrackPlan plan(cells, cracks, .08 * (round % 3), share, {}, row);
      const auto solid = plan.solid(.1 + share() / 2);
      const double speed = std::exp2((share() - .5) * 3);
      const CutInTwo cut(solid.places, solid.tets, 1, static_cast<double>(row) / cells, speed);
      const auto floor = static_cast<Index>(plan.places().size());
      Index from = 0;
      do from = static_cast<Index>(random() % cut.vertex.size());
      while (cut.vertex[from] >= floor || plan.on_crack(cut.vertex[from]));
      const auto truth = plan.times(cut.vertex[from], row, {1, speed}, 1000);
      const auto found = solve(Serial{}, cut.domain, PointSource::at(from)).distance;
      for (std::size_t w = 0; w < found.size(); ++w) {
        const Index v = cut.vertex[w];
        if (v >= floor || !(truth[v] > 1e-9)) continue;
        const double off = found[w] / truth[v] - 1;
        low = std::min(low, off);
        high = std::max(high, off);
        sum += std::abs(off);
        ++count;
      }
    }
  CAPTURE(low, high, sum / count);
  CHECK(low > -2e-5);  // what the truth is good for; it was -.66
  // Set after seeing: .012 and 1.2e-5, before .055 and 1.2e-3.
  CHECK(high < .03);
  CHECK(sum / count < 1e-4);
}

}  // namespace mixed_torn_test
