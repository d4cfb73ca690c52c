#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include <plexway/solve.hpp>

#include "data/pierced_layers.hpp"
#include "data/random_stacks.hpp"
#include "fuzz/fuzz_pierced.hpp"

// Two speeds where something is cut out of both, and many in coarse slabs: bench_random_plans has
// more of them.

TEST_CASE("holes and cracks through the face between two speeds are never too near") {
  std::mt19937 random(3);
  for (const bool cracks : {false, true}) {
    double low = 0, high = 0, sum = 0, count = 0;
    for (int plans = 40; plans > 0;) {
      std::array<std::uint8_t, 16> bytes;
      for (std::uint8_t& b : bytes) b = static_cast<std::uint8_t>(random() >> 24);
      fuzz::Choices choices(bytes.data(), bytes.size());
      auto plan = fuzz::plan_of(choices);
      if (!plan) continue;
      if (cracks) plan->blocks = fuzz::slits_of(plan->blocks);
      bool from_crack = false;
      for (const auto& b : plan->blocks)
        from_crack |= cracks && std::abs(plan->source[0] - b.left) < 1e-9;
      if (from_crack) continue;
      const auto solved = fuzz::solve_pierced(*plan, choices);
      if (!solved) continue;
      --plans;
      for (std::size_t v = 0; v < solved->found.size(); ++v) {
        if (!(solved->truth[v] > 1e-12)) continue;
        const double off = solved->found[v] / solved->truth[v] - 1;
        low = std::min(low, off);
        high = std::max(high, off);
        sum += std::abs(off);
        ++count;
      }
    }
    CAPTURE(cracks, low, high, sum / count);
    CHECK(low > -5e-5);  // what the truth is good for; it was -.27
    // Set after seeing: 300 plans have .10 and 7e-4, .12 and 3.5e-3.
    CHECK(high < .2);
    CHECK(sum / count < (cracks ? 1e-2 : 2e-3));
  }
}

TEST_CASE("vertices of coarse slabs do not miss head waves") {
  std::mt19937 random(5);
  std::size_t off = 0, far = 0, vertices = 0;
  double low = 0;
  for (int plans = 0; plans < 30; ++plans) {
    const samples::Stack stack = samples::random_stack(random, 20, .7, 1.5);
    plexway::MixedComplex<double> domain;
    std::vector<samples::Position> places;
    std::vector<plexway::MixedComplex<double>::Piece> pieces;
    for (std::size_t k = 0; k < stack.blocks.size(); ++k) {
      const auto& [positions, tets] = stack.blocks[k];
      places.insert(places.end(), positions.begin(), positions.end());
      auto timed = positions;
      for (auto& p : timed)
        for (double& x : p) x /= stack.layers.v[k];
      pieces.push_back(domain.add(plexway::TetMesh<double>(timed, tets), positions));
      if (k > 0) domain.weld(pieces[k - 1], pieces[k], plexway::WeldOptions{.tolerance = 1e-9});
    }
    plexway::Index source = pieces[1].first_vertex;  // on a plane
    while (places[source][2] != stack.layers.z[0] || random() % 8 != 0)
      source = pieces[1].first_vertex + (source + 1 - pieces[1].first_vertex) % pieces[1].vertices;
    const auto field = plexway::solve(plexway::Serial{}, domain, plexway::PointSource::at(source));
    plexway::PropagateOptions near;
    near.radius = .5;
    const auto within =
        plexway::solve(plexway::Serial{}, domain, plexway::PointSource::at(source), near);
    for (std::size_t v = 0; v < places.size(); ++v) {
      const double truth = stack.layers.time(places[source], places[v]);
      CHECK(within.distance[v] >= field.distance[v] * (1 - 1e-12));
      CHECK((within.distance[v] <= near.radius || std::isinf(within.distance[v])));
      if (!(truth > 1e-12)) continue;
      const double by = field.distance[v] / truth - 1;
      low = std::min(low, by);
      off += by > 1e-3;
      far += by > 2e-2;
      ++vertices;
    }
  }
  CAPTURE(vertices, off, far, low);
  CHECK(low > -1e-12);
  CHECK(static_cast<double>(off) < 2e-4 * static_cast<double>(vertices));  // 2 % missed them
  CHECK(far == 0);
}
