#pragma once

#include <string>
#include <vector>

namespace plexway::io {

/// Round numbers along a scale.
struct Ticks {
  double step = 1;                 ///< 1, 2 or 5 times a power of ten
  std::vector<double> at;          ///< multiples of it, within the scale
  std::vector<std::string> label;  ///< with as many digits as tell them apart

  /// A step for isolines: a quarter or a fifth of `step`, round as well.
  [[nodiscard]] double fine_step() const;
};

/// About `wanted` of them between low and high, low < high, both finite.
Ticks ticks(double low, double high, std::size_t wanted);

}  // namespace plexway::io
