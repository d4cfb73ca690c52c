// Cracks that join, or end at corners of holes: paths along one face of a crack, around its end and
// back along the other one.

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <vector>

#include <plexway/solve.hpp>

#include "complexes/test_solids.hpp"
#include "data/crack_plans.hpp"
#include "labels/solving.hpp"

namespace plexway::testing::solid_joined_cracks_test {

namespace {

using Cracks = std::vector<samples::CrackPlan::Crack>;
constexpr int cells = 8;
const Cracks joined[] = {
    {{{2, 2}, {6, 2}}, {{6, 2}, {6, 6}}},                    // an L
    {{{4, 4}, {6, 4}}, {{4, 4}, {4, 7}}},                    // another one
    {{{2, 2}, {6, 2}}, {{4, 2}, {4, 6}}},                    // a T
    {{{2, 3}, {2, 7}}, {{2, 5}, {0, 5}}},                    // a T that ends on the rim
    {{{6, 6}, {6, 1}}, {{6, 3}, {8, 3}}},                    // likewise
    {{{2, 2}, {6, 2}}, {{2, 2}, {2, 5}}, {{6, 2}, {6, 5}}},  // a U
};

struct Problem {
  Cracks cracks;
  std::vector<samples::CrackPlan::Hole> holes;
};
const Problem at_holes[] = {
    {{{{4, 5}, {7, 5}}}, {{{2, 2}, {4, 5}}}},
    {{{{4, 1}, {7, 1}}, {{4, 4}, {4, 6}}}, {{{1, 1}, {4, 4}}}},
    {{{{5, 5}, {8, 5}}, {{4, 7}, {2, 7}}}, {{{2, 1}, {5, 3}}, {{4, 5}, {5, 7}}}},
    {{{{4, 5}, {1, 5}}, {{6, 5}, {8, 5}}}, {{{1, 2}, {2, 4}}, {{4, 3}, {6, 5}}}},
};

// Does a point lie in the plane of a crack?
bool in_plane(const Cracks& cracks, const samples::CrackPlan::Point2& p) {
  return std::any_of(cracks.begin(), cracks.end(), [&](const auto& crack) {
    for (std::size_t i = 0; i < 2; ++i)
      if (crack.begin[i] == crack.end[i] && p[i] * cells == crack.begin[i]) return true;
    return false;
  });
}

// From so many vertices, every other one in the plane of a crack: errors of all of the prism's, and
// how many lay in the plane of a crack.
struct CrackFields {
  double sum = 0;
  std::size_t fields = 0, in_planes = 0;

  void add(const Problem& problem, std::size_t count, double longest, std::mt19937& random) {
    const auto share = [&] { return uniform(random); };
    for (std::size_t n = 0; n < count; ++n) {
      const samples::CrackPlan plan(cells, problem.cracks, .08 * static_cast<double>(n % 4), share,
                                    problem.holes);
      const auto solid = plan.solid(.1 + share() / 2);
      const TetMesh<double> mesh(solid.places, solid.tets);
      const auto floor = static_cast<Index>(plan.places().size());
      Index source = 0;
      do source = below(random, floor);
      while (plan.on_crack(source) ||
             (n % 2 == 0 && !in_plane(problem.cracks, plan.places()[source])));
      const auto flat = plan.distances(source);
      std::vector<double> truth;
      for (Index v = 0; v < solid.places.size(); ++v)
        truth.push_back(std::hypot(flat[v % floor], solid.places[v][2]));
      if (!std::isfinite(*std::max_element(truth.begin(), truth.end()))) continue;
      const auto one = PointSource::at(source);
      for (const auto& distance :
           {solve(Serial{}, mesh, one).distance, solve(OpenMP{2}, mesh, one).distance}) {
        const Errors e = compare(distance, truth);
        CAPTURE(problem.cracks.size(), problem.cracks[0].begin, problem.holes.size(), n, source,
                e.max, e.mean);
        CHECK(e.below >= -1e-6);
        CHECK(e.max <= longest);
        sum += e.mean;
        ++fields;
      }
      in_planes += in_plane(problem.cracks, plan.places()[source]);
    }
  }
};

}  // namespace

TEST_CASE("paths around cracks that join, also from their planes") {
  std::mt19937 random(3);
  CrackFields all;
  for (const Cracks& cracks : joined) all.add({cracks, {}}, 16, 2e-2, random);
  CAPTURE(all.fields, all.in_planes);
  CHECK(all.fields > 150);
  CHECK(all.in_planes > 30);
  CHECK(all.sum / static_cast<double>(all.fields) <= 1e-5);
}

TEST_CASE("paths around cracks that end at corners of holes") {
  std::mt19937 random(4);
  CrackFields all;
  for (const Problem& problem : at_holes) all.add(problem, 24, 5e-2, random);
  CAPTURE(all.fields, all.in_planes);
  CHECK(all.fields > 150);
  CHECK(all.in_planes > 30);
  CHECK(all.sum / static_cast<double>(all.fields) <= 1e-5);
}

}  // namespace plexway::testing::solid_joined_cracks_test
