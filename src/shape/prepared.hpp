#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

#include <plexway/any_domain.hpp>
#include <plexway/shape/complex.hpp>
#include <plexway/solve/workspace.hpp>

#include "complexes/common/kept_archive.hpp"
#include "shape/inside.hpp"

#ifdef PLEXWAY_HAS_GL
#include <plexway/executors/gl.hpp>
#endif

namespace plexway::detail {

/// Workspaces that wait for the next solve. A solve takes one, or a new one where all are taken,
/// and brings it back: as many are held as solves ran at once.
template <class Workspace>
class Workspaces {
 public:
  /// One in use: brought back at the end of its life.
  class Taken {
   public:
    explicit Taken(Workspaces& from) : from_(from) {
      const std::scoped_lock lock(from_.mutex_);
      if (from_.waiting_.empty()) return;
      own_ = std::move(from_.waiting_.back());
      from_.waiting_.pop_back();
    }
    ~Taken() {
      const std::scoped_lock lock(from_.mutex_);
      from_.waiting_.push_back(std::move(own_));
    }
    Taken(const Taken&) = delete;
    Taken& operator=(const Taken&) = delete;

    Workspace& operator*() {
      if (!own_) own_ = std::make_unique<Workspace>();
      return *own_;
    }

   private:
    Workspaces& from_;
    std::unique_ptr<Workspace> own_;
  };

  /// Of those that wait.
  [[nodiscard]] std::size_t bytes() const {
    const std::scoped_lock lock(mutex_);
    std::size_t sum = 0;
    for (const auto& one : waiting_)
      if (one) sum += one->bytes();
    return sum;
  }

 private:
  mutable std::mutex mutex_;
  std::vector<std::unique_ptr<Workspace>> waiting_;
};

/// The one of type T, with the memory that it had.
template <class T, class... Types>
T& as(std::variant<Types...>& any) {
  if (T* const kept = std::get_if<T>(&any)) return *kept;
  return any.template emplace<T>();
}

/// What a solve changes.
struct SolveRoom {
#ifdef PLEXWAY_HAS_GL
  using Device = GLWorkspace;
#else
  using Device = std::monostate;
#endif
  std::tuple<std::optional<Workspace<float>>, std::optional<Workspace<double>>,
             std::optional<Device>>
      workspaces;
  std::vector<PointSource> points;  ///< where they are in the complex
  std::vector<Source> sources;
  AnyField other;  ///< where the complex numbers vertices in its own way

  /// Of executors that keep one such.
  template <class Kept>
  [[nodiscard]] Kept& workspace() {
    auto& own = std::get<std::optional<Kept>>(workspaces);
    if (!own) own.emplace();
    return *own;
  }
  [[nodiscard]] std::size_t bytes() const;

  /// The sources with their places moved, by what each_place calls.
  template <class Point, class Vertex, class Simplex>
  [[nodiscard]] SourceList moved(const SourceList& from, const Point& point, const Vertex& vertex,
                                 const Simplex& simplex) {
    if (from.only_points()) {
      points.assign(from.points().begin(), from.points().end());
      for (PointSource& one : points) point(one);
      return SourceList(std::span<const PointSource>(points));
    }
    sources.assign(from.sources().begin(), from.sources().end());
    for (Source& one : sources) each_place(one, point, vertex, simplex);
    return SourceList(std::span<const Source>(sources));
  }
};

/// What is solved for a field of the shape.
struct Placed {
  AnyComplex complex;
  SourceList sources;
  AnyField& field;
};

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
  void solve(const AnyExecutor& executor, const SourceList& sources,
             const PropagateOptions& options, AnyField& field) const;
  /// The complex alone.
  virtual void keep(KeptOut& out) const = 0;
  [[nodiscard]] virtual std::shared_ptr<const AnyPathField::State> path_field(
      const AnyExecutor& executor, std::span<const PointSource> sources,
      const PropagateOptions& options) const = 0;

 protected:
  [[nodiscard]] std::size_t room_bytes() const { return rooms_.bytes(); }

 private:
  /// On what a field from `sources` is solved; take_back makes it one of the shape.
  [[nodiscard]] virtual Placed place(const SourceList& sources, SolveRoom& /*room*/,
                                     AnyField& field) const {
    field.triangulation = {};
    return {complex(), sources, field};
  }
  virtual void take_back(SolveRoom& /*room*/, AnyField& /*field*/) const {}

  friend std::shared_ptr<const Prepared> prepare(const AnyShape& shape,
                                                 const BuildOptions& options);

  std::unique_ptr<const OpenSimplices> open_;
  mutable Workspaces<SolveRoom> rooms_;
};

}  // namespace plexway::detail

namespace plexway {

struct AnyDomain::State {
  AnyShape shape;
  std::shared_ptr<const detail::Prepared> prepared;
  BuildOptions options;  // as requested, without progress
  double build_seconds = 0;
};

struct AnyPathField::State {
  AnyField field;

  virtual ~State() = default;
  [[nodiscard]] virtual Path trace(const PointSource& point, const TraceOptions& options) const = 0;
  [[nodiscard]] virtual double at(const PointSource& point, ReadOut level) const = 0;
  [[nodiscard]] virtual std::vector<std::array<double, 3>> gradient() const = 0;
  [[nodiscard]] virtual std::size_t bytes() const = 0;
};

}  // namespace plexway

namespace plexway::detail {

/// Builds the complex of a shape. `shape` is kept.
std::shared_ptr<const Prepared> prepare(const AnyShape& shape, const BuildOptions& options);

/// A field that is read by its vertices' distances alone, linear within simplices: of mixed domains
/// and complexes of simplices. Other levels and paths are for those that derive from it.
class LinearField : public AnyPathField::State {
 public:
  /// Solves on `domain`, which it keeps.
  LinearField(std::shared_ptr<const Prepared> domain, const AnyShape& shape,
              const AnyExecutor& executor, std::span<const PointSource> sources,
              const PropagateOptions& options);

  [[nodiscard]] Path trace(const PointSource& point, const TraceOptions& options) const override;
  [[nodiscard]] double at(const PointSource& point, ReadOut level) const final;
  [[nodiscard]] std::vector<std::array<double, 3>> gradient() const final;
  [[nodiscard]] std::size_t bytes() const final { return field.size() * sizeof(double); }

 protected:
  /// Within a simplex, as exactly as it goes.
  [[nodiscard]] virtual double read(const PointSource& point) const;

  std::shared_ptr<const Prepared> domain_;
  AnyShape shape_;
};

}  // namespace plexway::detail
