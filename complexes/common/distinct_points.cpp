#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

#include <plexway/common/distinct_points.hpp>
#include <plexway/error.hpp>

#include "complexes/common/disjoint_sets.hpp"
#include "complexes/common/nearby.hpp"
#include "complexes/common/simplex_order.hpp"

namespace plexway {
using namespace detail;

namespace {

using Points = std::span<const std::array<double, 3>>;

// A cell of the Morton curve for each point; equal points share one.
using Cell = std::array<std::uint32_t, 3>;

std::vector<Cell> cells_of(Points points) {
  Box3 box;
  for (const auto& p : points) box.take(p);
  double width = 0;  // halves: no overflow near 1e308
  for (std::size_t d = 0; d < 3; ++d) width = std::max(width, box.high[d] / 2 - box.low[d] / 2);
  constexpr double cells = 2097151;
  std::vector<Cell> cell(points.size(), Cell{0, 0, 0});
  for (std::size_t i = 0; i < points.size() && width > 0; ++i)
    for (std::size_t d = 0; d < 3; ++d) {
      const double share = (points[i][d] / 2 - box.low[d] / 2) / width;
      cell[i][d] = static_cast<std::uint32_t>(share * cells);
    }
  return cell;
}

constexpr double nearness = 1e-4;

// By its largest coordinate, which is at least 1 / sqrt(3) of its length.
double size_of(const std::array<double, 3>& p, const std::array<double, 3>& q) {
  return std::max({std::abs(q[0] - p[0]), std::abs(q[1] - p[1]), std::abs(q[2] - p[2])});
}

// Of the nearest and the farthest neighbour by that.
bool may_be_near(double nearest, double farthest) { return nearest < 2 * nearness * farthest; }

// For each point of a the nearest of b.
std::vector<std::array<Index, 2>> nearest_pairs(Points a, Points b, double tolerance) {
  // The points of b along one axis, the one in which they spread most; then a band of them each.
  std::array<double, 3> low = {}, high = {};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto [min, max] = std::minmax_element(
        b.begin(), b.end(), [k](const auto& p, const auto& q) { return p[k] < q[k]; });
    if (!b.empty()) low[k] = (*min)[k], high[k] = (*max)[k];
  }
  std::size_t axis = 0;
  for (std::size_t k = 1; k < 3; ++k)
    if (high[k] - low[k] > high[axis] - low[axis]) axis = k;
  std::vector<Index> order(b.size());
  std::iota(order.begin(), order.end(), Index{0});
  std::sort(order.begin(), order.end(), [&](Index i, Index j) {
    return b[i][axis] != b[j][axis] ? b[i][axis] < b[j][axis] : i < j;
  });

  std::vector<std::array<Index, 2>> pairs;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const auto from = std::lower_bound(order.begin(), order.end(), a[i][axis] - tolerance,
                                       [&](Index j, double x) { return b[j][axis] < x; });
    Index best = none;
    double nearest = tolerance;
    for (auto j = from; j != order.end() && b[*j][axis] <= a[i][axis] + tolerance; ++j) {
      const double d = std::hypot(b[*j][0] - a[i][0], b[*j][1] - a[i][1], b[*j][2] - a[i][2]);
      if (d < nearest || (d == nearest && (best == none || *j < best))) nearest = d, best = *j;
    }
    if (best != none) pairs.push_back({static_cast<Index>(i), best});
  }
  return pairs;
}

}  // namespace

