#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <plexway/common/ids.hpp>
#include <plexway/common/rows_of.hpp>

namespace plexway {

/// Which points lie around each point of a cloud, one list a point, end to end.
///
/// The neighbours of point i are of[begin[i]] to of[begin[i + 1]], nearest first, without i.
struct Neighbours {
  std::vector<Index> begin;  ///< n + 1, ascending, from 0; empty for no points
  std::vector<Index> of;     ///< m point numbers < n

  /// n.
  [[nodiscard]] std::size_t point_count() const { return begin.empty() ? 0 : begin.size() - 1; }
  /// The neighbours of a point < n, nearest first.
  [[nodiscard]] std::span<const Index> around(Index point) const {
    return std::span<const Index>(of).subspan(begin[point], begin[point + 1] - begin[point]);
  }
};

/// Throws InputError naming the point for lists that are not n ascending rows, a neighbour >= n, or
/// a point that is its own neighbour.
void check(const Neighbours& neighbours);

/// Every pair from both its ends: where a has b, b has a. A row keeps its order; who has the point
/// but not the other way around follows behind, by number. Without the points' places that is the
/// best order there is; the overload below puts rows in order. Throws as `check`. Cost: linear.
[[nodiscard]] Neighbours symmetric_closure(const Neighbours& neighbours);

/// The same, and every row nearest first, the lower number first of two equally near. Throws
/// InputError if there is not one row a point.
[[nodiscard]] Neighbours symmetric_closure(const Neighbours& neighbours, const GivenPoints& points);

}  // namespace plexway
