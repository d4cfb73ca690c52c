#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <span>
#include <vector>

#include <plexway/common/ids.hpp>

namespace plexway::detail {

/// Values by a key, one row a key, row k from begin[k] to begin[k + 1], each in the order in which
/// its values come. `each(add)` calls add(key, value) for all of them; it is called twice, first to
/// count.
template <class T, class Each>
void fill_rows(std::size_t keys, std::vector<Index>& begin, std::vector<T>& values,
               const Each& each) {
  begin.assign(keys + 1, 0);
  each([&](Index key, const T&) { ++begin[key + 1]; });
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  values.resize(begin[keys]);
  std::vector<Index> end(begin.begin(), begin.end() - 1);  // of the row as filled so far
  each([&](Index key, const T& value) { values[end[key]++] = value; });
}

/// The caller's number of each vertex of a domain, by its number inside.
template <class Domain>
std::vector<Index> vertices_outside(const Domain& domain) {
  const std::span<const Index> inside = domain.vertices_inside();
  std::vector<Index> outside(inside.size());
  for (Index v = 0; v < inside.size(); ++v) outside[inside[v]] = v;
  return outside;
}

/// The value in the middle, or the upper one of two; reorders what it is given, which is not empty.
inline double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace plexway::detail
