// Solids cut in two along a plane, with holes or cracks that reach through it.

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <map>
#include <random>
#include <vector>

#include <plexway/mixed/mixed_complex.hpp>
#include <plexway/solve.hpp>

#include "data/crack_plans.hpp"
#include "labels/simplex_obstacles.hpp"

namespace plexway::testing::mixed_torn_test {

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

TEST_CASE("a solid full of holes, cut in two, is about what it was") {
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
          CHECK(found[w] <= right[v] * 1.2);
          CHECK(found[w] >= right[v] * .8);
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

}  // namespace plexway::testing::mixed_torn_test
