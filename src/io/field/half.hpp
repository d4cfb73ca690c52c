#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

namespace plexway::io {

/// IEEE 754 half precision: 10 bits of fraction, at most 65504.
inline constexpr double largest_half = 65504;

/// The nearest half, ties to even; beyond the largest, and for infinity, infinity. Not for NaN.
inline std::uint16_t to_half(double value) {
  const std::uint16_t sign = std::signbit(value) ? 0x8000U : 0;
  const double size = std::abs(value);
  if (size >= 65520)
    return static_cast<std::uint16_t>(sign | 0x7C00U);  // rounds beyond the largest
  // In steps of what the last bit is worth there; std::nearbyint rounds ties to even.
  const int exponent = size < 0x1p-14 ? -14 : std::ilogb(size);
  const double steps = std::nearbyint(std::ldexp(size, 10 - exponent));
  // A fraction that rounds up to 2048 carries into the exponent, as it should.
  const auto bits = static_cast<std::uint32_t>(exponent + 14) * 1024U;
  return static_cast<std::uint16_t>(sign | (bits + static_cast<std::uint32_t>(steps)));
}

inline double from_half(std::uint16_t half) {
  const double sign = (half & 0x8000U) != 0 ? -1 : 1;
  const int exponent = (half >> 10) & 31, fraction = half & 1023;
  if (exponent == 31) return fraction == 0 ? sign * HUGE_VAL : std::nan("");
  if (exponent == 0) return sign * std::ldexp(fraction, -24);
  return sign * std::ldexp(1024 + fraction, exponent - 25);
}

}  // namespace plexway::io
