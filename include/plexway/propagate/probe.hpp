#pragma once

#include <algorithm>

#include <plexway/propagate/options.hpp>

namespace plexway {

/// Where on the way from apex to centroid the tuned policy aims, by the triangle's shape over the
/// shared edge. Thresholds and values are the published ones (GSP 2021, section 4), found there by
/// evolution. Since a height is never above the longest edge, and an edge five times shorter than
/// the longest has a shortest edge at least that short, only entries 8, 10, 11, 12, 14 and 15
/// occur.
template <class Real>
Real tuned_probe(Real shared, Real second, Real third, Real height) {
  constexpr Real table[16] = {Real(.320991), Real(.446887),  Real(.595879),  Real(.270094),
                              Real(.236679), Real(.159685),  Real(.0872932), Real(.434132),
                              Real(1.0),     Real(.726262),  Real(.0635997), Real(.0515979),
                              Real(.56903),  Real(.0447586), Real(.0612103), Real(.718198)};
  const Real longest = std::max({shared, second, third});
  const Real shortest = std::min({shared, second, third});
  const int index = (longest > Real(5.1424) * shared) + 2 * (longest > Real(4.20638) * shortest) +
                    4 * (height < Real(0.504201) * shared) + 8 * (height < Real(2.84918) * longest);
  return table[index];
}

/// The share of the centroid in the probe: 1 the centroid itself, 0 the apex.
template <class Real>
Real probe_share(Visibility policy, Real shared, Real second, Real third, Real height) {
  if (policy == Visibility::upper_bound) return Real(0);
  if (policy == Visibility::tuned) return tuned_probe(shared, second, third, height);
  return Real(1);
}

}  // namespace plexway
