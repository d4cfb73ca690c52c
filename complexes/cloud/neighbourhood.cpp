#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <plexway/cloud/neighbours.hpp>
#include <plexway/error.hpp>

#include "complexes/cloud/neighbourhood.hpp"

namespace plexway {
namespace {

using Points = std::span<const std::array<double, 3>>;

double squared_distance(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  double sum = 0;
  for (std::size_t d = 0; d < 3; ++d) sum += (a[d] - b[d]) * (a[d] - b[d]);
  return sum;
}

void sort_rows(Neighbours& neighbours, Points points) {
  std::vector<std::pair<double, Index>> row;
  for (Index i = 0; i < neighbours.point_count(); ++i) {
    row.clear();
    for (const Index j : neighbours.around(i))
      row.push_back({squared_distance(points[i], points[j]), j});
    if (std::is_sorted(row.begin(), row.end())) continue;
    std::sort(row.begin(), row.end());
    for (std::size_t k = 0; k < row.size(); ++k)
      neighbours.of[neighbours.begin[i] + k] = row[k].second;
  }
}

}  // namespace

void check(const Neighbours& neighbours) {
  const auto& begin = neighbours.begin;
  const std::size_t n = neighbours.point_count();
  if (begin.empty() ? !neighbours.of.empty()
                    : begin[0] != 0 || begin.back() != neighbours.of.size())
    throw InputError("neighbour lists do not begin at 0 and end at " +
                     std::to_string(neighbours.of.size()));
  for (std::size_t i = 0; i < n; ++i)
    if (begin[i] > begin[i + 1])
      throw InputError("point " + std::to_string(i) + ": its neighbours end before they begin");
  for (Index i = 0; i < n; ++i)
    for (const Index j : neighbours.around(i)) {
      if (j >= n)
        throw InputError("point " + std::to_string(i) + ": neighbour " + std::to_string(j) +
                         " is out of range, there are " + std::to_string(n));
      if (j == i)
        throw InputError("point " + std::to_string(i) + " is in its own list of neighbours");
    }
}

Neighbours symmetric_closure(const Neighbours& neighbours) {
  check(neighbours);
  const std::size_t n = neighbours.point_count();
  const auto lists = [&](Index i, Index j) {  // rows are short
    const auto row = neighbours.around(i);
    return std::find(row.begin(), row.end(), j) != row.end();
  };
  Neighbours closure;
  closure.begin.assign(neighbours.begin.empty() ? 0 : n + 1, 0);
  if (closure.begin.empty()) return closure;
  for (Index i = 0; i < n; ++i) {
    closure.begin[i + 1] += neighbours.begin[i + 1] - neighbours.begin[i];
    for (const Index j : neighbours.around(i)) closure.begin[j + 1] += !lists(j, i);
  }
  for (std::size_t i = 0; i < n; ++i) closure.begin[i + 1] += closure.begin[i];
  closure.of.resize(closure.begin[n]);
  std::vector<Index> at(n);
  for (Index i = 0; i < n; ++i) {
    const auto row = neighbours.around(i);
    std::copy(row.begin(), row.end(), closure.of.begin() + closure.begin[i]);
    at[i] = closure.begin[i] + static_cast<Index>(row.size());
  }
  for (Index i = 0; i < n; ++i)
    for (const Index j : neighbours.around(i))
      if (!lists(j, i)) closure.of[at[j]++] = i;
  return closure;
}

Neighbours symmetric_closure(const Neighbours& neighbours, const GivenPoints& points) {
  if (points.size() != neighbours.point_count())
    throw InputError(std::to_string(points.size()) + " points with neighbours of " +
                     std::to_string(neighbours.point_count()));
  Neighbours closure = symmetric_closure(neighbours);
  sort_rows(closure, points);
  return closure;
}

}  // namespace plexway

namespace plexway::detail {

void check(std::span<const std::array<double, 3>> points, const Neighbours& neighbours) {
  check(neighbours);
  if (neighbours.point_count() != points.size())
    throw InputError("neighbour lists for " + std::to_string(neighbours.point_count()) +
                     " points, but there are " + std::to_string(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i)
    for (const double x : points[i])
      if (!std::isfinite(x))
        throw InputError("point " + std::to_string(i) + ": a coordinate is not finite");
}

void Neighbourhood::set_neighbours(std::span<const std::array<double, 3>> points,
                                   const Neighbours& neighbours, Index centre) {
  const auto around = neighbours.around(centre);
  members_.assign(around.begin(), around.end());
  place(points, centre);
}

void Neighbourhood::set_two_rings(std::span<const std::array<double, 3>> points,
                                  const Neighbours& neighbours, Index centre) {
  if (neighbours.around(centre).size() >= enough) return set_neighbours(points, neighbours, centre);
  members_.clear();
  table_.fill(none);
  add(centre);
  for (const Index first : neighbours.around(centre)) add(first);
  const std::size_t ring = members_.size();
  for (std::size_t i = 1; i < ring; ++i)
    for (const Index second : neighbours.around(members_[i]))
      if (members_.size() < most) add(second);
  members_.erase(members_.begin());
  place(points, centre);
}

bool Neighbourhood::add(Index point) {
  std::size_t at = point % slots;
  for (; table_[at] != none; at = (at + 1) % slots)
    if (table_[at] == point) return false;
  table_[at] = point;
  members_.push_back(point);
  return true;
}

void Neighbourhood::keep_nearest(std::size_t count) {
  offset.resize(std::min(count, offset.size()));
  measure();
}

void Neighbourhood::place(std::span<const std::array<double, 3>> points, Index centre) {
  offset.resize(members_.size());
  for (std::size_t i = 0; i < members_.size(); ++i)
    for (std::size_t d = 0; d < 3; ++d) offset[i][d] = points[members_[i]][d] - points[centre][d];
  measure();
}

void Neighbourhood::measure() {
  weight.resize(offset.size());
  double largest = 0, sum = 0;
  for (std::size_t i = 0; i < offset.size(); ++i) {
    weight[i] =
        offset[i][0] * offset[i][0] + offset[i][1] * offset[i][1] + offset[i][2] * offset[i][2];
    largest = std::max(largest, weight[i]);
    sum += weight[i];
  }
  // The farthest still count a little: no neighbourhood hangs on fewer points than it has.
  for (double& w : weight) w = largest > 0 ? 1 - w / (1.2 * largest) : 1;
  radius = std::sqrt(largest);
  mean_square = offset.empty() ? 0 : sum / static_cast<double>(offset.size());
}

}  // namespace plexway::detail
