#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "data/corner_domains.hpp"
#include "fuzz_solve.hpp"

/// A square with rectangles cut out, made of a fuzzer's bytes, and the prism over it.
namespace fuzz {

constexpr int plan_cells = 8;  // along a side, in tiles of four

/// A vertex of the grid.
inline std::array<double, 2> source_of(Choices& choices) {
  const int at = static_cast<int>(choices.below((plan_cells + 1) * (plan_cells + 1)));
  return {static_cast<double>(at % (plan_cells + 1)) / plan_cells,
          static_cast<double>(at / (plan_cells + 1)) / plan_cells};
}

/// No rectangle touches another one or the rim, along which the graph would see through it; none
/// where the source would lie inside one.
inline std::optional<samples::CornerDomain> plan_of(Choices& choices) {
  samples::CornerDomain plan;
  for (int x = 0; x < plan_cells; x += 4)
    for (int y = 0; y < plan_cells; y += 4) {
      const std::uint8_t b = choices.byte();
      if (b % 4 == 0) continue;
      const int left = 1 + b / 4 % 2, bottom = 1 + b / 8 % 2;
      const int right = left + 1 + b / 16 % (3 - left), top = bottom + 1 + b / 32 % (3 - bottom);
      const auto at = [](int k) { return static_cast<double>(k) / plan_cells; };
      plan.blocks.push_back({at(x + left), at(x + right), at(y + bottom), at(y + top)});
    }
  plan.source = source_of(choices);
  for (const auto& b : plan.blocks)
    if (plan.source[0] > b.left - 1e-9 && plan.source[0] < b.right + 1e-9 &&
        plan.source[1] > b.bottom - 1e-9 && plan.source[1] < b.top + 1e-9)
      return {};
  return plan;
}

/// The plan on a grid, its vertices moved.
inline samples::Shape meshed(const samples::CornerDomain& plan, Choices& choices) {
  const double jitter = choices.byte() % 4 * 0.08;  // first, whatever the compiler
  return plan.grid(plan_cells, jitter, choices.byte());
}

/// That, and the distances from its first vertex: the visibility graph of the corners.
struct Cut {
  samples::Shape shape;
  std::vector<Place> places;
  std::vector<double> truth;
};

inline std::optional<Cut> cut_of(Choices& choices) {
  const auto plan = plan_of(choices);
  if (!plan) return {};
  Cut cut;
  cut.shape = meshed(*plan, choices);
  cut.places.assign(cut.shape.points.begin(), cut.shape.points.end());
  cut.truth = plan->distances(cut.shape.points);
  return cut;
}

struct Prism {
  std::vector<Place> places;
  std::vector<std::array<Index, 4>> tets;
  std::vector<Index> below;  // the plan's vertex
};

inline double height_of(Choices& choices) { return 0.1 + choices.byte() / 512.; }

/// One layer over the plan, each prism cut by the order of its vertices' numbers.
inline Prism prism_of(const samples::Shape& plan, double height) {
  Prism prism;
  const auto n = static_cast<Index>(plan.points.size());
  for (const double z : {0., height})
    for (Index v = 0; v < n; ++v) {
      prism.places.push_back({plan.points[v][0], plan.points[v][1], z});
      prism.below.push_back(v);
    }
  for (std::array<Index, 3> f : plan.faces) {
    std::sort(f.begin(), f.end());
    prism.tets.push_back({f[0], f[1], f[2], f[2] + n});
    prism.tets.push_back({f[0], f[1], f[1] + n, f[2] + n});
    prism.tets.push_back({f[0], f[0] + n, f[1] + n, f[2] + n});
  }
  return prism;
}

/// Distances in a prism, of those in its plan: they and heights add up by their squares.
inline std::vector<double> over(const Prism& prism, const std::vector<double>& truth) {
  std::vector<double> distance;
  for (std::size_t v = 0; v < prism.places.size(); ++v)
    distance.push_back(std::hypot(truth[prism.below[v]], prism.places[v][2]));
  return distance;
}

/// A plan as a complex of triangles in the plane takes it.
inline std::vector<double> flattened(const std::vector<Place>& places) {
  std::vector<double> flat;
  for (const Place& p : places) flat.insert(flat.end(), {p[0], p[1]});
  return flat;
}

/// How much a distance may be off, as shares of it.
struct Bounds {
  double short_by, long_by;
};

template <class Distances>
void check_truth(const Distances& d, const std::vector<double>& truth, Bounds bounds) {
  require(d.size() == truth.size(), "one distance a vertex");
  for (std::size_t v = 0; v < truth.size(); ++v) {
    const bool holds = std::isfinite(truth[v]) ? d[v] >= truth[v] * (1 - bounds.short_by) - 1e-12 &&
                                                     d[v] <= truth[v] * (1 + bounds.long_by) + 1e-12
                                               : !std::isfinite(d[v]);
    require(holds, "the distance that is known: vertex " + std::to_string(v) + " at " +
                       std::to_string(d[v]) + ", truth " + std::to_string(truth[v]));
  }
}

}  // namespace fuzz
