#include "ticks.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace plexway::io {
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
