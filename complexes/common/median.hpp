#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace plexway::detail {

/// The value in the middle, or the upper one of two; reorders what it is given, which is not empty.
inline double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace plexway::detail
