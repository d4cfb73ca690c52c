#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <plexway/propagate/distance_field.hpp>
#include <plexway/propagate/options.hpp>
#include <plexway/source/source.hpp>

#include "domain.hpp"
#include "executor_argument.hpp"
#include "metric_options.hpp"
#include "solve_options.hpp"
#include "triangulation_option.hpp"

namespace plexway::cli {

/// A domain made ready for distances, its precision and its kind hidden.
///
/// Keeps complex, workspace and field, so that `solve` may be timed again and again.
class Solver {
 public:
  virtual ~Solver() = default;
  Solver() = default;
  Solver(const Solver&) = delete;
  Solver& operator=(const Solver&) = delete;

  [[nodiscard]] virtual std::size_t components() const = 0;
  /// Of the complex: a cloud has triangles only there. Without those of a refinement.
  [[nodiscard]] virtual std::size_t simplices() const = 0;
  /// Which triangles a surface was solved on: where it was left open and the solve on others left
  /// much to repair, those of the input after all.
  [[nodiscard]] virtual TriangulationReport triangulation() const { return {}; }
  /// Mean length of the edges of a surface; else 0.
  [[nodiscard]] virtual double mean_edge() const { return 0; }
  /// What a cloud was made into, or null.
  [[nodiscard]] virtual const CloudSummary* cloud() const { return nullptr; }
  /// Edges where paths are refracted.
  [[nodiscard]] virtual std::size_t refracting_edges() const { return 0; }
  /// One propagation, read-out to vertices included. Throws as plexway::solve.
  virtual void solve(const Executor& executor, std::span<const PointSource> sources,
                     const PropagateOptions& options) = 0;
  /// The same from sources of any kind.
  virtual void solve_from(const Executor& executor, std::span<const Source> sources,
                          const PropagateOptions& options) = 0;

  // Of the last solve.
  [[nodiscard]] virtual std::vector<double> distance() const = 0;
  /// Nearest source of each vertex, -1 where unreached; empty for a single source.
  [[nodiscard]] virtual std::vector<std::int32_t> label() const = 0;
  /// Estimates of each distance's error; empty for Accuracy::fast().
  [[nodiscard]] virtual std::vector<double> error() const = 0;
  [[nodiscard]] virtual Accuracy accuracy() const = 0;
  [[nodiscard]] virtual const PropagateStatistics& statistics() const = 0;
  [[nodiscard]] virtual bool complete() const = 0;

  /// Bytes held: complex, workspace and field.
  [[nodiscard]] virtual std::size_t bytes() const = 0;
};

/// Builds the complex, by the lengths of a metric where there is one, and refers to both. Throws
/// InputError "FILE: cause", and UsageError as check_triangulation.
std::unique_ptr<Solver> make_solver(const Domain& domain, Precision precision,
                                    Triangulation triangulation = Triangulation::input,
                                    const MeasuredLengths* lengths = nullptr);

}  // namespace plexway::cli
