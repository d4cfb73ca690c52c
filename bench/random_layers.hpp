#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include <plexway/complex/mixed_complex.hpp>
#include <plexway/complex/tet_mesh.hpp>
#include <plexway/solve.hpp>

#include "data/pierced_layers.hpp"
#include "data/random_stacks.hpp"
#include "fuzz/fuzz_plan.hpp"
#include "fuzz/fuzz_whole.hpp"
#include "plan_errors.hpp"

/// Solids of several speeds.
namespace bench {

/// From a vertex on a plane between two slabs, or from any.
inline void solve_stack(Random& random, double thinnest, double thickest, bool on_plane,
                        PlanErrors& errors) {
  const samples::Stack stack = samples::random_stack(random, 20, thinnest, thickest);
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
  const auto& planes = stack.layers.z;
  plexway::Index source;
  do {
    source = static_cast<plexway::Index>(random() % places.size());
  } while (on_plane && std::find(planes.begin(), planes.end(), places[source][2]) == planes.end());
  Distances truth;
  for (const auto& p : places) truth.push_back(stack.layers.time(places[source], p));
  errors.add(plexway::solve(plexway::Serial{}, domain, plexway::PointSource::at(source)).distance,
             truth);
}

/// Two solids whose plans meet in a line. Rectangles may reach over it, but no side of one lies in
/// it; slits come from the rim and end anywhere. Paths from the floor to the floor stay on it.
/// False for one that does not count.
inline bool solve_pierced(const samples::CornerDomain& plan, fuzz::Choices& choices,
                          PlanErrors& errors) {
  samples::Shape shape = fuzz::meshed(plan, choices);
  const double middle =
      static_cast<double>(1 + choices.byte() % (fuzz::plan_cells - 1)) / fuzz::plan_cells;
  for (auto& p : shape.points)
    if (std::abs(p[1] - middle) < 0.4 / fuzz::plan_cells) p[1] = middle;
  for (const auto& b : plan.blocks)
    if (b.left < b.right && (b.bottom == middle || b.top == middle)) return false;
  const samples::PiercedLayers layers = {
      plan, middle, {1, std::exp2((choices.byte() - 127.5) / 80)}};
  // The lips of slits lie on each other; what is told of them lies beside.
  std::vector<samples::Point> beside = shape.points;
  for (std::size_t v = 0; v < beside.size(); ++v)
    for (const auto& b : plan.blocks) {
      const double off = beside[v][0] - b.left;
      if (b.left != b.right || off == 0 || std::abs(off) > 1e-12) continue;
      shape.points[v][0] = b.left;
      beside[v][0] = b.left + (off > 0 ? 1e-8 : -1e-8);
    }
  const Distances known = layers.times(beside);
  const fuzz::Prism prism = fuzz::prism_of(shape, fuzz::height_of(choices));
  fuzz::Whole whole(prism.places);
  const auto parts = fuzz::dealt(prism.tets, prism.places, 2, [&](const fuzz::Place& at) {
    return std::size_t{at[1] > middle};
  });
  for (const std::size_t k : {0, 1}) whole.add(parts[k], layers.speed[k]);
  const Distances all = whole.solve(0);
  Distances found, truth;
  for (std::size_t v = 0; v < all.size(); ++v)
    if (const plexway::Index place = whole.places()[v]; place < known.size()) {
      found.push_back(all[v]);
      truth.push_back(known[place]);
    }
  errors.add(found, truth);
  return true;
}

/// From the rim to where they end, the longest of those on a line.
inline std::vector<samples::CornerDomain::Block> slits_of(
    const std::vector<samples::CornerDomain::Block>& blocks) {
  std::map<double, double> top;
  for (const auto& b : blocks) top[b.left] = std::max(top[b.left], b.top);
  std::vector<samples::CornerDomain::Block> slits;
  for (const auto& [x, y] : top) slits.push_back({x, x, -1, y});
  return slits;
}

inline void solve_pierced(Random& random, bool slits, std::size_t plans, PlanErrors& errors) {
  while (plans > 0) {
    std::array<std::uint8_t, 16> bytes;
    for (std::uint8_t& b : bytes) b = static_cast<std::uint8_t>(random() >> 24);
    fuzz::Choices choices(bytes.data(), bytes.size());
    auto plan = fuzz::plan_of(choices);
    if (!plan) continue;
    if (slits) plan->blocks = slits_of(plan->blocks);
    if (std::any_of(plan->blocks.begin(), plan->blocks.end(), [&](const auto& b) {
          return b.left == b.right && std::abs(plan->source[0] - b.left) < 1e-9;
        }))
      continue;  // from a slit, or in its line
    plans -= solve_pierced(*plan, choices, errors);
  }
}

}  // namespace bench
