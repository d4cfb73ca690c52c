#pragma once

#include <plexway/propagate/options.hpp>

namespace plexway::testing {

/// The default options but for the accuracy.
inline PropagateOptions at(Accuracy accuracy) {
  PropagateOptions options;
  options.accuracy = accuracy;
  return options;
}

}  // namespace plexway::testing
