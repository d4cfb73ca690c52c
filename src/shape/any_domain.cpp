#include <algorithm>
#include <cstddef>
#include <memory>
#include <mutex>
#include <span>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include <plexway/any_domain.hpp>
#include <plexway/shape/complex.hpp>
#include <plexway/shape/search.hpp>
#include <plexway/shape/support.hpp>
#include <plexway/solve.hpp>

#include "executors/checks.hpp"
#include "executors/threads/share_out.hpp"
#include "shape/files/kept_build.hpp"
#include "shape/inside.hpp"
#include "shape/prepared.hpp"
#include "shape/shape_state.hpp"
#include "shape/with_executor.hpp"

// The two verbs on a domain of any kind.
namespace plexway {
using namespace detail;

AnyField AnyDomain::solve(const AnyExecutor& executor, const SourceList& sources,
                          const PropagateOptions& options) const {
  AnyField field;
  solve(executor, sources, options, field);
  return field;
}

void AnyDomain::solve(const AnyExecutor& executor, const SourceList& sources,
                      const PropagateOptions& options, AnyField& field) const {
  const Inside inside(open_simplices(), sources);
  with_file_name(shape(),
                 [&] { state_->prepared->solve(executor, inside.list(), options, field); });
}

namespace detail {

/// From here on kind, precision and executor are types.
void Prepared::solve(const AnyExecutor& executor, const SourceList& sources,
                     const PropagateOptions& options, AnyField& field) const {
  Workspaces<SolveRoom>::Taken taken(rooms_);
  SolveRoom& room = *taken;
  const Placed at = place(sources, room, field);
  std::visit(
      [&](const auto& complex) {
        if constexpr (requires { *complex; }) {
          using Complex = std::decay_t<decltype(*complex)>;
          with_executor<Complex>(executor, [&](const auto& chosen) {
            using Own = WorkspaceOf<std::decay_t<decltype(chosen)>, Complex>;
            plexway::solve(chosen, *complex, at.sources, options, room.workspace<Own>(),
                           as<DistanceField<RealOf<Complex>>>(at.field.data));
          });
        }
      },
      at.complex);
  take_back(room, field);
  if (open_) open_->spread(field);
}

std::size_t SolveRoom::bytes() const {
  const auto bytes_of = [](const auto& own) -> std::size_t {
    if constexpr (requires { own->bytes(); })
      return own ? own->bytes() : 0;
    else
      return 0;
  };
  const std::size_t distances = std::visit(
      [](const auto& f) { return f.distance.capacity() * sizeof(f.distance[0]); }, other.data);
  return std::apply([&](const auto&... own) { return (distances + ... + bytes_of(own)); },
                    workspaces);
}

}  // namespace detail

namespace {

// What a thread has of its own.
struct Own {
  AnyField field;
  PropagateOptions options;
};

}  // namespace

void AnyDomain::solve_each(const AnyExecutor& executor, const SourceList& sources,
                           const PropagateOptions& options, const TakeField& take) const {
  const auto* team = std::get_if<OpenMP>(&executor);
  if (team == nullptr) {
    AnyField field;
    for (std::size_t k = 0; k < sources.size(); ++k) {
      solve(executor, sources.only(k), options, field);
      take(k, field);
    }
    return;
  }
  std::mutex taking;
  share_out_solves<Own>(*team, sources.size(), options, [&](std::size_t k, Own& own, std::size_t) {
    solve(Serial{}, sources.only(k), own.options, own.field);
    const std::scoped_lock lock(taking);
    take(k, own.field);
  });
}

namespace {

template <class Real>
bool solve_rows(const AnyDomain& domain, const AnyExecutor& executor, const SourceList& sources,
                const PropagateOptions& options, std::span<Real> rows) {
  const std::size_t vertices = domain.vertices();
  check_rows(rows.size(), sources.size(), vertices);
  bool complete = true;
  domain.solve_each(executor, sources, options, [&](std::size_t k, const AnyField& field) {
    std::visit(
        [&](const auto& f) {
          std::transform(f.distance.begin(), f.distance.end(),
                         rows.begin() + static_cast<std::ptrdiff_t>(k * vertices),
                         [](auto d) { return static_cast<Real>(d); });
        },
        field.data);
    complete = complete && field.complete();
  });
  return complete;
}

}  // namespace

bool AnyDomain::solve_each(const AnyExecutor& executor, const SourceList& sources,
                           const PropagateOptions& options, std::span<double> rows) const {
  return solve_rows(*this, executor, sources, options, rows);
}
bool AnyDomain::solve_each(const AnyExecutor& executor, const SourceList& sources,
                           const PropagateOptions& options, std::span<float> rows) const {
  return solve_rows(*this, executor, sources, options, rows);
}

SearchResult find_paths(const AnyDomain& domain, std::span<const PointSource> sources,
                        std::span<const PointSource> targets, const SearchOptions& options) {
  support(Purpose::astar, domain.kind()).require();
  const AnyShape& shape = domain.shape();
  const OpenSimplices* const open = domain.open_simplices();
  const Inside from(open, sources), to(open, targets);
  // Under a metric a straight line in space is no lower bound.
  const bool straight = domain.lengths() == nullptr && !shape.positions().empty();
  SearchResult found;
  const auto search = [&]<class Real>(const TriangleMesh<Real>& mesh) {
    PathSearch<Real> within =
        straight ? PathSearch<Real>(mesh, shape.positions()) : PathSearch<Real>(mesh);
    found = within.find(Serial{}, from.list().points(), to.list().points(), options);
  };
  with_complex(domain, [&](const auto& complex) {
    if constexpr (std::decay_t<decltype(complex)>::kind == DomainKind::surface) search(complex);
  });
  for (Path& path : found.paths) {
    if (open != nullptr) open->outside(path);
    // The search may have known none.
    if (path.positions.empty() && !shape.positions().empty()) place(path, shape);
  }
  return found;
}

AnyDomain::AnyDomain(AnyShape shape, const BuildOptions& options) {
  const Stopwatch building;
  auto prepared = with_file_name(shape, [&] { return prepare(shape, options); });
  state_ = std::make_shared<const State>(State{std::move(shape), std::move(prepared),
                                               BuildOptions{options.precision,
                                                            options.triangulation,
                                                            options.lengths,
                                                            options.mask,
                                                            options.threads,
                                                            {}},
                                               building.seconds()});
}

AnyDomain AnyDomain::masked(std::shared_ptr<const Mask> mask) const {
  BuildOptions options = state_->options;
  options.mask = std::move(mask);
  return AnyDomain(shape(), options);
}

void AnyDomain::keep(const std::filesystem::path& file) const {
  KeptOut out(file);
  // Without what the complex leaves out.
  const auto open = without_collapsed(shape(), nullptr);
  write_kept_shape(out, open ? shape().open_part(*open) : shape(), state_->options);
  state_->prepared->keep(out);
  out.commit();
}

AnyDomain AnyDomain::read(const std::filesystem::path& file, const ReadOptions& reading,
                          const BuildOptions& building) {
  return AnyDomain(AnyShape::read(file, reading), building);
}

const AnyShape& AnyDomain::shape() const { return state_->shape; }
Precision AnyDomain::precision() const { return state_->prepared->precision(); }
std::size_t AnyDomain::simplices() const {
  return open_simplices() != nullptr ? shape().simplices() : state_->prepared->simplices();
}
const MeasuredLengths* AnyDomain::lengths() const { return state_->options.lengths.get(); }
const OpenSimplices* AnyDomain::open_simplices() const { return state_->prepared->open(); }
std::size_t AnyDomain::components() const { return state_->prepared->components(); }
double AnyDomain::mean_edge() const { return state_->prepared->mean_edge(); }
std::size_t AnyDomain::refracting_edges() const { return state_->prepared->refracting_edges(); }
const CloudSummary* AnyDomain::cloud() const { return state_->prepared->cloud(); }
const TriangulationReport& AnyDomain::triangulation() const {
  return state_->prepared->triangulation();
}
double AnyDomain::build_seconds() const { return state_->build_seconds; }
std::size_t AnyDomain::bytes() const { return state_->prepared->bytes(); }

Support AnyDomain::support(const AnyExecutor& executor, const SourceList& sources,
                           const PropagateOptions& options) const {
  const ExecutorKind kind = std::visit([](const auto& e) { return e.kind; }, executor);
  return support_of(state_->prepared->combination(kind), state_->prepared->metric(), sources,
                    options);
}

AnyPathField AnyDomain::path_field(const AnyExecutor& executor,
                                   std::span<const PointSource> sources,
                                   const PropagateOptions& options) const {
  const Inside inside(open_simplices(), sources);
  return AnyPathField(with_file_name(shape(), [&] {
    return state_->prepared->path_field(executor, inside.list().points(), options);
  }));
}

const AnyField& AnyPathField::field() const { return state_->field; }
Path AnyPathField::trace(const PointSource& point, const TraceOptions& options) const {
  return state_->trace(point, options);
}
double AnyPathField::at(const PointSource& point, ReadOut level) const {
  return state_->at(point, level);
}
std::vector<double> AnyPathField::at(std::span<const PointSource> points, ReadOut level) const {
  std::vector<double> distances;
  distances.reserve(points.size());
  for (const PointSource& point : points) distances.push_back(state_->at(point, level));
  return distances;
}
std::vector<std::array<double, 3>> AnyPathField::gradient() const { return state_->gradient(); }
std::size_t AnyPathField::bytes() const { return state_->bytes(); }

AnyComplex complex_of(const AnyDomain& domain) { return domain.state().prepared->complex(); }

namespace detail {

RowComplex row_complex(const AnyDomain& domain, std::span<const PointSource> rows) {
  std::vector<PointSource> inside(rows.begin(), rows.end());
  if (const OpenSimplices* const open = domain.open_simplices())
    for (PointSource& row : inside) row = open->inside(row);
  RowComplex found = domain.state().prepared->row_complex(std::move(inside));
  if (std::holds_alternative<std::monostate>(found.complex))
    found.rows.assign(rows.begin(), rows.end());
  return found;
}

}  // namespace detail

}  // namespace plexway
