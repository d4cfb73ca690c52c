#pragma once

#include <concepts>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <span>

#include <plexway/common/ids.hpp>
#include <plexway/domain/domains.hpp>
#include <plexway/executors.hpp>
#include <plexway/solve/distance_field.hpp>
#include <plexway/solve/options.hpp>
#include <plexway/source/point_source.hpp>
#include <plexway/source/source_list.hpp>

// Distance matrices of any size: rows are solved one source a thread, handed on and forgotten.

namespace plexway {

/// How far along a matrix is.
struct PairsProgress {
  std::size_t rows_done;  ///< of those that were wanted
  /// Wanted.
  std::size_t rows;
  double seconds;          ///< since it began
  double rows_per_second;  ///< 0 until a row is done
  double seconds_left;     ///< at that rate; +inf until a row is done
};

/// What a matrix is of.
struct PairsRequest {
  /// A source a row, of any kind that solves on the domain; nothing: every vertex.
  std::optional<SourceList> rows;
  /// Vertices, in any order; empty: every vertex.
  std::span<const Index> columns = {};
  /// How each row is solved. Beyond `radius` is +inf.
  PropagateOptions solve = {};
  /// Rows come in blocks of so many, block b from row b * block on; the last may have fewer.
  std::size_t block = 32;
  /// Which blocks are wanted; empty: all. Asked once for each, before the first row.
  std::function<bool(std::size_t block)> wanted = {};
  /// Where others solve rows of the same matrix (row_ranks.hpp): asked for a block to solve, by any
  /// thread, one at a time, until there is none; `wanted` is not asked then. Empty: all that are
  /// wanted, in their order.
  std::function<std::optional<std::size_t>()> next = {};
  /// Called by the calling thread after each of its rows. Returning false ends with Cancelled.
  std::function<bool(const PairsProgress&)> progress = {};

  /// Rows of a matrix on a domain of so many vertices, and blocks of rows.
  [[nodiscard]] std::size_t row_count(std::size_t vertices) const {
    return rows ? rows->size() : vertices;
  }
  /// Columns of it.
  [[nodiscard]] std::size_t column_count(std::size_t vertices) const {
    return columns.empty() ? vertices : columns.size();
  }
  /// Blocks of rows, wanted or not.
  [[nodiscard]] std::size_t block_count(std::size_t vertices) const {
    return (row_count(vertices) + block - 1) / block;
  }
};

/// Where rows go. Both may throw, which ends the run with that.
template <class Row>
struct PairsSink {
  /// Row `row` is solved. Any thread may call, for several rows at once.
  std::function<void(std::size_t row, Row content)> row;
  /// All rows of a block were handed over, by whichever thread came last; one call at a time. May
  /// be empty.
  std::function<void(std::size_t block)> block = {};
};

/// A row with all its columns, +inf where no path leads.
template <class Real>
using DenseRow = std::span<const Real>;

/// An entry of a row that has few.
template <class Real>
struct NearEntry {
  Index column;  ///< its place among the columns
  /// In the domain's unit.
  Real distance;
};
/// Ascending by column, each column once at most.
template <class Real>
using SparseRow = std::span<const NearEntry<Real>>;

/// Who solves rows, one thread a source.
template <class E>
concept RowExecutor = std::same_as<E, Serial> || std::same_as<E, OpenMP>;

/// What a run did.
struct PairsReport {
  std::size_t rows = 0;            ///< solved, which leaves out what was not wanted
  bool complete = true;            ///< false if max_expansions ended a row early
  PropagateStatistics statistics;  ///< sums over the rows
};

/// Distances from each row's source to each column's vertex.
///
/// By Serial one row after the other; by OpenMP one thread a source, rows dealt as threads come. A
/// row has the bits of `solve` by Serial, with any number of threads. Threads wait for nobody, so a
/// few blocks are open at once.
///
/// Memory: per thread a workspace and a field (about 100 bytes a triangle and 12 a vertex in
/// float); nothing grows with the number of rows. Cost: a solve a row.
///
/// Throws UsageError for no row, a column that is no vertex, blocks of no rows, and as `solve`;
/// Cancelled when `progress` says so.
template <RowExecutor E, DomainType D>
PairsReport all_pairs(const E& executor, const D& domain, const PairsRequest& request,
                      const PairsSink<DenseRow<RealOf<D>>>& sink);

/// Which entries of a row are kept.
struct NearLimits {
  double radius = std::numeric_limits<double>::infinity();  ///< no farther than this
  std::size_t nearest = none;  ///< and no more than so many: the nearest, the first of equals
};

/// The same, of entries that are near: within a radius, the k nearest, or both. The row's own
/// vertex counts, with distance 0. `request.solve.radius` is not asked for.
///
/// Each is what `all_pairs` says, up to rounding.
///
/// Cost: on surfaces and clouds a solve within the radius, which looks at every vertex (30 ns each
/// beside what is reached); by Accuracy::fast, from points by the default rule, what a row reaches
/// and nothing that grows with the surface (BoundedSearch, whose memory is a thread's). The k
/// nearest are looked for within a radius that doubles. On wireframes a solve within the radius; on
/// other domains, or from other sources, a solve of all.
template <RowExecutor E, DomainType D>
PairsReport near_pairs(const E& executor, const D& domain, const PairsRequest& request,
                       const NearLimits& limits, const PairsSink<SparseRow<RealOf<D>>>& sink);

}  // namespace plexway
