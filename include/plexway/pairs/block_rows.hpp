#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/executors/fields.hpp>
#include <plexway/pairs/all_pairs.hpp>
#include <plexway/solve.hpp>

namespace plexway {

/// `all_pairs` for executors that solve many sources at once, such as GL: a block of rows by one
/// `solve_each`, whose bits the rows have. `statistics` are not counted. `progress` is called after
/// each block, by the calling thread, as is the sink.
///
/// Memory: the fields of a block. Throws as `all_pairs` and `solve_each`.
template <ExecutorType E, DomainType D>
PairsReport all_pairs_by_blocks(const E& executor, const D& domain, const PairsRequest& request,
                                const PairsSink<DenseRow<RealOf<D>>>& sink) {
  using Real = RealOf<D>;
  using Clock = std::chrono::steady_clock;
  const std::size_t vertices = domain.vertex_count(), rows = request.row_count(vertices);
  if (rows == 0) throw UsageError("a matrix of distances needs at least one row");
  if (request.block == 0) throw UsageError("a block of rows must have at least one");
  for (const Index v : request.columns)
    if (v >= vertices)
      throw UsageError("column vertex " + std::to_string(v) + " is out of range, there are " +
                       std::to_string(vertices));
  const auto size = [&](std::size_t b) {
    return std::min(request.block, rows - b * request.block);
  };
  std::vector<std::size_t> wanted;
  std::size_t total = request.next ? rows : 0, given = 0;
  for (std::size_t b = 0; !request.next && b < request.block_count(vertices); ++b)
    if (!request.wanted || request.wanted(b)) wanted.push_back(b), total += size(b);
  const auto next = [&]() -> std::optional<std::size_t> {
    if (request.next) return request.next();
    if (given == wanted.size()) return std::nullopt;
    return wanted[given++];
  };

  PairsReport report;
  WorkspaceOf<E, D> workspace;
  std::vector<Real> fields, chosen(request.columns.size());
  std::vector<PointSource> own;
  const auto start = Clock::now();
  while (const auto block = next()) {
    const std::size_t first = *block * request.block, count = size(*block);
    const auto sources = [&]() -> SourceList {
      if (request.rows && !request.rows->only_points())
        return SourceList(request.rows->sources().subspan(first, count));
      if (request.rows) return SourceList(request.rows->points().data() + first, count);
      own.clear();
      for (std::size_t row = first; row < first + count; ++row)
        own.push_back(PointSource::at(static_cast<Index>(row)));
      return SourceList(own);
    }();
    fields.resize(count * vertices);
    const std::span<Real> all(fields);
    report.complete =
        solve_each(executor, domain, sources, request.solve, workspace, all) && report.complete;
    for (std::size_t k = 0; k < count; ++k) {
      const DenseRow<Real> field = all.subspan(k * vertices, vertices);
      for (std::size_t c = 0; c < chosen.size(); ++c) chosen[c] = field[request.columns[c]];
      sink.row(first + k, chosen.empty() ? field : DenseRow<Real>(chosen));
    }
    if (sink.block) sink.block(*block);
    report.rows += count;
    if (!request.progress) continue;
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    const double rate = static_cast<double>(report.rows) / std::max(seconds, 1e-9);
    if (!request.progress(
            {report.rows, total, seconds, rate, static_cast<double>(total - report.rows) / rate}))
      throw Cancelled("cancelled by the progress callback");
  }
  return report;
}

}  // namespace plexway
