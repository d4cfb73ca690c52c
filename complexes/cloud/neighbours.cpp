#include <plexway/cloud/neighbours.hpp>

#include <algorithm>
#include <string>
#include <utility>

#include <plexway/error.hpp>

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
