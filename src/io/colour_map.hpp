#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace plexway::io {

using Rgb = std::array<std::uint8_t, 3>;

inline constexpr Rgb unreached_grey = {128, 128, 128};

/// sRGB of a colour given by its Oklab lightness, chroma and hue in radians; clamped to the gamut.
/// Source: B. Ottosson, "A perceptual color space for image processing", 2020.
inline Rgb oklch_to_srgb(double lightness, double chroma, double hue) {
  const double a = chroma * std::cos(hue);
  const double b = chroma * std::sin(hue);
  const auto cube = [](double v) { return v * v * v; };
  const double l = cube(lightness + 0.3963377774 * a + 0.2158037573 * b);
  const double m = cube(lightness - 0.1055613458 * a - 0.0638541728 * b);
  const double s = cube(lightness - 0.0894841775 * a - 1.2914855480 * b);
  const auto encode = [](double linear) {
    const double v = std::fmin(std::fmax(linear, 0.0), 1.0);
    const double gamma = v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
    return static_cast<std::uint8_t>(std::lround(255 * gamma));
  };
  return {encode(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
          encode(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
          encode(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s)};
}

/// From dark violet over teal to light yellow, with lightness growing evenly: equal steps of the
/// value look equally far apart, in grey print too.
class ColourMap {
 public:
  ColourMap() {
    constexpr double degree = 3.14159265358979323846 / 180;
    for (std::size_t i = 0; i < table_.size(); ++i) {
      const double t = static_cast<double>(i) / static_cast<double>(table_.size() - 1);
      table_[i] = oklch_to_srgb(0.27 + 0.64 * t, 0.12 + 0.05 * t * t, (305 - 200 * t) * degree);
    }
  }

  /// The colour of `value` between 0 and `largest`; grey when it is not finite.
  Rgb operator()(double value, double largest) const {
    if (!std::isfinite(value)) return unreached_grey;
    const double t = largest > 0 ? std::fmin(std::fmax(value / largest, 0.0), 1.0) : 0.0;
    return table_[static_cast<std::size_t>(std::lround(t * 255))];
  }

 private:
  std::array<Rgb, 256> table_{};
};

}  // namespace plexway::io
