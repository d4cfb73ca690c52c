#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include <plexway/common/ids.hpp>

#include "data/corner_domains.hpp"

namespace plexway::testing {

/// One layer over a plan of eight cells a side whose slits are closed.
struct Cracked {
  samples::CornerDomain plan;
  std::vector<samples::Point> beside;  // of the floor, lips 2e-9 apart
  std::vector<std::array<double, 3>> places;
  std::vector<std::array<Index, 4>> tets;
  std::vector<char> on_lip;  // of the floor

  Cracked(samples::CornerDomain slits, double jitter, std::uint64_t seed, double height)
      : plan(std::move(slits)) {
    samples::Shape flat = plan.grid(8, jitter, seed);
    beside = flat.points;
    on_lip.assign(beside.size(), 0);
    for (std::size_t v = 0; v < beside.size(); ++v)
      for (const auto& b : plan.blocks) {
        const double off = beside[v][0] - b.left;
        if (b.left != b.right || off == 0 || std::abs(off) > 1e-12) continue;
        beside[v][0] = b.left + (off > 0 ? 1e-9 : -1e-9);
        flat.points[v][0] = b.left;
        on_lip[v] = 1;
      }
    const auto n = floor();
    for (const double z : {0., height})
      for (Index v = 0; v < n; ++v) places.push_back({flat.points[v][0], flat.points[v][1], z});
    for (std::array<Index, 3> f : flat.faces) {
      std::sort(f.begin(), f.end());
      tets.push_back({f[0], f[1], f[2], f[2] + n});
      tets.push_back({f[0], f[1], f[1] + n, f[2] + n});
      tets.push_back({f[0], f[0] + n, f[1] + n, f[2] + n});
    }
  }

  [[nodiscard]] Index floor() const { return static_cast<Index>(beside.size()); }

  /// From a place over the floor: heights and distances add up by their squares.
  [[nodiscard]] std::vector<double> exact(const samples::Point& from) const {
    std::vector<samples::Point> points = {{from[0], from[1], 0}};
    points.insert(points.end(), beside.begin(), beside.end());
    const std::vector<double> truth = plan.distances(points);
    std::vector<double> distance(places.size());
    for (std::size_t v = 0; v < places.size(); ++v)
      distance[v] = std::hypot(truth[1 + v % beside.size()], places[v][2] - from[2]);
    return distance;
  }
};

inline const samples::CornerDomain one_slit = {"", {{.5, .5, -1, .5}}, {.25, .125}};
inline const samples::CornerDomain two_slits = {
    "", {{.25, .25, -1, .75}, {.625, .625, -1, .375}}, {.125, .25}};

}  // namespace plexway::testing
