#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <plexway/pairs/all_pairs.hpp>
#include <plexway/paths/bounded_search.hpp>
#include <plexway/solve.hpp>

#include "complexes/common/number_range.hpp"
#include "executors/checks.hpp"
#include "pairs/row_work.hpp"

namespace plexway {
using namespace detail;
namespace {

/// Which columns a vertex is: none, one, or several.
class ColumnsOfVertex {
 public:
  /// Columns as vertices of the surface or the like that is searched.
  ColumnsOfVertex(std::vector<Index> columns, std::size_t vertices)
      : first_(vertices, none), next_(columns.size(), none) {
    for (std::size_t c = columns.size(); c-- > 0;) {
      Index& first = first_[columns[c]];
      next_[c] = first;
      first = static_cast<Index>(c);
    }
  }
  template <class Visit>
  void each(Index vertex, const Visit& visit) const {
    for (Index c = first_[vertex]; c != none; c = next_[c]) visit(c);
  }

 private:
  std::vector<Index> first_, next_;
};

// What is searched instead of a domain, where there is a search whose cost is what it finds.
template <class Real>
const TriangleMesh<Real>* sheet_of(const TriangleMesh<Real>& mesh) {
  return &mesh;
}
template <class Real>
const TriangleMesh<Real>* sheet_of(const PointCloud<Real>& cloud) {
  return &cloud.surface();
}
template <class D>
const TriangleMesh<RealOf<D>>* sheet_of(const D&) {
  return nullptr;
}

// A vertex as the sheet has it: of points at one place only the first is there.
template <class D>
Index on_sheet(const D& domain, Index vertex) {
  if constexpr (requires { domain.of_point(vertex); })
    return domain.of_point(vertex);
  else
    return vertex;
}

template <class D>
std::vector<Index> columns_on_sheet(const D& domain, std::span<const Index> columns) {
  std::vector<Index> on(columns.empty() ? domain.vertex_count() : columns.size());
  for (std::size_t c = 0; c < on.size(); ++c)
    on[c] = on_sheet(domain, columns.empty() ? static_cast<Index>(c) : columns[c]);
  return on;
}

template <class D>
class NearWorker {
 public:
  using Real = RealOf<D>;

  NearWorker(const D& domain, const ColumnsOfVertex& columns, std::size_t column_count,
             const NearLimits& limits, const PairsSink<SparseRow<Real>>& sink)
      : domain_(domain),
        columns_(columns),
        column_count_(column_count),
        limits_(limits),
        sink_(sink) {}

  PairsReport report = {};

  void solve(const apps::RowSource& source, std::size_t row, const PropagateOptions& options) {
    const TriangleMesh<Real>* sheet = sheet_of(domain_);
    const bool near = source.point() != nullptr && sheet != nullptr &&
                      (D::kind == DomainKind::surface || source.point()->vertex != none);
    if (near && by_windows(options))
      search(sheet->unit(), [&](double radius) { return solve_within(radius, source, options); });
    else if (near && support(Purpose::searches, *sheet, options))
      search(*sheet, *source.point(), options);
    else
      solve_all(source.list(), options);
    apps::keep_nearest(entries_, limits_.nearest);
    sink_.row(row, entries_);
  }

 private:
  void keep(Index vertex, Real distance, double radius) {
    if (distance > static_cast<Real>(radius) || !(distance < infinity)) return;
    columns_.each(vertex, [&](Index column) { entries_.push_back({column, distance}); });
  }

  bool by_windows(const PropagateOptions& options) const {
    const auto cell = with(combination<Serial, D>(), domain_.metric(), options);
    return resolved(options.accuracy, cell) != Accuracy::fast();
  }

  // The entries of the field that was solved; how many vertices it reached.
  std::size_t take(double radius) {
    entries_.clear();
    std::size_t reached = 0;
    for (std::size_t v = 0; v < field_.distance.size(); ++v) {
      reached += field_.distance[v] < infinity;
      keep(static_cast<Index>(v), field_.distance[v], radius);
    }
    account(field_.statistics, field_.complete);
    return reached;
  }

  void solve_all(const SourceList& source, PropagateOptions options) {
    // Along edges nothing within a radius is missed; elsewhere a path may pass a simplex whose
    // centre is beyond it.
    options.radius = D::kind == DomainKind::wireframe ? limits_.radius : infinity;
    plexway::solve(Serial{}, domain_, source, options, workspace_, field_);
    take(limits_.radius);
  }

