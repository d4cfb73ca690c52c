#pragma once

#include <cmath>
#include <vector>

#include <plexway/executors/serial_pairs.hpp>

#include "complex/sampled_clouds.hpp"

namespace plexway::testing {

inline constexpr double never = std::numeric_limits<double>::infinity();

template <class Real>
std::vector<double> solve(const PointPairs<Real>& pairs, const PointSource& source,
                          const PropagateOptions& options = {}) {
  const auto field = propagate(Serial{}, pairs, source, options);
  return {field.distance.begin(), field.distance.end()};
}

/// Mean relative error of finite distances; of those beyond three spacings the largest, and the
/// share that is off by more than 2 %.
struct CloudErrors {
  double mean = 0, max = 0, off = 0;
  std::size_t unreached = 0;
};

inline CloudErrors compare(const std::vector<double>& found, const std::vector<double>& truth,
                           double spacing) {
  CloudErrors e;
  std::size_t count = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    e.unreached += std::isinf(found[i]);
    if (!std::isfinite(found[i]) || truth[i] < 1e-6 * spacing) continue;
    const double error = std::abs(found[i] / truth[i] - 1);
    e.mean += error;
    ++count;
    if (truth[i] <= 3 * spacing) continue;
    e.max = std::max(e.max, error);
    e.off += error > .02;
  }
  e.mean /= static_cast<double>(count);
  e.off /= static_cast<double>(count);
  return e;
}

}  // namespace plexway::testing
