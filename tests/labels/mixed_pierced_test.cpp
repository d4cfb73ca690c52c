#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <vector>

#include <plexway/solve.hpp>

#include "data/pierced_layers.hpp"
#include "data/random_stacks.hpp"
#include "fuzz/fuzz_pierced.hpp"

namespace mixed_pierced_test {

// Two speeds where something is cut out of both, and many in coarse slabs: bench random_plans has
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
    // Set after seeing: 300 plans have .017 and 6e-6, .070 and 1.8e-4; 700 others .067 and .090.
    CHECK(high < (cracks ? .12 : .08));
    CHECK(sum / count < (cracks ? 1e-3 : 1e-4));
  }
}

TEST_CASE("vertices of coarse slabs do not miss head waves") {
  std::mt19937 random(5);
  std::size_t off = 0, far = 0, vertices = 0;
  double low = 0;
  for (int plans = 0; plans < 30; ++plans) {
    const samples::Stack stack = samples::random_stack(random, 20, .7, 1.5);
    const samples::StackDomain whole(stack);
    const auto& [domain, pieces, places] = whole;
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

TEST_CASE("a source on the plane of thin slabs is known on both sides of it") {
  // Plan 26: all tetrahedra of the slow slab keep labels that came through the layer above. Others:
  // along the plane is the nearest way to single vertices, and no neighbour of these keeps that.
  std::mt19937 random(1);
  for (int plan = 0; plan <= 89; ++plan) {
    const samples::Stack stack = samples::random_stack(random, 20, .02, 1.5);
    std::vector<samples::Position> places;
    for (const auto& b : stack.blocks)
      places.insert(places.end(), b.positions.begin(), b.positions.end());
    const auto& planes = stack.layers.z;
    std::size_t source = 0;
    do {
      source = random() % places.size();
    } while (std::find(planes.begin(), planes.end(), places[source][2]) == planes.end());
    if (plan != 26 && plan != 31 && plan != 34 && plan != 89) continue;
    const samples::StackDomain whole(stack);
    const auto field =
        plexway::solve(plexway::Serial{}, whole.domain,
                       plexway::PointSource::at(static_cast<plexway::Index>(source)));
    CHECK(field.complete);
    for (std::size_t v = 0; v < places.size(); ++v) {
      const double truth = stack.layers.time(places[source], places[v]);
      CAPTURE(plan, v, truth, field.distance[v]);
      CHECK(field.distance[v] >= truth * (1 - 1e-12));
      // 180 of 464 were up to 13 % too long, then 1, 4 and 2 up to 20, 43 and 25 %.
      CHECK(field.distance[v] <= truth * (1 + 1e-6) + 1e-15);
    }
  }
}

// Of several sources the one that is told is the one that the distance is from.
TEST_CASE("sources that vertices of slabs are told are those of their distances") {
  std::mt19937 random(31);
  std::size_t vertices = 0, others = 0;
  double low = 0;
  for (int plans = 0; plans < 6; ++plans) {
    const samples::Stack stack = samples::random_stack(random, 8, plans % 2 == 0 ? .7 : .05, 1.5);
    const samples::StackDomain whole(stack);
    const auto time = [&](const plexway::PointSource& source, std::size_t v) {
      return source.offset + stack.layers.time(whole.places[source.vertex], whole.places[v]);
    };
    std::vector<plexway::PointSource> sources;
    for (int n = plans % 3 == 0 ? 2 : plans % 3 == 1 ? 5 : 30; n > 0; --n) {
      sources.push_back(
          plexway::PointSource::at(static_cast<plexway::Index>(random() % whole.places.size())));
      sources.back().offset = samples::between(random, 0, .3);
    }
    const auto field = plexway::solve(plexway::Serial{}, whole.domain, sources);
    for (std::size_t v = 0; v < whole.places.size(); ++v) {
      double truth = std::numeric_limits<double>::infinity();
      for (const auto& source : sources) truth = std::min(truth, time(source, v));
      if (!(truth > 1e-9)) continue;
      ++vertices;
      low = std::min(low, field.distance[v] / truth - 1);
      others += field.distance[v] < time(sources[field.label[v]], v) * (1 - 1e-5);
    }
  }
  CAPTURE(vertices, others, low);
  CHECK(low > -1e-9);
  CHECK(others <= 1);  // 30 of 2,400 before; one in 6,000 is left
}

}  // namespace mixed_pierced_test
