#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <plexway/solve.hpp>

#include "data/random_stacks.hpp"
#include "fuzz/fuzz_pierced.hpp"
#include "plan_errors.hpp"

/// Solids of several speeds.
namespace bench {

/// From a vertex on a plane between two slabs, or from any.
inline void solve_stack(Random& random, double thinnest, double thickest, bool on_plane,
                        PlanErrors& errors) {
  const samples::Stack stack = samples::random_stack(random, 20, thinnest, thickest);
  const samples::StackDomain whole(stack);
  const auto& places = whole.places;
  const auto& planes = stack.layers.z;
  plexway::Index source;
  do {
    source = static_cast<plexway::Index>(random() % places.size());
  } while (on_plane && std::find(planes.begin(), planes.end(), places[source][2]) == planes.end());
  Distances truth;
  for (const auto& p : places) truth.push_back(stack.layers.time(places[source], p));
  errors.add(
      plexway::solve(plexway::Serial{}, whole.domain, plexway::PointSource::at(source)).distance,
      truth);
}

/// Two solids of two speeds with rectangles or slits cut out of both.
inline void solve_pierced(Random& random, bool slits, std::size_t plans, PlanErrors& errors) {
  while (plans > 0) {
    std::array<std::uint8_t, 16> bytes;
    for (std::uint8_t& b : bytes) b = static_cast<std::uint8_t>(random() >> 24);
    fuzz::Choices choices(bytes.data(), bytes.size());
    auto plan = fuzz::plan_of(choices);
    if (!plan) continue;
    if (slits) plan->blocks = fuzz::slits_of(plan->blocks);
    if (std::any_of(plan->blocks.begin(), plan->blocks.end(), [&](const auto& b) {
          return b.left == b.right && std::abs(plan->source[0] - b.left) < 1e-9;
        }))
      continue;  // from a slit, or in its line
    if (const auto solved = fuzz::solve_pierced(*plan, choices)) {
      errors.add(solved->found, solved->truth);
      --plans;
    }
  }
}

}  // namespace bench
