#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <plexway/common/ids.hpp>

// What is left of a row of distances where the row itself is not kept.

namespace plexway {

/// Of one row; over what is reached.
struct RowStatistics {
  /// Columns whose distance is finite.
  std::size_t reached = 0;
  /// Of the distances; 0 where nothing is reached.
  double mean = 0;
  double largest = 0;     ///< eccentricity, where columns are all vertices
  Index farthest = none;  ///< the first column that is so far; none where nothing is reached
};

/// Looks at one row. Cost: linear.
template <class Real>
[[nodiscard]] RowStatistics row_statistics(std::span<const Real> distance);

/// Counts of distances by size: bin i from i * width on, the last for all beyond. +inf is not
/// counted.
template <class Real>
[[nodiscard]] std::vector<double> row_histogram(std::span<const Real> distance, double width,
                                                std::size_t bins);

/// Parts of a domain: one label an element, each of the labels' values from 0 to `count` - 1, or
/// `none` for elements of no part.
struct Parcels {
  /// The label of each element.
  std::vector<Index> of;
  /// How many labels there are.
  std::size_t count = 0;
};

/// The mean distance to each parcel; +inf where one of its columns is not reached, or it has none.
template <class Real>
[[nodiscard]] std::vector<double> parcel_means(std::span<const Real> distance,
                                               const Parcels& columns);

}  // namespace plexway