DistinctPoints distinct_points(Points points) {
  if (points.size() >= none) throw InputError("more than 4294967294 points");
  for (std::size_t i = 0; i < points.size(); ++i)
    for (const double x : points[i])
      if (!std::isfinite(x))
        throw InputError("point " + std::to_string(i) +
                         ": a coordinate is not finite; remove such points first");
  const std::vector<Cell> cells = cells_of(points);
  std::vector<Index> order = sorted_along_curve(points.size(), 1, [&](std::size_t i) {
    return CurveCell{cells[i][0], cells[i][1], cells[i][2]};
  });
  DistinctPoints result;
  result.first.resize(points.size());
  result.order.reserve(points.size());
  for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
    for (end = begin + 1; end < order.size() && cells[order[end]] == cells[order[begin]];) ++end;
    const auto at = [&](std::size_t i) -> const auto& { return points[order[i]]; };
    if (end - begin > 1)
      std::sort(order.begin() + static_cast<std::ptrdiff_t>(begin),
                order.begin() + static_cast<std::ptrdiff_t>(end), [&](Index a, Index b) {
                  const auto &p = points[a], &q = points[b];
                  return p != q ? p < q : a < b;
                });
    for (std::size_t i = begin; i < end; ++i) {
      const Index point = order[i];
      const bool twin = i > begin && at(i) == at(i - 1);
      result.first[point] = twin ? result.first[order[i - 1]] : point;
      if (!twin) result.order.push_back(point);
    }
  }
  return result;
}

DistinctPoints without_near_twins(Points points, const Neighbours& neighbours,
                                  const DistinctPoints& places) {
  constexpr std::size_t most = 3;  // one in so many neighbours
  DisjointSets twins(points.size());
  std::vector<std::pair<double, Index>> row;
  bool any = false;
  for (const Index i : places.order) {
    row.clear();
    double nearest = std::numeric_limits<double>::infinity(), farthest = 0;
    for (const Index j : neighbours.around(i)) {
      if (places.first[j] == i) continue;
      const double away = size_of(points[i], points[j]);
      nearest = std::min(nearest, away);
      farthest = std::max(farthest, away);
      row.emplace_back(away, places.first[j]);
    }
    if (!may_be_near(nearest, farthest)) continue;
    for (auto& [away, j] : row) {
      const auto &p = points[i], &q = points[j];
      away = std::hypot(q[0] - p[0], q[1] - p[1], q[2] - p[2]);
    }
    std::sort(row.begin(), row.end());
    // One far from all is nobody's reason: most neighbours are beyond the gap.
    std::size_t near = 0;
    for (std::size_t k = 1; k <= row.size() / most; ++k)
      if (row[k - 1].first < nearness * row[k].first) near = k;
    for (std::size_t k = 0; k < near; ++k) any |= twins.unite(i, row[k].second);
  }
  if (!any) return places;
  DistinctPoints merged;
  merged.first.resize(points.size());
  for (Index i = 0; i < points.size(); ++i) merged.first[i] = twins.find(places.first[i]);
  for (const Index i : places.order)
    if (merged.first[i] == i) merged.order.push_back(i);
  return merged;
}

namespace detail {

bool may_have_near_twins(Points points, const Neighbours& neighbours) {
  // By squares of lengths: largest coordinates are at most sqrt(3) less.
  constexpr double gaps = 3 * (2 * nearness) * (2 * nearness) * (1 + 1e-9);
  for (Index i = 0; i < points.size(); ++i) {
    double nearest = std::numeric_limits<double>::infinity(), farthest = 0;
    const auto p = points[i];
    for (const Index j : neighbours.around(i)) {
      const auto& q = points[j];
      const double x = q[0] - p[0], y = q[1] - p[1], z = q[2] - p[2];
      const double square = x * x + y * y + z * z;
      nearest = std::min(nearest, square);
      farthest = std::max(farthest, square);
    }
    if (nearest <= gaps * farthest) return true;
  }
  return false;
}

std::vector<std::array<Index, 2>> nearby_pairs(Points a, Points b, double tolerance) {
  std::vector<std::array<Index, 2>> pairs = nearest_pairs(a, b, tolerance);
  for (const auto& [j, i] : nearest_pairs(b, a, tolerance)) pairs.push_back({i, j});
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

}  // namespace detail

}  // namespace plexway
