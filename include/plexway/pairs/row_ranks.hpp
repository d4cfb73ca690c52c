#pragma once

#include <cstddef>
#include <cstring>
#include <functional>
#include <span>
#include <type_traits>
#include <vector>

#include <plexway/pairs/all_pairs.hpp>

// Rows of one matrix, solved by several processes.

namespace plexway {

/// Processes that solve rows of one matrix together, such as the ranks of MPI (mpi/ranks.hpp). Each
/// has the domain; one of them, the leader, deals blocks of rows as they are asked for, and gets
/// all rows.
class RowRanks {
 public:
  /// A row as its numbers or entries lie in memory.
  using Bytes = std::span<const std::byte>;
  /// Solves what `request.next` tells, by this process' threads.
  using Solve = std::function<PairsReport(const PairsRequest&, const PairsSink<Bytes>&)>;

  virtual ~RowRanks() = default;
  /// Is it this one that deals rows and gets them?
  [[nodiscard]] virtual bool leads() const = 0;
  /// Processes.
  [[nodiscard]] virtual std::size_t count() const = 0;
  /// All processes call it, with the same rows and columns of a domain of so many vertices. On the
  /// leader the sink gets all rows that are wanted, by several threads at once, and what is
  /// returned is of all; it throws what any process threw. The others call neither sink nor
  /// progress.
  virtual PairsReport share(const PairsRequest& request, std::size_t vertices,
                            const PairsSink<Bytes>& sink, const Solve& solve) = 0;
};

/// The same for rows that `solve(request, sink)` has: DenseRow or SparseRow. Bit for bit what one
/// process alone makes.
template <class Row, class Solve>
PairsReport share_rows(RowRanks& ranks, const PairsRequest& request, std::size_t vertices,
                       const PairsSink<Row>& sink, const Solve& solve) {
  using Item = std::remove_const_t<typename Row::element_type>;
  static_assert(std::is_trivially_copyable_v<Item>);
  const PairsSink<RowRanks::Bytes> as_bytes = {
      [&](std::size_t row, RowRanks::Bytes bytes) {
        std::vector<Item> items(bytes.size() / sizeof(Item));
        if (!items.empty()) std::memcpy(items.data(), bytes.data(), bytes.size());
        sink.row(row, items);
      },
      sink.block};
  return ranks.share(request, vertices, as_bytes, [&](const PairsRequest& mine, const auto& out) {
    const PairsSink<Row> from_items = {
        [&](std::size_t row, Row items) { out.row(row, std::as_bytes(items)); }, out.block};
    return solve(mine, from_items);
  });
}

}  // namespace plexway
