#pragma once

#include <algorithm>
#include <cstddef>

#include <plexway/solve/options.hpp>
#include <plexway/solve/probe_table.hpp>

namespace plexway {

/// Where the plain step aims: the share of the centroid in the probe, 1 the centroid itself, 0 the
/// apex. Small and by value, so that a rule has it at hand.
template <class Real>
class ProbeAim {
 public:
  ProbeAim(Visibility policy, const ProbeTable& table)
      : policy_(policy),
        slender_(static_cast<Real>(table.slender)),
        uneven_(static_cast<Real>(table.uneven)),
        low_(static_cast<Real>(table.low)) {
    for (std::size_t i = 0; i < 6; ++i) share_[i] = static_cast<Real>(table.share[i]);
  }

  /// Of a triangle with these edges, `shared` the one that a path comes in by, `height` over it.
  [[nodiscard]] Real share(Real shared, Real second, Real third, Real height) const {
    if (policy_ == Visibility::upper_bound) return Real(0);
    if (policy_ != Visibility::tuned) return Real(1);
    return share_[entry(shared, second, third, height)];
  }

  /// Which entry of the table.
  [[nodiscard]] std::size_t entry(Real shared, Real second, Real third, Real height) const {
    const Real longest = std::max({shared, second, third});
    const Real shortest = std::min({shared, second, third});
    const std::size_t row = longest > slender_ * shared ? 2 : longest > uneven_ * shortest ? 1 : 0;
    return row + (height < low_ * shared ? 3 : 0);
  }

 private:
  Visibility policy_;
  Real slender_, uneven_, low_, share_[6];
};

}  // namespace plexway
