#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include <plexway/paths/path_field.hpp>
#include <plexway/solid/tet_mesh.hpp>

#include "data/crack_plans.hpp"
#include "harness.hpp"
#include "solver.hpp"

/// Prisms over plans with cracks that may join, or end at corners of holes, one source and all
/// vertices, or paths.
namespace bench {

using Distances = std::vector<double>;
using Random = std::mt19937;  // the same numbers with every library

/// From 0 to 1.
inline double share(Random& random) { return static_cast<double>(random()) / 4294967296.; }

/// What fields are off, as a share of the distance.
class PlanErrors {
 public:
  void add(const Distances& found, const Distances& truth) {
    double longest = 0;
    for (std::size_t v = 0; v < truth.size(); ++v) {
      if (!(truth[v] > 1e-12) || !(truth[v] < std::numeric_limits<double>::infinity())) continue;
      const double off = found[v] / truth[v] - 1;
      ++vertices_;
      sum_ += std::abs(off);
      far_ += off > bounds[0];
      off_ += std::abs(off) > 1e-3;
      longest = std::max(longest, off);
      shortest_ = std::min(shortest_, off);
    }
    ++plans_;
    longest_ = std::max(longest_, longest);
    for (std::size_t i = 0; i < bounds.size(); ++i) above_[i] += longest > bounds[i];
  }
  void print(const std::string& name, Table& table) const {
    table.add({{"domain", name},
               {"plans", plans_},
               {"vertices", vertices_},
               {"mean", sum_ / static_cast<double>(std::max<std::size_t>(vertices_, 1))},
               {"long", longest_},
               {"short", shortest_},
               {"off", off_},
               {"far", far_},
               {"above1", above_[0]},
               {"above3", above_[1]},
               {"above5", above_[2]}});
  }

