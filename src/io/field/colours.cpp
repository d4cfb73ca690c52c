#include "io/field/colours.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include <plexway/error.hpp>

namespace plexway::io {
namespace {

using Anchors = std::array<std::uint32_t, 33>;

constexpr Anchors viridis = {0x440154, 0x470d60, 0x48186a, 0x482374, 0x472d7b, 0x453681, 0x424086,
                             0x3f4989, 0x3b528b, 0x375a8d, 0x33638d, 0x2f6a8e, 0x2c728e, 0x297a8e,
                             0x26818e, 0x23898e, 0x21908c, 0x1f988b, 0x1f9f88, 0x21a685, 0x28ae80,
                             0x31b57b, 0x3ebc74, 0x4cc26c, 0x5dc963, 0x6ece58, 0x82d34c, 0x96d83f,
                             0xabdc32, 0xc0df24, 0xd5e21a, 0xeae51a, 0xfde725};
constexpr Anchors magma = {0x000004, 0x030311, 0x0a0822, 0x130d33, 0x1d1146, 0x28115a, 0x36106a,
                           0x430f76, 0x50127c, 0x5d177f, 0x691c81, 0x762181, 0x822681, 0x8f2a81,
                           0x9c2e7f, 0xa9327d, 0xb63779, 0xc33b75, 0xcf4170, 0xdb486a, 0xe65163,
                           0xee5c5e, 0xf5695c, 0xf9785d, 0xfb8761, 0xfd9668, 0xfea571, 0xfeb47b,
                           0xfec387, 0xfed194, 0xfde0a2, 0xfceeb0, 0xfcfdbf};
constexpr Anchors cividis = {0x00224e, 0x00285b, 0x002e6a, 0x043371, 0x1a386f, 0x273e6e, 0x32436d,
                             0x3b496c, 0x434e6c, 0x4b546c, 0x52596d, 0x5a5f6e, 0x61656f, 0x686a71,
                             0x6f7073, 0x757676, 0x7c7b78, 0x848179, 0x8b8778, 0x938d78, 0x9b9376,
                             0xa39a75, 0xaba072, 0xb3a670, 0xbbad6c, 0xc3b469, 0xccba64, 0xd4c15f,
                             0xddc958, 0xe6d051, 0xefd748, 0xf8df3c, 0xfee838};

constexpr std::array<std::string_view, 3> map_names = {"viridis", "magma", "cividis"};
constexpr std::array<const Anchors*, 3> maps = {&viridis, &magma, &cividis};

double channel(std::uint32_t colour, std::size_t c) {
  return static_cast<double>((colour >> (16 - 8 * c)) & 255u);
}

}  // namespace

std::span<const std::string_view> ColourMap::names() { return map_names; }

ColourMap::ColourMap(std::string_view name) {
  std::size_t which = 0;
  while (which < maps.size() && map_names[which] != name) ++which;
  if (which == maps.size())
    throw UsageError("there is no colour map '" + std::string(name) +
                     "': choose one of viridis, magma, cividis");
  const Anchors& anchors = *maps[which];
  for (std::size_t i = 0; i < table_.size(); ++i) {
    const double t = static_cast<double>(i * (anchors.size() - 1)) / 255;
    const std::size_t k = i == 255 ? anchors.size() - 2 : static_cast<std::size_t>(t);
    const double share = t - static_cast<double>(k);
    for (std::size_t c = 0; c < 3; ++c)
      table_[i][c] = static_cast<std::uint8_t>(
          std::lround((1 - share) * channel(anchors[k], c) + share * channel(anchors[k + 1], c)));
  }
}

Rgb ColourMap::operator()(double value, double largest) const {
  if (!std::isfinite(value)) return unreached_grey;
  const double t = largest > 0 ? std::fmin(std::fmax(value / largest, 0.0), 1.0) : 0.0;
  return table_[static_cast<std::size_t>(std::lround(t * 255))];
}

namespace {

// 1, 2 or 5, and the power of ten.
std::pair<int, int> round_step(double rough) {
  int power = static_cast<int>(std::floor(std::log10(rough)));
  const double mantissa = rough / std::pow(10.0, power);
  if (mantissa > 7.07) return {1, power + 1};
  return {mantissa > 3.16 ? 5 : mantissa > 1.42 ? 2 : 1, power};
}

std::string written(double value, int power, bool scientific) {
  char text[40];
  if (scientific)
    std::snprintf(
        text, sizeof text, "%.*e",
        value == 0
            ? 0
            : std::clamp(static_cast<int>(std::floor(std::log10(std::abs(value)) + 1e-9)) - power,
                         0, 15),
        value);
  else
    std::snprintf(text, sizeof text, "%.*f", std::max(0, -power), value);
  return text;
}

}  // namespace

double Ticks::fine_step() const {
  const bool fives = round_step(step).first == 5;
  return step / (fives ? 5 : 4);
}

Ticks ticks(double low, double high, std::size_t wanted) {
  Ticks result;
  const auto rounded =
      round_step((high - low) / static_cast<double>(std::max<std::size_t>(wanted, 1)));
  const auto digit = rounded.first;
  const auto power = rounded.second;
  // Whole numbers are divided by powers of ten, so that 3 steps of 0.1 are 0.3.
  const double large = std::max(std::abs(low), std::abs(high));
  const bool scientific = large >= 1e5 || power < -4;
  const double ten = std::pow(10.0, std::abs(power));
  const auto times_step = [&](double n) { return power < 0 ? n * digit / ten : n * digit * ten; };
  result.step = times_step(1);
  const double slack = 1e-9 * (high - low);
  for (double n = std::ceil((low - slack) / result.step); times_step(n) <= high + slack; ++n) {
    const double value = n == 0 ? 0 : times_step(n);
    result.at.push_back(value);
    result.label.push_back(value == 0 ? "0" : written(value, power, scientific));
    if (result.at.size() > 50) break;
  }
  return result;
}

}  // namespace plexway::io
