#pragma once

#include <limits>
#include <span>

#include <plexway/error.hpp>
#include <plexway/solve/options.hpp>
#include <plexway/source/point_source.hpp>

#include "executors/threads/offers.hpp"

namespace plexway {

/// Throws UsageError for more sources than a team tells apart.
inline void check_ties(std::span<const PointSource> sources) {
  if (sources.size() >= OfferTie::limit) throw UsageError("too many sources");
}

/// The width of the limit in the unit inside, where `edge` is what counts as an edge.
template <class Real>
Real step_of(const PropagateOptions& options, double edge = 1) {
  return options.schedule == Schedule::fifo ? std::numeric_limits<Real>::infinity()
                                            : static_cast<Real>(options.step * edge);
}

}  // namespace plexway
