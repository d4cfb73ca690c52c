#include <algorithm>
#include <cstddef>
#include <mutex>
#include <span>
#include <type_traits>
#include <variant>

#include <plexway/any_domain.hpp>
#include <plexway/shape/complex.hpp>
#include <plexway/shape/search.hpp>
#include <plexway/shape/support.hpp>
#include <plexway/solve.hpp>

#include "executors/supported.hpp"
#include "executors/threads/share_out.hpp"
#include "shape/inside.hpp"
#include "shape/prepared.hpp"
#include "shape/shape_state.hpp"
#include "shape/with_executor.hpp"

// The two verbs on a domain of any kind.
namespace plexway {

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

/// From here on kind, precision and executor are types.
void Prepared::solve(const AnyExecutor& executor, const SourceList& sources,
                     const PropagateOptions& options, AnyField& field) const {
  Workspaces<SolveRoom>::Taken taken(rooms_);
  SolveRoom& room = *taken;
  const Placed at = place(sources, room, field);
  const auto solve_on = [&](const auto& complex) {
    using Complex = std::decay_t<decltype(complex)>;
    with_executor<Complex>(executor, [&](const auto& chosen) {
      using Own = WorkspaceOf<std::decay_t<decltype(chosen)>, Complex>;
      plexway::solve(chosen, complex, at.sources, options, room.workspace<Own>(),
                     as<DistanceField<RealOf<Complex>>>(at.field.data));
    });
  };
  std::visit(
      [&](const auto& complex) {
        if constexpr (!std::is_same_v<std::decay_t<decltype(complex)>, std::monostate>)
          solve_on(*complex);
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
  detail::share_out_solves<Own>(*team, sources.size(), options,
                                [&](std::size_t k, Own& own, std::size_t) {
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
  detail::check_rows(rows.size(), sources.size(), vertices);
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

}  // namespace plexway
