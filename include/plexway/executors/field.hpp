#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include <plexway/executors/domain_traits.hpp>
#include <plexway/executors/openmp.hpp>
#include <plexway/executors/serial.hpp>
#include <plexway/executors/serial_cloud.hpp>
#include <plexway/executors/serial_mixed.hpp>
#include <plexway/executors/serial_simplicial.hpp>
#include <plexway/executors/serial_solid.hpp>
#include <plexway/executors/serial_wireframe.hpp>

namespace plexway {

// One field or many? Take care which of the two you mean:
//
//   field(executor, domain, sources)   ONE distance a vertex: to the *nearest* of the sources
//   fields(executor, domain, sources)  K distances a vertex: one *to each* of the K sources

/// Distances of N vertices from each of K sources: row k is the field of source k alone, in the
/// caller's order of vertices and the domain's unit, as DistanceField::distance.
template <class Real>
class Fields {
 public:
  Fields() = default;
  Fields(std::size_t rows, std::size_t columns)
      : values_(std::make_unique_for_overwrite<Real[]>(rows * columns)),
        rows_(rows),
        columns_(columns) {}

  [[nodiscard]] std::size_t rows() const { return rows_; }        ///< K, sources
  [[nodiscard]] std::size_t columns() const { return columns_; }  ///< N, vertices
  /// Row k, not a copy; k < rows().
  [[nodiscard]] std::span<const Real> row(std::size_t k) const {
    return {values_.get() + k * columns_, columns_};
  }
  [[nodiscard]] std::span<Real> row(std::size_t k) {
    return {values_.get() + k * columns_, columns_};
  }
  /// All rows, one after another.
  [[nodiscard]] std::span<const Real> values() const { return {values_.get(), rows_ * columns_}; }
  [[nodiscard]] std::span<Real> values() { return {values_.get(), rows_ * columns_}; }

  bool complete = true;  ///< false if max_expansions ended one of them early

 private:
  std::unique_ptr<Real[]> values_;
  std::size_t rows_ = 0, columns_ = 0;
};

/// ONE field: the distance of every vertex from the *nearest* source, and which one that is. The
/// same as `propagate`, by a name that says so. (For one field a source: `fields`.)
template <class Executor, class Domain>
[[nodiscard]] DistanceField<RealOf<Domain>> field(const Executor& executor, const Domain& domain,
                                                  std::span<const PointSource> sources,
                                                  const PropagateOptions& options = {}) {
  return propagate(executor, domain, sources, options);
}

namespace detail {

/// Calls work(k, thread) for all k < count, thread by thread as they come, until one throws.
/// Throws what the first of them threw. `threads` is at most the team's size.
void share_out(const OpenMP& executor, std::size_t count,
               const std::function<void(std::size_t k, std::size_t thread)>& work);
/// At most so many threads work at once.
[[nodiscard]] std::size_t team_size(const OpenMP& executor);

template <class Domain>
void solve_row(const Domain& domain, const PointSource& source, const PropagateOptions& options,
               WorkspaceOf<Domain>& workspace, DistanceField<RealOf<Domain>>& field,
               std::span<RealOf<Domain>> row) {
  propagate(Serial{}, domain, std::span<const PointSource>(&source, 1), options, workspace, field);
  std::copy(field.distance.begin(), field.distance.end(), row.begin());
}

}  // namespace detail

/// K fields: row k has the distance of every vertex from source k *alone*, one source after the
/// other. (For the distance from the nearest source: `field`.)
///
/// Works for every domain that Serial propagates on, with every option; the bits of each row are
/// those of `propagate` from that source. Throws as that does.
/// Memory: K N numbers for the result, one workspace and one field.
template <class Domain>
[[nodiscard]] Fields<RealOf<Domain>> fields(Serial, const Domain& domain,
                                            std::span<const PointSource> sources,
                                            const PropagateOptions& options = {}) {
  Fields<RealOf<Domain>> fields(sources.size(), detail::field_size(domain));
  WorkspaceOf<Domain> workspace;
  DistanceField<RealOf<Domain>> field;
  for (std::size_t k = 0; k < sources.size(); ++k) {
    detail::solve_row(domain, sources[k], options, workspace, field, fields.row(k));
    fields.complete = fields.complete && field.complete;
  }
  return fields;
}

/// The same with one thread a source, as many at once as the executor has. Each thread does what
/// Serial does, so this is the best use of many cores, scales almost with their number, and takes
/// every option and domain that Serial takes; the bits are the same.
///
/// Memory: K N numbers for the result, and for each thread a workspace and a field (in float about
/// 100 bytes a triangle, 160 a tetrahedron, and 12 a vertex); the domain is shared. Progress is
/// that of the source which the calling thread is at; Cancelled ends all.
template <class Domain>
[[nodiscard]] Fields<RealOf<Domain>> fields(const OpenMP& executor, const Domain& domain,
                                            std::span<const PointSource> sources,
                                            const PropagateOptions& options = {}) {
  struct Own {  // of a thread
    WorkspaceOf<Domain> workspace;
    DistanceField<RealOf<Domain>> field;
    PropagateOptions options;
  };
  Fields<RealOf<Domain>> fields(sources.size(), detail::field_size(domain));
  std::vector<std::unique_ptr<Own>> own(detail::team_size(executor));
  std::atomic<bool> complete{true}, stop{false};
  detail::share_out(executor, sources.size(), [&](std::size_t k, std::size_t thread) {
    std::unique_ptr<Own>& mine = own[thread];
    if (!mine) {
      mine = std::make_unique<Own>();
      mine->options = options;
      if (options.progress)  // the caller's function is for the caller's thread
        mine->options.progress = [&stop, &options, thread](const Progress& progress) {
          if (thread == 0 && !options.progress(progress)) stop = true;
          return !stop;
        };
    }
    detail::solve_row(domain, sources[k], mine->options, mine->workspace, mine->field,
                      fields.row(k));
    if (!mine->field.complete) complete = false;
  });
  fields.complete = complete;
  return fields;
}

}  // namespace plexway
