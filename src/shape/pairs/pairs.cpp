#include <plexway/shape/pairs.hpp>

#include <limits>
#include <memory>
#include <type_traits>
#include <variant>
#include <vector>

#include <plexway/shape/complex.hpp>
#include <plexway/support.hpp>

#include "pairs/row_work.hpp"
#include "shape/inside.hpp"

namespace plexway {
namespace {

// Calls run(executor) with one that takes a source a thread.
template <class Run>
PairsReport by(const AnyExecutor& executor, const AnyDomain& domain, const Run& run) {
  if (const auto* team = std::get_if<OpenMP>(&executor)) return run(*team);
  if (std::holds_alternative<GL>(executor))
    support(Purpose::rows, domain.kind(), ExecutorKind::gl).require();
  return run(Serial{});
}

// A row is a solve of all; `take(row, distances)`, all vertices.
template <class Take>
struct AnyWorker {
  const AnyDomain& domain;
  const Take& take;
  PairsReport report = {};
  AnyField field = {};
  std::vector<double> distance = {};

  void solve(const apps::RowSource& source, std::size_t row, const PropagateOptions& options) {
    domain.solve(Serial{}, source.list(), options, field);
    std::visit(
        [&](const auto& f) {
          apps::add(report.statistics, f.statistics);
          distance.assign(f.distance.begin(), f.distance.end());
        },
        field.data);
    report.complete = report.complete && field.complete();
    take(row, distance);
  }
};

template <class Take>
PairsReport every_row(const AnyExecutor& executor, const AnyDomain& domain,
                      const PairsRequest& request, const std::function<void(std::size_t)>& block,
                      const Take& take) {
  using Worker = AnyWorker<Take>;
  apps::check(request, domain.vertices());
  return by(executor, domain, [&](const auto& with) {
    return apps::deal_rows<std::decay_t<decltype(with)>, Worker>(
        with, domain.vertices(), request, block, [&] {
          return std::unique_ptr<Worker>(new Worker{domain, take});
        });
  });
}

}  // namespace

PairsReport all_pairs(const AnyExecutor& executor, const AnyDomain& domain,
                      const PairsRequest& request, const PairsSink<DenseRow<double>>& sink) {
  return every_row(executor, domain, request, sink.block,
                   [&](std::size_t row, const std::vector<double>& distance) {
                     if (request.columns.empty()) return sink.row(row, distance);
                     std::vector<double> chosen;
                     chosen.reserve(request.columns.size());
                     for (const Index v : request.columns) chosen.push_back(distance[v]);
                     sink.row(row, chosen);
                   });
}

PairsReport near_pairs(const AnyExecutor& executor, const AnyDomain& domain,
                       const PairsRequest& request, const NearLimits& limits,
                       const PairsSink<SparseRow<double>>& sink) {
  if (domain.kind() == DomainKind::mixed) {  // its complex has numbers of its own
    apps::check(limits, request, domain.vertices());
    return every_row(executor, domain, request, sink.block,
                     [&](std::size_t row, const std::vector<double>& distance) {
                       std::vector<NearEntry<double>> entries;
                       for (std::size_t c = 0; c < request.column_count(distance.size()); ++c) {
                         const double d =
                             distance[request.columns.empty() ? c : request.columns[c]];
                         if (d <= limits.radius && d < std::numeric_limits<double>::infinity())
                           entries.push_back({static_cast<Index>(c), d});
                       }
                       apps::keep_nearest(entries, limits.nearest);
                       sink.row(row, entries);
                     });
  }
  // Rows are found in the complex itself.
  const Inside inside(domain.open_simplices(),
                      request.rows.value_or(std::span<const PointSource>()));
  PairsRequest within = request;
  if (request.rows) within.rows = inside.list();
  return by(executor, domain, [&](const auto& with) {
    return with_complex(domain, [&](const auto& complex) {
      using Real = RealOf<std::decay_t<decltype(complex)>>;
      return near_pairs(with, complex, within, limits,
                        {[&](std::size_t row, SparseRow<Real> near) {
                           std::vector<NearEntry<double>> entries;
                           entries.reserve(near.size());
                           for (const auto& [column, distance] : near)
                             entries.push_back({column, static_cast<double>(distance)});
                           sink.row(row, entries);
                         },
                         sink.block});
    });
  });
}

}  // namespace plexway
