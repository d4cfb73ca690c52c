#pragma once

#include <memory>
#include <span>

#include <plexway/any/complex.hpp>
#include <plexway/any_domain.hpp>

#include "any/row_complex.hpp"
#include "complex/kept_archive.hpp"

namespace plexway {

/// Has this build teams of threads? Where it has none their code is not compiled in either, which
/// is a seventh of the page's module.
#ifdef PLEXWAY_HAS_TEAMS
inline constexpr bool teams_built_in = true;
#else
inline constexpr bool teams_built_in = false;
#endif

/// Has it devices? Where it has none, says so.
#ifdef PLEXWAY_HAS_GL
inline constexpr bool gl_built_in = true;
#else
inline constexpr bool gl_built_in = false;
#endif
[[noreturn]] void refuse_gl();

/// A complex made ready for distances, its precision and its kind hidden. Any number of threads may
/// solve at once.
class Prepared : public std::enable_shared_from_this<Prepared> {
 public:
  virtual ~Prepared() = default;
  Prepared() = default;
  Prepared(const Prepared&) = delete;
  Prepared& operator=(const Prepared&) = delete;

  /// Which simplices of the shape the complex has, whose numbers are theirs inside; null: all.
  [[nodiscard]] const OpenSimplices* open() const { return open_.get(); }

  [[nodiscard]] virtual Precision precision() const = 0;
  [[nodiscard]] virtual std::size_t simplices() const = 0;
  [[nodiscard]] virtual std::size_t components() const = 0;
  [[nodiscard]] virtual double mean_edge() const { return 0; }
  [[nodiscard]] virtual std::size_t refracting_edges() const { return 0; }
  [[nodiscard]] virtual const CloudSummary* cloud() const { return nullptr; }
  [[nodiscard]] virtual const TriangulationReport& triangulation() const {
    static const TriangulationReport as_given;
    return as_given;
  }
  [[nodiscard]] virtual std::size_t bytes() const = 0;
  [[nodiscard]] virtual MetricKind metric() const = 0;
  [[nodiscard]] virtual Combination combination(ExecutorKind executor) const = 0;
  [[nodiscard]] virtual AnyComplex complex() const = 0;
  /// What `solve` takes for points of the complex.
  [[nodiscard]] virtual RowComplex row_complex(std::vector<PointSource> points) const {
    return {complex(), std::move(points)};
  }

  /// Sources are in the complex: see `open`. So in path_field; what is asked of that is in the
  /// shape.
  virtual void solve(const AnyExecutor& executor, const SourceList& sources,
                     const PropagateOptions& options, AnyField& field) const = 0;
  /// The complex alone.
  virtual void keep(KeptOut& out) const = 0;
  [[nodiscard]] virtual std::shared_ptr<const AnyPathField::State> path_field(
      const AnyExecutor& executor, std::span<const PointSource> sources,
      const PropagateOptions& options) const = 0;

 private:
  friend std::shared_ptr<const Prepared> prepare(const AnyShape& shape,
                                                 const BuildOptions& options);

  std::unique_ptr<const OpenSimplices> open_;
};

struct AnyPathField::State {
  AnyField field;

  virtual ~State() = default;
  [[nodiscard]] virtual Path trace(const PointSource& point, const TraceOptions& options) const = 0;
  [[nodiscard]] virtual double at(const PointSource& point, ReadOut level) const = 0;
  [[nodiscard]] virtual std::vector<std::array<double, 3>> gradient() const = 0;
  [[nodiscard]] virtual std::size_t bytes() const = 0;
};

/// Builds the complex of a shape. `shape` is kept.
std::shared_ptr<const Prepared> prepare(const AnyShape& shape, const BuildOptions& options);

}  // namespace plexway
