#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/pairs/all_pairs.hpp>

#include "executors/threads/share_out.hpp"

/// What dense and sparse matrices have in common: which rows, dealt to whom, and when a block is
/// through.
namespace plexway::detail::apps {

inline std::size_t threads_of(const Serial&) { return 1; }
inline std::size_t threads_of(const OpenMP& executor) { return team_size(executor); }

inline void deal(const Serial&, std::size_t count,
                 const std::function<void(std::size_t, std::size_t)>& work) {
  for (std::size_t k = 0; k < count; ++k) work(k, 0);
}
inline void deal(const OpenMP& executor, std::size_t count,
                 const std::function<void(std::size_t, std::size_t)>& work) {
  detail::share_out(executor, count, work);
}

/// Throws UsageError for a request that makes no sense.
inline void check(const PairsRequest& request, std::size_t vertices) {
  if (request.row_count(vertices) == 0)
    throw UsageError("a matrix of distances needs at least one row");
  if (request.block == 0) throw UsageError("a block of rows must have at least one");
  for (const Index v : request.columns)
    if (v >= vertices)
      throw UsageError("column vertex " + std::to_string(v) + " is out of range, there are " +
                       std::to_string(vertices));
}

/// Likewise with limits that make none.
inline void check(const NearLimits& limits, const PairsRequest& request, std::size_t vertices) {
  check(request, vertices);
  if (!(limits.radius >= 0)) throw UsageError("the radius must be >= 0");
  if (limits.nearest == 0) throw UsageError("the number of nearest columns must be >= 1");
  if (request.column_count(vertices) >= none) throw UsageError("too many columns");
}

/// The nearest of a row, the first of equals, in the order of columns.
template <class Real>
void keep_nearest(std::vector<NearEntry<Real>>& entries, std::size_t count) {
  if (entries.size() > count) {
    const auto nearer = [](const auto& a, const auto& b) {
      return a.distance < b.distance || (a.distance == b.distance && a.column < b.column);
    };
    std::nth_element(entries.begin(), entries.begin() + static_cast<std::ptrdiff_t>(count),
                     entries.end(), nearer);
    entries.resize(count);
  }
  std::sort(entries.begin(), entries.end(),
            [](const auto& a, const auto& b) { return a.column < b.column; });
}

/// The source of row k.
class RowSource {
 public:
  RowSource(const PairsRequest& request, std::size_t row)
      : own_(PointSource::at(static_cast<Index>(row))),
        list_(request.rows ? request.rows->only(row) : SourceList(own_)) {}
  RowSource(const RowSource&) = delete;
  RowSource& operator=(const RowSource&) = delete;

  [[nodiscard]] const SourceList& list() const { return list_; }
  /// If it is a point, else null.
  [[nodiscard]] const PointSource* point() const {
    return list_.only_points() ? list_.points().data() : nullptr;
  }

 private:
  PointSource own_;
  SourceList list_;
};

inline void add(PropagateStatistics& sum, const PropagateStatistics& one) {
  sum.expansions += one.expansions;
  sum.updates += one.updates;
  sum.reached_simplices += one.reached_simplices;
  sum.lowered_vertices += one.lowered_vertices;
  sum.raised_vertices += one.raised_vertices;
  sum.windows_gave_up += one.windows_gave_up;
}

/// Which row is next, for threads that ask one at a time, and when all of a block are through.
class RowDealer {
 public:
  RowDealer(const PairsRequest& request, std::size_t vertices)
      : rows_(request.row_count(vertices)),
        block_(request.block),
        next_(request.next),
        left_(request.block_count(vertices), 0) {
    if (next_) {
      wanted_rows_ = rows_;
      return;
    }
    for (std::size_t b = 0; b < left_.size(); ++b)
      if (!request.wanted || request.wanted(b)) wanted_.push_back(b), wanted_rows_ += size(b);
    next_ = [this]() -> std::optional<std::size_t> {
      if (given_ == wanted_.size()) return std::nullopt;
      return wanted_[given_++];
    };
  }
  RowDealer(const RowDealer&) = delete;
  RowDealer& operator=(const RowDealer&) = delete;

  /// Rows that are to be solved; all where `next` tells.
  [[nodiscard]] std::size_t wanted_rows() const { return wanted_rows_; }

  [[nodiscard]] std::optional<std::size_t> take() {
    const std::scoped_lock lock(mutex_);
    if (row_ == end_) {
      const auto block = next_();
      if (!block) return std::nullopt;
      row_ = *block * block_;
      end_ = row_ + size(*block);
      left_[*block] = size(*block);
    }
    return row_++;
  }
  /// A row is through; was it the last of its block?
  [[nodiscard]] bool finish(std::size_t row) {
    const std::scoped_lock lock(mutex_);
    return --left_[row / block_] == 0;
  }

 private:
  [[nodiscard]] std::size_t size(std::size_t block) const {
    return std::min(block_, rows_ - block * block_);
  }

  std::size_t rows_, block_;
  std::function<std::optional<std::size_t>()> next_;
  std::vector<std::size_t> wanted_;  // blocks
  std::size_t wanted_rows_ = 0, given_ = 0;
  std::mutex mutex_;
  std::size_t row_ = 0, end_ = 0;  // of the block that is being dealt
  std::vector<std::size_t> left_;  // rows of each block
};

/// Deals the wanted rows to threads. `Worker`, one a thread and made by it, has
/// `solve(const RowSource&, row, PropagateOptions with a progress callback that hears of the end)`,
/// which hands the row on, and `report`.
template <class E, class Worker>
PairsReport deal_rows(const E& executor, std::size_t vertices, const PairsRequest& request,
                      const std::function<void(std::size_t)>& block_done,
                      const std::function<std::unique_ptr<Worker>()>& make_worker) {
  using Clock = std::chrono::steady_clock;
  RowDealer dealer(request, vertices);
  const std::size_t total = dealer.wanted_rows();
  std::vector<std::unique_ptr<Worker>> workers(threads_of(executor));
  std::atomic<bool> stop{false};
  std::atomic<std::size_t> done{0};
  std::mutex one_block;
  const auto start = Clock::now();

  const auto tell = [&] {
    const std::size_t so_far = done;
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    const double rate = seconds > 0 ? static_cast<double>(so_far) / seconds : 0;
    const double to_go = static_cast<double>(total - so_far);
    if (!request.progress({so_far, total, seconds, rate,
                           rate > 0 ? to_go / rate : std::numeric_limits<double>::infinity()}))
      throw Cancelled("cancelled by the progress callback");
  };
  // Each thread takes rows until there are none.
  deal(executor, workers.size(), [&](std::size_t, std::size_t thread) {
    PropagateOptions options = request.solve;
    options.progress = detail::shared_progress(request.solve.progress, thread, stop);
    try {
      while (!stop) {
        const auto row = dealer.take();
        if (!row) return;
        if (!workers[thread]) workers[thread] = make_worker();
        const RowSource source(request, *row);
        workers[thread]->solve(source, *row, options);
        if (dealer.finish(*row) && block_done) {
          const std::scoped_lock lock(one_block);
          block_done(*row / request.block);
        }
        ++done;
        if (thread == 0 && request.progress) tell();
      }
    } catch (...) {
      stop = true;  // others are in the middle of a row
      throw;
    }
  });

  PairsReport report;
  report.rows = done;
  for (const auto& worker : workers) {
    if (!worker) continue;
    add(report.statistics, worker->report.statistics);
    report.complete = report.complete && worker->report.complete;
  }
  return report;
}

}  // namespace plexway::detail::apps
