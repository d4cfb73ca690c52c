#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "harness.hpp"

/// Errors of fields against truth, a row of `random_plans`.
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

}  // namespace bench
