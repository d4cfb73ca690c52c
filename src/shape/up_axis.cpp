#include "shape/up_axis.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace plexway {
namespace {

struct Extents {
  std::array<double, 3> low, high;

  Extents() {
    low.fill(std::numeric_limits<double>::infinity());
    high.fill(-std::numeric_limits<double>::infinity());
  }
  void add(const std::array<double, 3>& p) {
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], p[k]);
      high[k] = std::max(high[k], p[k]);
    }
  }
  [[nodiscard]] double size(std::size_t k) const { return high[k] - low[k]; }
};

// How widely a part is spread across axis k, as a share of the whole.
double spread(const Extents& part, const Extents& whole, std::size_t k) {
  const std::size_t a = (k + 1) % 3, b = (k + 2) % 3;
  return part.size(a) / whole.size(a) * (part.size(b) / whole.size(b));
}

}  // namespace

char probable_up(const AnyShape& shape) {
  const auto positions = shape.positions();
  if (positions.empty()) return 'z';
  Extents whole;
  for (const auto& p : positions) whole.add(p);
  const std::array<double, 3> size = {whole.size(0), whole.size(1), whole.size(2)};
  const auto least =
      static_cast<std::size_t>(std::min_element(size.begin(), size.end()) - size.begin());
  const double next = std::min(size[(least + 1) % 3], size[(least + 2) % 3]);
  if (!(size[least] > 1e-3 * next)) return 'z';  // a sheet or a line is seen from where it shows
  constexpr double flat = 0.3, clear = 0.15, clearer = 0.1;
  if (size[least] < flat * next) return least == 1 ? 'y' : 'z';

  constexpr double slab = 0.02;  // of the extent
  std::array<Extents, 3> lower, upper;
  for (const auto& p : positions)
    for (std::size_t k = 0; k < 3; ++k) {
      if (p[k] <= whole.low[k] + slab * size[k]) lower[k].add(p);
      if (p[k] >= whole.high[k] - slab * size[k]) upper[k].add(p);
    }
  std::array<double, 3> foot{};
  for (std::size_t k = 0; k < 3; ++k)
    foot[k] = spread(lower[k], whole, k) - spread(upper[k], whole, k);
  const double others = std::max(std::abs(foot[0]), std::abs(foot[2]));
  return foot[1] > clear && foot[1] > others + clearer ? 'y' : 'z';
}

}  // namespace plexway
