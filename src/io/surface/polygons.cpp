// Polygons into triangles. Ears: G. H. Meisters, Polygons have ears, Amer. Math. Monthly 82, 1975;
// normals of bent polygons: M. E. Newell, in Sutherland, Sproull, Schumacker, ACM Comput. Surv. 6,
// 1974.

#include "io/surface/polygons.hpp"

#include <algorithm>
#include <cmath>
#include <deque>

namespace plexway::io {
namespace {

using Point = std::array<double, 3>;
using Plane = std::array<double, 2>;

// Twice the area of a triangle, above 0 where it turns left.
double turn(const Plane& a, const Plane& b, const Plane& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

double squared_distance(const Point& a, const Point& b) {
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
  return sum;
}

// Its corners without the coordinate along which its normal is longest, so that it turns left.
std::vector<Plane> flattened(std::span<const Point> at, std::span<const std::uint32_t> corners) {
  Point normal{};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Point& p = at[corners[i]];
    const Point& q = at[corners[(i + 1) % corners.size()]];
    const Point& o = at[corners[0]];  // near, so that far from 0 nothing is lost
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t u = (k + 1) % 3, v = (k + 2) % 3;
      normal[k] += (p[u] - q[u]) * ((p[v] - o[v]) + (q[v] - o[v]));
    }
  }
  std::size_t k = 0;
  for (std::size_t i = 1; i < 3; ++i)
    if (std::abs(normal[i]) > std::abs(normal[k])) k = i;
  std::size_t u = (k + 1) % 3, v = (k + 2) % 3;
  if (normal[k] < 0) std::swap(u, v);
  std::vector<Plane> flat;
  for (const std::uint32_t c : corners) flat.push_back({at[c][u], at[c][v]});
  return flat;
}

class Ears {
 public:
  Ears(std::span<const std::uint32_t> corners, std::vector<Plane> flat)
      : corners_(corners), flat_(std::move(flat)), before_(size()), after_(size()) {
    for (std::size_t i = 0; i < size(); ++i) {
      before_[i] = (i + size() - 1) % size();
      after_[i] = (i + 1) % size();
    }
    // What may lie in an ear is no convex corner.
    for (std::size_t i = 0; i < size(); ++i)
      if (!(corner_turn(i) > 0)) in_the_way_.push_back(i);
    std::sort(in_the_way_.begin(), in_the_way_.end(),
              [&](std::size_t a, std::size_t b) { return flat_[a][0] < flat_[b][0]; });
  }

  void clip(std::vector<std::array<std::uint32_t, 3>>& triangles) {
    // Only the neighbours of an ear can become ears when it goes. A list without any is looked
    // through once more; then the rest crosses itself or is flat, and no cut is better than
    // another.
    std::deque<std::size_t> next;
    std::size_t left = size(), at = 0, left_before = size() + 1;
    for (; left > 3 || is_gone(at);) {
      if (next.empty()) {
        for (std::size_t i = 0; i < size(); ++i)
          if (!is_gone(i)) next.push_back(i);
        any_is_ear_ = left == left_before;
        left_before = left;
      }
      at = next.front();
      next.pop_front();
      if (left == 3 || is_gone(at) || !is_ear(at)) continue;
      triangles.push_back({corners_[before_[at]], corners_[at], corners_[after_[at]]});
      after_[before_[at]] = after_[at];
      before_[after_[at]] = before_[at];
      next.push_back(before_[at]);
      next.push_back(after_[at]);
      --left;
    }
    triangles.push_back({corners_[before_[at]], corners_[at], corners_[after_[at]]});
  }

 private:
  [[nodiscard]] std::size_t size() const { return corners_.size(); }
  [[nodiscard]] double corner_turn(std::size_t i) const {
    return turn(flat_[before_[i]], flat_[i], flat_[after_[i]]);
  }

  [[nodiscard]] bool is_gone(std::size_t i) const { return after_[before_[i]] != i; }

