#include <plexway/complex/distinct_points.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

#include <plexway/error.hpp>

#include "complex/simplex_order.hpp"

namespace plexway {
namespace {

using Points = std::span<const std::array<double, 3>>;

struct Keyed {
  std::uint64_t key;
  Index point;
};

// A cell of the Morton curve for each point; equal points share one.
std::vector<Keyed> along_curve_with_keys(Points points) {
  std::array<double, 3> low{}, high{};
  low.fill(std::numeric_limits<double>::infinity());
  high.fill(-std::numeric_limits<double>::infinity());
  for (const auto& p : points)
    for (std::size_t d = 0; d < 3; ++d) {
      low[d] = std::min(low[d], p[d]);
      high[d] = std::max(high[d], p[d]);
    }
  double width = 0;  // halves: no overflow near 1e308
  for (std::size_t d = 0; d < 3; ++d) width = std::max(width, high[d] / 2 - low[d] / 2);
  constexpr double cells = 2097151;
  std::vector<Keyed> keyed(points.size());
  for (Index i = 0; i < points.size(); ++i) {
    std::uint64_t key = 0;
    for (std::size_t d = 0; d < 3 && width > 0; ++d) {
      const double share = (points[i][d] / 2 - low[d] / 2) / width;
      key |= every_third_bit(static_cast<std::uint64_t>(share * cells)) << d;
    }
    keyed[i] = {key, i};
  }
  std::sort(keyed.begin(), keyed.end(), [](const Keyed& a, const Keyed& b) {
    return a.key != b.key ? a.key < b.key : a.point < b.point;
  });
  return keyed;
}

}  // namespace

DistinctPoints distinct_points(Points points) {
  if (points.size() >= none) throw InputError("more than 4294967294 points");
  for (std::size_t i = 0; i < points.size(); ++i)
    for (const double x : points[i])
      if (!std::isfinite(x))
        throw InputError("point " + std::to_string(i) +
                         ": a coordinate is not finite; remove such points first");
  std::vector<Keyed> keyed = along_curve_with_keys(points);
  DistinctPoints result;
  result.first.resize(points.size());
  result.order.reserve(points.size());
  for (std::size_t begin = 0, end = 0; begin < keyed.size(); begin = end) {
    for (end = begin + 1; end < keyed.size() && keyed[end].key == keyed[begin].key;) ++end;
    const auto at = [&](std::size_t i) -> const auto& { return points[keyed[i].point]; };
    if (end - begin > 1)
      std::sort(keyed.begin() + static_cast<std::ptrdiff_t>(begin),
                keyed.begin() + static_cast<std::ptrdiff_t>(end),
                [&](const Keyed& a, const Keyed& b) {
                  const auto &p = points[a.point], &q = points[b.point];
                  return p != q ? p < q : a.point < b.point;
                });
    for (std::size_t i = begin; i < end; ++i) {
      const Index point = keyed[i].point;
      const bool twin = i > begin && at(i) == at(i - 1);
      result.first[point] = twin ? result.first[keyed[i - 1].point] : point;
      if (!twin) result.order.push_back(point);
    }
  }
  return result;
}

DistinctPoints without_near_twins(Points points, const Neighbours& neighbours,
                                  const DistinctPoints& places) {
  constexpr double gap = 1e-4;
  constexpr std::size_t most = 3;  // one in so many neighbours
  std::vector<Index> parent(points.size());
  std::iota(parent.begin(), parent.end(), Index{0});
  const auto root = [&](Index i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  std::vector<std::pair<double, Index>> row;
  bool any = false;
  for (const Index i : places.order) {
    row.clear();
    double nearest = std::numeric_limits<double>::infinity(), farthest = 0;
    for (const Index j : neighbours.around(i)) {
      if (places.first[j] == i) continue;
      const auto &p = points[i], &q = points[j];
      const double away =
          std::max({std::abs(q[0] - p[0]), std::abs(q[1] - p[1]), std::abs(q[2] - p[2])});
      nearest = std::min(nearest, away);
      farthest = std::max(farthest, away);
      row.emplace_back(away, places.first[j]);
    }
    // By the largest coordinate the gap is at most so much wider than by length.
    if (!(nearest < 2 * gap * farthest)) continue;
    for (auto& [away, j] : row) {
      const auto &p = points[i], &q = points[j];
      away = std::hypot(q[0] - p[0], q[1] - p[1], q[2] - p[2]);
    }
    std::sort(row.begin(), row.end());
    // One far from all is nobody's reason: most neighbours are beyond the gap.
    std::size_t near = 0;
    for (std::size_t k = 1; k <= row.size() / most; ++k)
      if (row[k - 1].first < gap * row[k].first) near = k;
    for (std::size_t k = 0; k < near; ++k) {
      const Index a = root(i), b = root(row[k].second);
      if (a == b) continue;
      parent[std::max(a, b)] = std::min(a, b);
      any = true;
    }
  }
  if (!any) return places;
  DistinctPoints merged;
  merged.first.resize(points.size());
  for (Index i = 0; i < points.size(); ++i) merged.first[i] = root(places.first[i]);
  for (const Index i : places.order)
    if (merged.first[i] == i) merged.order.push_back(i);
  return merged;
}

}  // namespace plexway
