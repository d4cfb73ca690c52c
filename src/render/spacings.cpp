#include "spacings.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "camera.hpp"

namespace plexway::render {
namespace {

constexpr std::size_t leaf = 8;

// A k-d tree in the order of its points: each range is cut in its middle.
class Tree {
 public:
  explicit Tree(std::span<const Point> points)
      : points_(points.begin(), points.end()), cuts_(points.size()) {
    std::sort(points_.begin(), points_.end());
    points_.erase(std::unique(points_.begin(), points_.end()), points_.end());
    split(0, points_.size());
  }

  [[nodiscard]] std::size_t places() const { return points_.size(); }

  /// The squares of the distances to the four nearest other places, in order; infinite if none.
  [[nodiscard]] std::array<double, 4> nearest(const Point& p) const {
    std::array<double, 4> found{};
    found.fill(std::numeric_limits<double>::infinity());
    look(p, 0, points_.size(), found);
    return found;
  }

 private:
  struct Cut {
    double at = 0;
    std::size_t axis = 0;
  };

  void split(std::size_t begin, std::size_t end) {
    if (end - begin <= leaf) return;
    Point low = points_[begin], high = low;
    for (std::size_t i = begin; i < end; ++i)
      for (std::size_t k = 0; k < 3; ++k) {
        low[k] = std::min(low[k], points_[i][k]);
        high[k] = std::max(high[k], points_[i][k]);
      }
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k)
      if (high[k] - low[k] > high[axis] - low[axis]) axis = k;
    const std::size_t middle = begin + (end - begin) / 2;
    const auto at = [&](std::size_t i) { return points_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(begin), at(middle), at(end),
                     [axis](const Point& a, const Point& b) { return a[axis] < b[axis]; });
    cuts_[middle] = {points_[middle][axis], axis};
    split(begin, middle);
    split(middle, end);
  }

  void look(const Point& p, std::size_t begin, std::size_t end,
            std::array<double, 4>& found) const {
    if (end - begin > leaf) {
      const std::size_t middle = begin + (end - begin) / 2;
      const double over = p[cuts_[middle].axis] - cuts_[middle].at;
      if (over < 0)
        look(p, begin, middle, found);
      else
        look(p, middle, end, found);
      if (over * over > found[3]) return;
      if (over < 0)
        look(p, middle, end, found);
      else
        look(p, begin, middle, found);
      return;
    }
    for (std::size_t i = begin; i < end; ++i) {
      const Point d = minus(points_[i], p);
      double square = dot(d, d);
      if (!(square > 0) || !(square < found[3])) continue;
      for (double& other : found)
        if (square < other) std::swap(square, other);
    }
  }

  std::vector<Point> points_;
  std::vector<Cut> cuts_;  // of the range with this middle
};

}  // namespace

std::vector<double> spacings(std::span<const Point> points) {
  const Tree tree(points);
  if (tree.places() < 2) return std::vector<double>(points.size(), 0.1);
  const std::size_t wanted = std::min<std::size_t>(tree.places() - 1, 4);
  std::vector<double> found;
  found.reserve(points.size());
  for (const Point& p : points) {
    double distance = std::sqrt(tree.nearest(p)[wanted - 1]);
    if (!std::isfinite(distance)) distance = 0;  // the squares of such sizes are no numbers
    found.push_back(distance);
  }
  std::vector<double> copy = found;
  const auto middle = copy.begin() + static_cast<std::ptrdiff_t>(copy.size() / 2);
  std::nth_element(copy.begin(), middle, copy.end());
  for (double& f : found) f = std::clamp(f, *middle / 2, *middle * 2);
  return found;
}

}  // namespace plexway::render