 private:
  static constexpr std::array<double, 3> bounds = {.01, .03, .05};
  std::size_t plans_ = 0, vertices_ = 0, off_ = 0, far_ = 0;
  double sum_ = 0, longest_ = 0, shortest_ = 0;
  std::array<std::size_t, 3> above_{};
};

using Cracks = std::vector<samples::CrackPlan::Crack>;
using Holes = std::vector<samples::CrackPlan::Hole>;
constexpr int crack_cells = 8;

/// A crack of two to five cells from a corner, along x or y; may reach the rim.
inline samples::CrackPlan::Crack random_crack(Random& random, std::array<int, 2> begin,
                                              std::size_t along) {
  samples::CrackPlan::Crack crack = {begin, begin};
  const int far = 2 + static_cast<int>(random() % 4);
  crack.end[along] = std::clamp(begin[along] + (random() % 2 == 0 ? far : -far), 0, crack_cells);
  return crack;
}
inline std::array<int, 2> random_corner(Random& random) {
  const auto one = [&] { return 1 + static_cast<int>(random() % (crack_cells - 1)); };
  const int x = one();
  return {x, one()};
}

/// One crack, or two or three joined to an L, a T or a U; or four anywhere.
inline Cracks random_cracks(Random& random, const std::string& kind) {
  Cracks cracks;
  if (kind == "any") {
    for (int n = 0; n < 4; ++n) {
      const auto begin = random_corner(random);
      cracks.push_back(random_crack(random, begin, random() % 2));
    }
    return cracks;
  }
  const auto begin = random_corner(random);
  const std::size_t along = random() % 2;
  cracks.push_back(random_crack(random, begin, along));
  if (kind == "T") {  // from its middle
    std::array<int, 2> middle = begin;
    middle[along] = (begin[along] + cracks[0].end[along]) / 2;
    cracks.push_back(random_crack(random, middle, 1 - along));
  } else if (kind != "slit") {
    cracks.push_back(random_crack(random, begin, 1 - along));
    if (kind == "U") {
      samples::CrackPlan::Crack third = cracks[1];
      third.begin[along] = third.end[along] = cracks[0].end[along];
      cracks.push_back(third);
    }
  }
  return cracks;
}

/// One or two holes of one to three cells a side, apart from each other.
inline Holes random_holes(Random& random) {
  Holes holes(1 + random() % 2);
  for (auto& hole : holes)
    for (std::size_t i = 0; i < 2; ++i) {
      const int wide = 1 + static_cast<int>(random() % 3);
      hole.begin[i] = 1 + static_cast<int>(random() % (crack_cells - 1 - wide));
      hole.end[i] = hole.begin[i] + wide;
    }
  const auto apart = [&](std::size_t i) {
    return holes[0].end[i] < holes[1].begin[i] || holes[1].end[i] < holes[0].begin[i];
  };
  if (holes.size() > 1 && !apart(0) && !apart(1)) holes.pop_back();
  return holes;
}
/// Cracks that each begin at a corner of a hole, and lead away from it.
inline Cracks cracks_at(Random& random, const Holes& holes) {
  Cracks cracks;
  for (std::size_t n = 1 + random() % 2; n > 0; --n) {
    const auto& hole = holes[random() % holes.size()];
    std::array<int, 2> begin, away;
    for (std::size_t i = 0; i < 2; ++i) {
      const bool low = random() % 2 == 0;
      begin[i] = low ? hole.begin[i] : hole.end[i];
      away[i] = low ? -1 : 1;
    }
    const std::size_t along = random() % 2;
    samples::CrackPlan::Crack crack = {begin, begin};
    const int far = 2 + static_cast<int>(random() % 3);
    crack.end[along] = std::clamp(begin[along] + away[along] * far, 0, crack_cells);
    cracks.push_back(crack);
  }
  return cracks;
}

/// `use(plan, prism, source, truth)` for so many draws from which all is reached.
template <class Use>
void each_cracked(Random& random, std::size_t plans, const std::string& kind, const Use& use) {
  while (plans > 0) {
    const Holes holes = kind == "hole" ? random_holes(random) : Holes{};
    const Cracks cracks = kind == "hole" ? cracks_at(random, holes) : random_cracks(random, kind);
    const double jitter = static_cast<double>(random() % 4) * .08;
    const samples::CrackPlan plan(
        crack_cells, cracks, jitter, [&] { return share(random); }, holes);
    const auto solid = plan.solid(.1 + share(random) / 2);
    const auto floor = static_cast<plexway::Index>(plan.places().size());
    plexway::Index source = 0;
    do source = static_cast<plexway::Index>(random() % floor);
    while (plan.on_crack(source));
    const Distances flat = plan.distances(source);
    if (std::any_of(flat.begin(), flat.end(), [](double d) { return !std::isfinite(d); })) continue;
    Distances truth;
    for (std::size_t v = 0; v < solid.places.size(); ++v)
      truth.push_back(std::hypot(flat[v % floor], solid.places[v][2]));
    use(plan, solid, source, truth);
    --plans;
  }
}

inline void solve_cracked(Random& random, std::size_t plans, const std::string& kind,
                          PlanErrors& errors) {
  each_cracked(random, plans, kind,
               [&](const auto&, const auto& prism, plexway::Index source, const Distances& truth) {
                 const plexway::TetMesh<double> solid(prism.places, prism.tets);
                 errors.add(distances(solid, plexway::PointSource::at(source)), truth);
               });
}

/// Lengths of paths from four vertices a plan.
inline void trace_cracked(Random& random, std::size_t plans, const std::string& kind,
                          PlanErrors& errors) {
  each_cracked(random, plans, kind,
               [&](const auto&, const auto& prism, plexway::Index source, const Distances& truth) {
                 const plexway::TetMesh<double> solid(prism.places, prism.tets);
                 plexway::PathField field(solid, prism.places);
                 field.solve(plexway::Serial{}, plexway::PointSource::at(source));
                 Distances found, exact;
                 for (int n = 0; n < 4; ++n) {
                   const auto v = static_cast<plexway::Index>(random() % prism.places.size());
                   found.push_back(field.trace(v).length);
                   exact.push_back(truth[v]);
                 }
                 errors.add(found, exact);
               });
}

}  // namespace bench