  [[nodiscard]] bool is_ear(std::size_t i) const {
    if (any_is_ear_) return true;
    if (!(corner_turn(i) > 0)) return false;
    const Plane &a = flat_[before_[i]], &b = flat_[i], &c = flat_[after_[i]];
    const auto [low, high] = std::minmax({a[0], b[0], c[0]});
    auto other = std::lower_bound(in_the_way_.begin(), in_the_way_.end(), low,
                                  [&](std::size_t j, double x) { return flat_[j][0] < x; });
    for (; other != in_the_way_.end() && flat_[*other][0] <= high; ++other) {
      const std::size_t j = *other;
      const Plane& p = flat_[j];
      if (is_gone(j) || p == a || p == c) continue;  // or at its foot
      if (turn(a, b, p) < 0 || turn(b, c, p) < 0 || turn(c, a, p) < 0) continue;
      if (p != b) return false;
      // The polygon comes back to the ear's tip: does it go on into the ear?
      for (const std::size_t n : {before_[j], after_[j]})
        if (j != i && turn(a, b, flat_[n]) > 0 && turn(b, c, flat_[n]) > 0) return false;
    }
    return true;
  }

  std::span<const std::uint32_t> corners_;
  std::vector<Plane> flat_;
  std::vector<std::size_t> before_, after_, in_the_way_;
  bool any_is_ear_ = false;
};

}  // namespace

void cut_polygon(std::span<const Point> positions, std::span<const std::uint32_t> corners,
                 std::vector<std::array<std::uint32_t, 3>>& triangles) {
  std::vector<std::uint32_t> own;
  for (const std::uint32_t v : corners)
    if (own.empty() || own.back() != v) own.push_back(v);
  while (own.size() > 1 && own.front() == own.back()) own.pop_back();
  if (own.size() < 3) return triangles.push_back({corners[0], own.back(), own.back()});
  if (own.size() == 3) return triangles.push_back({own[0], own[1], own[2]});
  std::vector<Plane> flat = flattened(positions, own);
  const auto left = [&](std::size_t a, std::size_t b, std::size_t c) {
    return turn(flat[a], flat[b], flat[c]) > 0;
  };
  if (own.size() == 4) {
    const auto length = [&](std::size_t a, std::size_t b) {
      return squared_distance(positions[own[a]], positions[own[b]]);
    };
    const bool first = left(0, 1, 2) && left(0, 2, 3), second = left(1, 2, 3) && left(1, 3, 0);
    // To the last bits alike, those of a square do not matter.
    const bool shorter = length(1, 3) < (1 - 1e-12) * length(0, 2);
    if (first == second ? !shorter : first) {
      triangles.push_back({own[0], own[1], own[2]});
      triangles.push_back({own[0], own[2], own[3]});
    } else {
      triangles.push_back({own[0], own[1], own[3]});
      triangles.push_back({own[1], own[2], own[3]});
    }
    return;
  }
  bool convex = true;
  for (std::size_t i = 0; i < own.size() && convex; ++i)
    convex = left(i, (i + 1) % own.size(), (i + 2) % own.size());
  for (std::size_t i = 2; i < own.size() && convex; ++i) convex = left(0, i - 1, i);
  if (!convex) return Ears(own, std::move(flat)).clip(triangles);
  for (std::size_t i = 2; i < own.size(); ++i) triangles.push_back({own[0], own[i - 1], own[i]});
}

std::size_t Faces::cut(std::span<const Point> positions) {
  if (polygons_.empty()) return 0;
  std::vector<std::array<std::uint32_t, 3>> all;
  all.reserve(triangles_.size());
  std::size_t from = 0;
  std::vector<std::uint32_t> corners;
  const auto copy_to = [&](std::size_t end) {
    all.insert(all.end(), triangles_.begin() + static_cast<std::ptrdiff_t>(from),
               triangles_.begin() + static_cast<std::ptrdiff_t>(end));
    from = end;
  };
  for (const Polygon& polygon : polygons_) {
    copy_to(polygon.first);
    corners = {triangles_[from][0], triangles_[from][1]};
    for (; from < polygon.first + polygon.corners - 2; ++from)
      corners.push_back(triangles_[from][2]);
    cut_polygon(positions, corners, all);
  }
  copy_to(triangles_.size());
  triangles_ = std::move(all);
  return polygons_.size();
}

}  // namespace plexway::io
