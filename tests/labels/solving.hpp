#pragma once

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include <plexway/solve.hpp>

#include "complexes/test_meshes.hpp"

namespace plexway::testing {

inline constexpr Visibility visibilities[] = {Visibility::saddles, Visibility::tuned,
                                              Visibility::centroid, Visibility::upper_bound};
inline constexpr Schedule schedules[] = {Schedule::dual_queue, Schedule::fifo, Schedule::priority};

inline std::string name(const PropagateOptions& options) {
  static const char* const policy[] = {"saddles", "tuned", "centroid", "upper_bound"};
  static const char* const order[] = {"dual_queue", "fifo", "priority"};
  return std::string(policy[static_cast<int>(options.visibility)]) + " " +
         order[static_cast<int>(options.schedule)] + (options.vectorised ? "" : " scalar");
}

template <class Real>
std::vector<double> solve(const TriangleMesh<Real>& mesh, const PointSource& source,
                          const PropagateOptions& options = {}) {
  const auto field = plexway::solve(Serial{}, mesh, source, options);
  return {field.distance.begin(), field.distance.end()};
}

/// Solved before and after others in one memory, and without any: the same.
template <class Domain>
void check_again(Workspace<RealOf<Domain>>& workspace, const Domain& domain,
                 std::span<const PointSource> here, std::span<const PointSource> others,
                 const PropagateOptions& options = {}) {
  DistanceField<RealOf<Domain>> first, again;
  plexway::solve(Serial{}, domain, here, options, workspace, first);
  plexway::solve(Serial{}, domain, others, options, workspace, again);
  CAPTURE(name(options));
  CHECK(again.label.size() == (others.size() > 1 ? again.size() : 0));
  plexway::solve(Serial{}, domain, here, options, workspace, again);
  CHECK(again.label.size() == (here.size() > 1 ? again.size() : 0));
  CHECK(first.distance == again.distance);
  CHECK(first.statistics.expansions == again.statistics.expansions);
  CHECK(first.statistics.updates == again.statistics.updates);
  CHECK(first.distance == plexway::solve(Serial{}, domain, here, options).distance);
}

/// Relative errors where the exact distance is neither 0 nor infinite. below <= 0 is the most
/// negative signed one. fits: no NaN, infinite and 0 in the right places.
struct Errors {
  double mean = 0, max = 0, below = 0;
  bool fits = true;
};

template <class Values>
Errors compare(const Values& found, const std::vector<double>& exact) {
  Errors e;
  std::size_t count = 0;
  e.fits = found.size() == exact.size();
  for (std::size_t v = 0; v < exact.size() && e.fits; ++v) {
    const double d = static_cast<double>(found[v]);
    e.fits = !std::isnan(d) && std::isinf(d) == std::isinf(exact[v]) && d >= 0;
    if (!e.fits || exact[v] == 0 || std::isinf(exact[v]) || std::isnan(exact[v])) continue;
    const double error = d / exact[v] - 1;
    e.mean += std::abs(error);
    e.max = std::max(e.max, std::abs(error));
    e.below = std::min(e.below, error);
    ++count;
  }
  e.mean /= static_cast<double>(std::max(count, std::size_t(1)));
  return e;
}

/// Exact distances by a rule over positions.
template <class Rule>
std::vector<double> by_rule(const Surface& s, Rule rule) {
  std::vector<double> exact;
  for (const Position& p : s.positions) exact.push_back(rule(p));
  return exact;
}
inline std::vector<double> straight(const Surface& s, const Position& from) {
  return by_rule(s, [&](const Position& p) {
    return std::hypot(p[0] - from[0], p[1] - from[1], p[2] - from[2]);
  });
}

/// Shortest paths along edges: an upper bound by another way.
inline std::vector<double> along_edges(const Surface& s, Index source) {
  std::vector<double> d(s.positions.size(), std::numeric_limits<double>::infinity());
  d[source] = 0;
  const auto lengths = lengths_of(s);
  for (bool any = true; any;) {
    any = false;
    for (std::size_t f = 0; f < s.faces.size(); ++f)
      for (std::size_t i = 0; i < 3; ++i) {
        double &a = d[s.faces[f][i]], &b = d[s.faces[f][(i + 1) % 3]];
        const double l = lengths[f][i];
        if (a + l < b) b = a + l, any = true;
        if (b + l < a) a = b + l, any = true;
      }
  }
  return d;
}

}  // namespace plexway::testing
