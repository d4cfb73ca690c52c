#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <vector>

#include "data/pierced_layers.hpp"
#include "fuzz_whole.hpp"

/// Holes and cracks that reach through the face between two solids of two speeds.
namespace fuzz {

/// Distances of the floor's vertices.
struct Pierced {
  std::vector<double> found, truth;
};

/// Two solids whose plans meet in a line. Rectangles may reach over it; where a side of one lies in
/// it there is no answer. Slits come from the rim and end anywhere. Paths from the floor to the
/// floor stay on it.
inline std::optional<Pierced> solve_pierced(const samples::CornerDomain& plan, Choices& choices) {
  samples::Shape shape = meshed(plan, choices);
  const double middle = static_cast<double>(1 + choices.byte() % (plan_cells - 1)) / plan_cells;
  for (auto& p : shape.points)
    if (std::abs(p[1] - middle) < 0.4 / plan_cells) p[1] = middle;
  for (const auto& b : plan.blocks)
    if (b.left < b.right && (b.bottom == middle || b.top == middle)) return {};
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
  const std::vector<double> known = layers.times(beside);
  const Prism prism = prism_of(shape, height_of(choices));
  Whole whole(prism.places);
  const auto parts = dealt(prism.tets, prism.places, 2,
                           [&](const Place& at) { return std::size_t{at[1] > middle}; });
  for (const std::size_t k : {0, 1}) whole.add(parts[k], layers.speed[k]);
  const std::vector<double> all = whole.solve(0);
  Pierced solved;
  for (std::size_t v = 0; v < all.size(); ++v)
    if (const Index place = whole.places()[v]; place < known.size()) {
      solved.found.push_back(all[v]);
      solved.truth.push_back(known[place]);
    }
  return solved;
}

/// Slits from the rim to where they end, the longest of those on a line.
inline std::vector<samples::CornerDomain::Block> slits_of(
    const std::vector<samples::CornerDomain::Block>& blocks) {
  std::map<double, double> top;
  for (const auto& b : blocks) top[b.left] = std::max(top[b.left], b.top);
  std::vector<samples::CornerDomain::Block> slits;
  for (const auto& [x, y] : top) slits.push_back({x, x, -1, y});
  return slits;
}

}  // namespace fuzz