  // Nor do windows miss anything, but labels that take over from them.
  std::size_t solve_within(double radius, const apps::RowSource& source, PropagateOptions options) {
    options.radius = radius;
    plexway::solve(Serial{}, domain_, source.list(), options, workspace_, field_);
    if (field_.accuracy == Accuracy::fast() && radius < infinity) {
      options.radius = infinity;
      plexway::solve(Serial{}, domain_, source.list(), options, workspace_, field_);
    }
    return take(radius);
  }

  // `look` takes all entries within a radius and returns how much was reached.
  template <class Look>
  void search(double unit, const Look& look) {
    const std::size_t enough = std::min(limits_.nearest, column_count_);
    // A disk with as many vertices as are wanted, were columns spread evenly: the same for all
    // rows, so that a row's bits do not depend on the rows before.
    const double share = static_cast<double>(column_count_) /
                         static_cast<double>(std::max<std::size_t>(domain_.vertex_count(), 1));
    double radius = limits_.nearest == none
                        ? limits_.radius
                        : unit * (2 + std::sqrt(static_cast<double>(enough) / share));
    for (std::size_t reached_before = none;;) {
      radius = std::min(radius, limits_.radius);
      const std::size_t reached = look(radius);
      if (radius >= limits_.radius || entries_.size() >= enough) return;
      // Where nothing more is reached the rest is far away, or not joined.
      radius = reached == reached_before ? infinity : 2 * radius;
      reached_before = reached;
    }
  }

  void search(const TriangleMesh<Real>& sheet, const PointSource& source,
              const PropagateOptions& options) {
    if (!search_) search_ = std::make_unique<BoundedSearch<Real>>(sheet);
    PointSource moved = source;
    if (moved.vertex != none) {
      if (moved.vertex >= domain_.vertex_count())
        throw UsageError("source vertex " + std::to_string(moved.vertex) +
                         " is out of range, there are " + std::to_string(domain_.vertex_count()));
      moved.vertex = on_sheet(domain_, moved.vertex);
    }
    search(sheet.unit(),
           [&](double radius) { return look_within(radius, moved, sheet.unit(), options); });
  }

  // All entries no farther than `radius`, searched an edge farther, so that each is as an endless
  // search has it; how much was reached.
  std::size_t look_within(double radius, const PointSource& source, double unit,
                          PropagateOptions options) {
    for (double margin = 2.5 * unit;;) {
      options.radius = radius + margin;
      const Surroundings<Real>& found =
          search_->find(Serial{}, std::span<const PointSource>(&source, 1), options);
      account(found.statistics, found.complete);
      if (found.longest_edge > margin && options.radius < infinity && found.complete) {
        margin = found.longest_edge;
        continue;
      }
      entries_.clear();
      for (const auto& [vertex, distance, label] : found.vertices) keep(vertex, distance, radius);
      return found.statistics.reached_simplices;
    }
  }

  void account(const PropagateStatistics& statistics, bool complete) {
    apps::add(report.statistics, statistics);
    report.complete = report.complete && complete;
  }

  const D& domain_;
  const ColumnsOfVertex& columns_;
  std::size_t column_count_;
  NearLimits limits_;
  const PairsSink<SparseRow<Real>>& sink_;
  std::unique_ptr<BoundedSearch<Real>> search_;
  WorkspaceOf<Serial, D> workspace_;
  DistanceField<Real> field_;
  std::vector<NearEntry<Real>> entries_;
};

}  // namespace

template <RowExecutor E, DomainType D>
PairsReport near_pairs(const E& executor, const D& domain, const PairsRequest& request,
                       const NearLimits& limits, const PairsSink<SparseRow<RealOf<D>>>& sink) {
  using Worker = NearWorker<D>;
  const std::size_t vertices = domain.vertex_count();
  apps::check(limits, request, vertices);
  const auto* sheet = sheet_of(domain);
  const ColumnsOfVertex columns(columns_on_sheet(domain, request.columns),
                                sheet != nullptr ? sheet->vertex_count() : vertices);
  return apps::deal_rows<E, Worker>(executor, vertices, request, sink.block, [&] {
    return std::make_unique<Worker>(domain, columns, request.column_count(vertices), limits, sink);
  });
}

#define PLEXWAY_PAIRS(...)                                                                \
  template PairsReport near_pairs(const Serial&, const __VA_ARGS__&, const PairsRequest&, \
                                  const NearLimits&,                                      \
                                  const PairsSink<SparseRow<RealOf<__VA_ARGS__>>>&);      \
  template PairsReport near_pairs(const OpenMP&, const __VA_ARGS__&, const PairsRequest&, \
                                  const NearLimits&,                                      \
                                  const PairsSink<SparseRow<RealOf<__VA_ARGS__>>>&);
PLEXWAY_DOMAINS(PLEXWAY_PAIRS)
#undef PLEXWAY_PAIRS

}  // namespace plexway
