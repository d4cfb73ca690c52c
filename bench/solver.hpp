#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <plexway/solve.hpp>
#include <plexway/surface/triangle_mesh.hpp>

#include "measure.hpp"

namespace bench {

/// Labels, one a triangle: what tables call fast, and what orders, policies and executors are
/// compared with. What is not asked for by name is windows (`windows` compares both).
inline plexway::PropagateOptions one_label() {
  plexway::PropagateOptions options;
  options.accuracy = plexway::Accuracy::fast();
  return options;
}

/// Of the names fast, accurate and exact; what is usual by any other.
inline plexway::PropagateOptions by_accuracy(const std::string& name) {
  plexway::PropagateOptions options;
  if (name == "fast") options.accuracy = plexway::Accuracy::fast();
  if (name == "accurate") options.accuracy = plexway::Accuracy::accurate();
  if (name == "exact") options.accuracy = plexway::Accuracy::exact();
  return options;
}

/// Solves on a domain from one vertex after another, with what may be used again.
template <class Domain, class Executor = plexway::Serial>
class Solver {
 public:
  using Real = plexway::RealOf<Domain>;
  /// The domain stays the caller's.
  explicit Solver(const Domain& domain, plexway::PropagateOptions options = {},
                  Executor executor = {})
      : domain_(&domain), options_(options), executor_(executor) {}

  void operator()(Index source) { solve(source, options_); }
  void solve(Index source, const plexway::PropagateOptions& options) {
    solve(plexway::PointSource::at(source), options);
  }
  void solve(const plexway::SourceList& sources, const plexway::PropagateOptions& options) {
    plexway::solve(executor_, *domain_, sources, options, workspace_, field_);
  }
  [[nodiscard]] const plexway::DistanceField<Real>& field() const { return field_; }
  [[nodiscard]] const std::vector<Real>& distance() const { return field_.distance; }
  [[nodiscard]] const plexway::PropagateStatistics& statistics() const { return field_.statistics; }
  [[nodiscard]] auto& workspace() { return workspace_; }
  /// Of what solving needs, the field included.
  [[nodiscard]] std::size_t bytes() const {
    return workspace_.bytes() + field_.distance.capacity() * sizeof(Real) +
           field_.label.capacity() * sizeof(Index);
  }

 private:
  const Domain* domain_;
  plexway::PropagateOptions options_;
  Executor executor_;
  plexway::WorkspaceOf<Executor, Domain> workspace_;
  plexway::DistanceField<Real> field_;
};

/// From one source, by one thread, with a workspace of its own.
template <class Domain>
std::vector<plexway::RealOf<Domain>> distances(const Domain& domain,
                                               const plexway::SourceList& sources,
                                               const plexway::PropagateOptions& options = {}) {
  return plexway::solve(plexway::Serial{}, domain, sources, options).distance;
}

}  // namespace bench
