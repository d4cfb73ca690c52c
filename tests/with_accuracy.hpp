#pragma once

#include <plexway/solve/options.hpp>

namespace plexway::testing {

/// The default options but for the accuracy.
inline PropagateOptions at(Accuracy accuracy) {
  PropagateOptions options;
  options.accuracy = accuracy;
  return options;
}

/// For what is tested of labels: their bits, orders and repairs, and where they are exact.
inline PropagateOptions by_labels() { return at(Accuracy::fast()); }

}  // namespace plexway::testing
