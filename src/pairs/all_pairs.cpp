#include <plexway/pairs/all_pairs.hpp>

#include <vector>

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

  void solve(const apps::RowSource& source, std::size_t row, const PropagateOptions& options) {
    plexway::solve(Serial{}, domain, source.list(), options, workspace, field);
    apps::add(report.statistics, field.statistics);
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
  apps::check(request, domain.vertex_count());
  return apps::deal_rows<E, Worker>(executor, domain.vertex_count(), request, sink.block, [&] {
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

}  // namespace plexway
