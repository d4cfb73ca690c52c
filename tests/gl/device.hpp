#pragma once

#include <catch2/catch.hpp>
#include <cmath>
#include <memory>

#include <plexway/error.hpp>

#include "executors/gl/context.hpp"

namespace plexway::testing {

/// A device to test on, or none: then the message says why, and the test returns.
inline std::shared_ptr<detail::gl::Context> device() {
  try {
    return detail::gl::Context::of(-1);
  } catch (const NotBuiltError& error) {
    WARN("skipped, no GL device: " << error.what());
    return nullptr;
  }
}

/// A device whose arithmetic is IEEE single precision, as the processor's: Mesa's llvmpipe. Others
/// may take square roots and quotients with an error of some units in the last place.
inline bool exact(const detail::gl::Context& context) {
  return context.device().renderer.find("llvmpipe") != std::string::npos;
}

/// Relative differences of two fields. fits: infinite and 0 in the same places.
struct Difference {
  double mean = 0, max = 0;
  bool fits = true;
};

template <class One, class Other>
Difference difference(const One& one, const Other& other) {
  Difference d;
  d.fits = one.size() == other.size();
  std::size_t count = 0;
  for (std::size_t v = 0; v < one.size() && d.fits; ++v) {
    const double a = static_cast<double>(one[v]), b = static_cast<double>(other[v]);
    d.fits =
        !std::isnan(a) && !std::isnan(b) && std::isinf(a) == std::isinf(b) && (a == 0) == (b == 0);
    if (!d.fits || a == 0 || std::isinf(a)) continue;
    d.mean += std::abs(b / a - 1);
    d.max = std::max(d.max, std::abs(b / a - 1));
    ++count;
  }
  if (count > 0) d.mean /= static_cast<double>(count);
  return d;
}

}  // namespace plexway::testing
