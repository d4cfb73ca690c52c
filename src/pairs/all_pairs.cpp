#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <plexway/pairs/all_pairs.hpp>
#include <plexway/pairs/row_reductions.hpp>
#include <plexway/solve.hpp>

#include "pairs/row_work.hpp"

namespace plexway {
namespace {

template <class D>
struct DenseWorker {
  using Real = RealOf<D>;

  const D& domain;
  const PairsRequest& request;
  const PairsSink<DenseRow<Real>>& sink;
  PairsReport report = {};
  WorkspaceOf<Serial, D> workspace = {};
  DistanceField<Real> field = {};
  std::vector<Real> chosen = {};

  void solve(const detail::apps::RowSource& source, std::size_t row,
             const PropagateOptions& options) {
    plexway::solve(Serial{}, domain, source.list(), options, workspace, field);
    detail::apps::add(report.statistics, field.statistics);
    report.complete = report.complete && field.complete;
    if (request.columns.empty()) {
      sink.row(row, field.distance);
      return;
    }
    chosen.clear();
    for (const Index v : request.columns) chosen.push_back(field.distance[v]);
    sink.row(row, chosen);
  }
};

}  // namespace

template <RowExecutor E, DomainType D>
PairsReport all_pairs(const E& executor, const D& domain, const PairsRequest& request,
                      const PairsSink<DenseRow<RealOf<D>>>& sink) {
  using Worker = DenseWorker<D>;
  detail::apps::check(request, domain.vertex_count());
  return detail::apps::deal_rows<E, Worker>(
      executor, domain.vertex_count(), request, sink.block, [&] {
        return std::unique_ptr<Worker>(new Worker{domain, request, sink});
      });
}

#define PLEXWAY_PAIRS(...)                                                               \
  template PairsReport all_pairs(const Serial&, const __VA_ARGS__&, const PairsRequest&, \
                                 const PairsSink<DenseRow<RealOf<__VA_ARGS__>>>&);       \
  template PairsReport all_pairs(const OpenMP&, const __VA_ARGS__&, const PairsRequest&, \
                                 const PairsSink<DenseRow<RealOf<__VA_ARGS__>>>&);
PLEXWAY_DOMAINS(PLEXWAY_PAIRS)
#undef PLEXWAY_PAIRS

template <class Real>
RowStatistics row_statistics(std::span<const Real> distance) {
  RowStatistics row;
  double sum = 0;
  for (std::size_t c = 0; c < distance.size(); ++c) {
    const double d = static_cast<double>(distance[c]);
    if (!std::isfinite(d)) continue;
    ++row.reached;
    sum += d;
    if (row.farthest != none && !(d > row.largest)) continue;
    row.largest = d;
    row.farthest = static_cast<Index>(c);
  }
  if (row.reached > 0) row.mean = sum / static_cast<double>(row.reached);
  return row;
}

template <class Real>
std::vector<double> row_histogram(std::span<const Real> distance, double width, std::size_t bins) {
  std::vector<double> counts(bins, 0);
  for (const Real d : distance)
    if (std::isfinite(d)) {
      const double bin = static_cast<double>(d) / width;
      ++counts[bin < static_cast<double>(bins) ? static_cast<std::size_t>(bin) : bins - 1];
    }
  return counts;
}

template <class Real>
std::vector<double> parcel_means(std::span<const Real> distance, const Parcels& columns) {
  std::vector<double> mean(columns.count, 0);
  std::vector<std::size_t> size(columns.count, 0);
  for (std::size_t c = 0; c < distance.size(); ++c) {
    const Index parcel = columns.of[c];
    if (parcel == none) continue;
    mean[parcel] += static_cast<double>(distance[c]);
    ++size[parcel];
  }
  for (std::size_t p = 0; p < columns.count; ++p)
    mean[p] = size[p] > 0 ? mean[p] / static_cast<double>(size[p])
                          : std::numeric_limits<double>::infinity();
  return mean;
}

#define PLEXWAY_REDUCTIONS(Real)                                                          \
  template RowStatistics row_statistics(std::span<const Real>);                           \
  template std::vector<double> row_histogram(std::span<const Real>, double, std::size_t); \
  template std::vector<double> parcel_means(std::span<const Real>, const Parcels&);
PLEXWAY_REDUCTIONS(float)
PLEXWAY_REDUCTIONS(double)

}  // namespace plexway
