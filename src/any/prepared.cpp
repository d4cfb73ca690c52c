#include "any/prepared.hpp"

#include <algorithm>
#include <mutex>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

#include <plexway/error.hpp>
#include <plexway/solve.hpp>

#include "any/make_complex.hpp"
#include "any/mixed_domain.hpp"
#include "any/path_state.hpp"
#include "any/shape_state.hpp"
#include "any/workspaces.hpp"
#include "executors/checks.hpp"
#include "executors/supported.hpp"

#ifdef PLEXWAY_HAS_GL
#include <plexway/executors/gl.hpp>
#endif

namespace plexway {
namespace {

template <class Real>
void cut(DistanceField<Real>& field, std::size_t vertices) {
  field.distance.resize(vertices);
  if (!field.label.empty()) field.label.resize(vertices);
  if (!field.error.empty()) field.error.resize(vertices);
}

// A field of the right precision, with the memory that it had.
template <class Real>
DistanceField<Real>& as(AnyField& field) {
  if (auto* const kept = std::get_if<DistanceField<Real>>(&field.data)) return *kept;
  return field.data.template emplace<DistanceField<Real>>();
}

/// What a solve changes.
template <class Complex>
struct Room {
  WorkspaceOf<Serial, Complex> workspace;
  std::vector<PointSource> points;  // where they are in the complex
  std::vector<Source> sources;
  DistanceField<RealOf<Complex>> other;
#ifdef PLEXWAY_HAS_GL
  GLWorkspace gl;
#endif

  [[nodiscard]] std::size_t bytes() const {
    std::size_t sum = other.distance.capacity() * sizeof(RealOf<Complex>);
    if constexpr (requires { workspace.bytes(); })
      sum += workspace.bytes();
    else
      for (const auto& piece : workspace.pieces) sum += piece.bytes();
#ifdef PLEXWAY_HAS_GL
    sum += gl.bytes();
#endif
    return sum;
  }
};

template <class Complex, class Room>
void solve_on(const AnyExecutor& executor, const Complex& complex, const SourceList& sources,
              const PropagateOptions& options, Room& room, DistanceField<RealOf<Complex>>& field) {
  std::visit(
      [&](const auto& chosen) {
        using E = std::decay_t<decltype(chosen)>;
        if constexpr (!supports<E, Complex>) {
          support(combination<E, Complex>()).require();
        } else if constexpr (E::kind == ExecutorKind::openmp && !teams_built_in) {
          static_cast<void>(team_size(chosen));  // says that it is not built in
        } else if constexpr (E::kind == ExecutorKind::gl) {
#ifdef PLEXWAY_HAS_GL
          plexway::solve(chosen, complex, sources, options, room.gl, field);
#else
          throw NotBuiltError(
              "the executor GL is not built in; install libegl-dev and build again");
#endif
        } else {
          plexway::solve(chosen, complex, sources, options, room.workspace, field);
        }
      },
      executor);
}

/// What all kinds have in common. A kind brings `complex_`, and says where sources are in it.
template <class Complex>
class PreparedKind : public Prepared {
 public:
  using Real = RealOf<Complex>;

  Precision precision() const final {
    return std::is_same_v<Real, float> ? Precision::single : Precision::twice;
  }
  MetricKind metric() const final { return of().metric(); }
  Combination combination(ExecutorKind executor) const final {
    return {executor, Complex::kind, Complex::dimension, std::is_same_v<Real, float>};
  }
  std::size_t simplices() const override { return of().simplex_count(); }
  std::size_t components() const override {
    if constexpr (requires { of().summary().components; })
      return of().summary().components;
    else
      return 1;
  }
  const CloudSummary* cloud() const final {
    if constexpr (Complex::kind == DomainKind::cloud) return &of().summary();
    return nullptr;
  }
  std::size_t bytes() const override { return of().bytes() + rooms_.bytes(); }
  AnyComplex complex() const override { return &of(); }

  void solve(const AnyExecutor& executor, const SourceList& sources,
             const PropagateOptions& options, AnyField& field) const override {
    typename Workspaces<Room<Complex>>::Taken room(rooms_);
    solve_on(executor, of(), sources, options, *room, as<Real>(field));
    field.triangulation = {};
  }

  std::shared_ptr<const AnyPathField::State> path_field(
      const AnyExecutor& executor, std::span<const PointSource> sources,
      const PropagateOptions& options) const override {
    if constexpr (has_paths<Complex>) {
      auto state = std::make_shared<PathsOf<Complex>>(shared_from_this(), shape_, of(), measured_);
      state->solve(executor, sources, options);
      return state;
    } else {
      throw UsageError("paths are traced on surfaces, solids, wireframes and clouds");
    }
  }

 protected:
  PreparedKind(AnyShape shape, bool measured) : shape_(std::move(shape)), measured_(measured) {}

  [[nodiscard]] virtual const Complex& of() const = 0;

  AnyShape shape_;
  bool measured_;  // by a metric: positions do not tell lengths
  mutable Workspaces<Room<Complex>> rooms_;
};

/// Solids, wireframes, clouds and simplices: solved as they are.
template <class Complex>
class PreparedPlain final : public PreparedKind<Complex> {
 public:
  template <class Make>
  PreparedPlain(const AnyShape& shape, bool measured, const Make& make)
      : PreparedKind<Complex>(shape, measured), complex_(make()) {}

 private:
  const Complex& of() const override { return complex_; }

  Complex complex_;
};

/// Surfaces, which may be solved on other triangles than theirs.
template <class Real>
class PreparedSurface final : public PreparedKind<TriangleMesh<Real>> {
  using Base = PreparedKind<TriangleMesh<Real>>;

 public:
  PreparedSurface(const AnyShape& shape, const BuildOptions& options,
                  const MeasuredLengths* lengths)
      : Base(shape, lengths != nullptr),
        kept_(options.lengths),
        lengths_(lengths),
        left_open_(options.triangulation == Triangulation::automatic),
        made_(make_surface<Real>(options.triangulation, making(), report_)) {}

  std::size_t simplices() const override { return this->shape_.simplices(); }
  double mean_edge() const override { return made_.mesh.unit(); }
  std::size_t refracting_edges() const override { return made_.mesh.summary().refracting_edges; }
  const TriangulationReport& triangulation() const override { return report_; }
  std::size_t bytes() const override {
    return Base::bytes() + (made_.delaunay ? made_.delaunay->bytes() : 0) +
           (input_ ? input_->bytes() : 0);
  }
  AnyComplex complex() const override { return &input(); }

  void solve(const AnyExecutor& executor, const SourceList& sources,
             const PropagateOptions& options, AnyField& field) const override {
    typename Workspaces<Room<TriangleMesh<Real>>>::Taken taken(this->rooms_);
    Room<TriangleMesh<Real>>& room = *taken;
    DistanceField<Real>& found = as<Real>(field);
    field.triangulation = report_;
    if (!made_.delaunay) {
      solve_on(executor, made_.mesh, sources, options, room, found);
      return;
    }
    if (!sources.only_points() && has_shapes(sources.sources())) {
      if (!left_open_)
        throw UsageError(
            "curves and triangles lie in the triangles of the shape: leave its triangulation as "
            "it is");
      field.triangulation = {};
      solve_on(executor, input(), sources, options, room, found);
      return;
    }
    solve_on(executor, made_.mesh, moved(sources, room), options, room, found);
    cut(found, this->shape_.vertices());
    // Which triangles are better was only guessed.
    if (!sources.only_points() || !left_open_ || 50 * repairs(found) <= found.distance.size())
      return;
    if (std::holds_alternative<GL>(executor)) return;
    solve_on(executor, input(), sources, options, room, room.other);
    if (room.other.distance.empty() || repairs(room.other) >= repairs(found)) return;
    std::swap(room.other, found);
    field.triangulation = {};
  }

  std::shared_ptr<const AnyPathField::State> path_field(
      const AnyExecutor& executor, std::span<const PointSource> sources,
      const PropagateOptions& options) const override {
    auto state = std::make_shared<PathsOf<TriangleMesh<Real>>>(
        this->shared_from_this(), this->shape_, input(), this->measured_);
    if (!elsewhere()) {
      state->solve(executor, sources, options);
      return state;
    }
    AnyField field;
    solve(executor, SourceList(sources), options, field);
    if (field.triangulation.done == Triangulation::input)
      state->solve(executor, sources, options);
    else
      state->adopt(executor, std::move(field), sources, options,
                   {&made_.mesh, [this](const PointSource& point) {
                      return made_.delaunay->to_intrinsic(point);
                    }});
    return state;
  }

 private:
  [[nodiscard]] Making making() const { return {this->shape_, lengths_}; }
  const TriangleMesh<Real>& of() const override { return made_.mesh; }

  // Are there other triangles than the shape's?
  [[nodiscard]] bool elsewhere() const { return report_.flips + report_.inserted_vertices > 0; }

  // On the shape's own triangles.
  [[nodiscard]] const TriangleMesh<Real>& input() const {
    if (!elsewhere()) return made_.mesh;
    std::call_once(input_once_, [&] {
      input_.emplace(make_complex<Real>(std::get<io::Triangles>(this->shape_.data()), making()));
    });
    return *input_;
  }

  static std::size_t repairs(const DistanceField<Real>& field) {
    return field.statistics.raised_vertices + field.statistics.lowered_vertices;
  }

  static bool has_shapes(std::span<const Source> sources) {
    return std::any_of(sources.begin(), sources.end(), [](const Source& source) {
      return std::holds_alternative<CurveSource>(source) ||
             std::holds_alternative<SimplexSource>(source);
    });
  }

  // Where a point of the input is in the other triangles, which would take what lies outside of its
  // triangle to the nearest place.
  PointSource moved(const PointSource& point) const {
    check_source(point, {this->shape_.vertices(), this->shape_.simplices(), "face", 3});
    return made_.delaunay->to_intrinsic(point);
  }

  SourceList moved(const SourceList& sources, Room<TriangleMesh<Real>>& room) const {
    if (sources.only_points()) {
      room.points.clear();
      for (const PointSource& point : sources.points()) room.points.push_back(moved(point));
      return SourceList(std::span<const PointSource>(room.points));
    }
    room.sources.assign(sources.sources().begin(), sources.sources().end());
    for (Source& source : room.sources) {
      if (auto* point = std::get_if<PointSource>(&source)) *point = moved(*point);
      if (auto* ball = std::get_if<BallSource>(&source)) ball->centre = moved(ball->centre);
    }
    return SourceList(std::span<const Source>(room.sources));
  }

  std::shared_ptr<const MeasuredLengths> kept_;
  const MeasuredLengths* lengths_;
  bool left_open_;
  TriangulationReport report_;
  TriangulatedSurface<Real> made_;
  mutable std::once_flag input_once_;
  mutable std::optional<TriangleMesh<Real>> input_;
};

/// Mixed domains: their pieces have vertices and simplices of their own.
template <class Real>
class PreparedMixed final : public PreparedKind<MixedComplex<Real>> {
  using Base = PreparedKind<MixedComplex<Real>>;

 public:
  PreparedMixed(const AnyShape& shape, const MeasuredLengths* lengths)
      : Base(shape, lengths != nullptr),
        pieces_(std::get<MixedShape>(shape.data()),
                lengths == nullptr ? std::span<const double>() : lengths->speeds) {
    count_components();
  }

  std::size_t components() const override { return components_; }
  std::size_t bytes() const override {
    return Base::bytes() + (pieces_.vertex.capacity() + pieces_.simplex.capacity()) * sizeof(Index);
  }

  void solve(const AnyExecutor& executor, const SourceList& sources,
             const PropagateOptions& options, AnyField& field) const override {
    typename Workspaces<Room<MixedComplex<Real>>>::Taken taken(this->rooms_);
    Room<MixedComplex<Real>>& room = *taken;
    DistanceField<Real>& found = as<Real>(field);
    solve_on(executor, pieces_.complex, moved(sources, room), options, room, room.other);
    const auto pick = [&](const auto& from, auto& to, auto nothing) {
      to.clear();
      if (from.empty()) return;
      for (const Index v : pieces_.vertex) to.push_back(v == none ? nothing : from[v]);
    };
    pick(room.other.distance, found.distance, std::numeric_limits<Real>::infinity());
    pick(room.other.label, found.label, none);
    pick(room.other.error, found.error, Real(0));
    found.accuracy = room.other.accuracy;
    found.complete = room.other.complete;
    found.statistics = room.other.statistics;
    field.triangulation = {};
  }

 private:
  const MixedComplex<Real>& of() const override { return pieces_.complex; }

  [[nodiscard]] Index vertex(Index outer) const {
    if (outer >= pieces_.vertex.size())
      throw UsageError("vertex " + std::to_string(outer) + " is not in the domain");
    if (pieces_.vertex[outer] == none)
      throw UsageError("vertex " + std::to_string(outer) + " is in no simplex of the mixed domain");
    return pieces_.vertex[outer];
  }
  [[nodiscard]] Index simplex(Index outer) const {
    if (outer >= pieces_.simplex.size())
      throw UsageError("simplex " + std::to_string(outer) + " is not in the domain");
    return pieces_.simplex[outer];
  }
  void move(PointSource& point) const {
    if (point.vertex != none)
      point.vertex = vertex(point.vertex);
    else if (point.simplex != none)
      point.simplex = simplex(point.simplex);
  }

  SourceList moved(const SourceList& sources, Room<MixedComplex<Real>>& room) const {
    if (sources.only_points()) {
      room.points.assign(sources.points().begin(), sources.points().end());
      for (PointSource& point : room.points) move(point);
      return SourceList(std::span<const PointSource>(room.points));
    }
    room.sources.assign(sources.sources().begin(), sources.sources().end());
    for (Source& source : room.sources) {
      if (auto* point = std::get_if<PointSource>(&source)) move(*point);
      if (auto* ball = std::get_if<BallSource>(&source)) move(ball->centre);
      if (auto* set = std::get_if<VertexSource>(&source))
        for (Index& v : set->vertices) v = vertex(v);
      if (auto* curve = std::get_if<CurveSource>(&source))
        for (PointSource& point : curve->points) move(point);
      if (auto* one = std::get_if<SimplexSource>(&source)) one->simplex = simplex(one->simplex);
    }
    return SourceList(std::span<const Source>(room.sources));
  }

  // Of simplices that vertices join, or vertices that are one.
  void count_components() {
    std::vector<Index> up(pieces_.complex.vertex_count());
    for (Index v = 0; v < up.size(); ++v) up[v] = v;
    const auto top = [&](Index v) {
      while (up[v] != v) v = up[v] = up[up[v]];
      return v;
    };
    const auto join = [&](Index a, Index b) { up[top(a)] = top(b); };
    for (std::size_t s = 0; s < this->shape_.simplices(); ++s) {
      const auto corners = this->shape_.corners(s);
      for (const Index v : corners) join(pieces_.vertex[v], pieces_.vertex[corners[0]]);
    }
    for (const auto& [a, b] : pieces_.complex.outer_welds()) join(a, b);
    std::vector<bool> seen(up.size(), false);
    for (const Index v : pieces_.vertex)
      if (v != none && !seen[top(v)]) seen[top(v)] = true, ++components_;
  }

  MixedPieces<Real> pieces_;
  std::size_t components_ = 0;
};

template <class Real, int N>
std::shared_ptr<const Prepared> prepare_simplices(const AnyShape& shape) {
  using Complex = SimplicialComplex<Real, N>;
  const auto& given = std::get<SimplexShape>(shape.data());
  constexpr std::size_t corners = N + 1, edges = SimplexLayout<N>::edges;
  std::vector<typename Complex::Corners> simplices(given.corners.size() / corners);
  for (std::size_t i = 0; i < given.corners.size(); ++i)
    simplices[i / corners][i % corners] = given.corners[i];
  return std::make_shared<PreparedPlain<Complex>>(shape, given.axes == 0, [&]() -> Complex {
    if (given.axes > 0) return {given.positions, given.axes, simplices};
    std::vector<typename Complex::Lengths> lengths(simplices.size());
    for (std::size_t i = 0; i < given.lengths.size(); ++i)
      lengths[i / edges][i % edges] = given.lengths[i];
    return {given.vertices, simplices, lengths};
  });
}

template <class Real>
std::shared_ptr<const Prepared> prepare_as(const AnyShape& shape, const BuildOptions& options) {
  const MeasuredLengths* const lengths = options.lengths ? options.lengths.get() : shape.lengths();
  const Making making{shape, lengths, options.progress};
  return std::visit(
      [&](const auto& data) -> std::shared_ptr<const Prepared> {
        using Data = std::decay_t<decltype(data)>;
        if constexpr (std::is_same_v<Data, io::Triangles>) {
          return std::make_shared<PreparedSurface<Real>>(shape, options, lengths);
        } else if constexpr (std::is_same_v<Data, MixedShape>) {
          return std::make_shared<PreparedMixed<Real>>(shape, lengths);
        } else if constexpr (std::is_same_v<Data, SimplexShape>) {
          switch (data.dimension) {
            case 1:
              return prepare_simplices<Real, 1>(shape);
            case 2:
              return prepare_simplices<Real, 2>(shape);
            case 3:
              return prepare_simplices<Real, 3>(shape);
            default:
              return prepare_simplices<Real, 4>(shape);
          }
        } else {
          using Complex = decltype(make_complex<Real>(data, making));
          return std::make_shared<PreparedPlain<Complex>>(
              shape, lengths != nullptr, [&] { return make_complex<Real>(data, making); });
        }
      },
      shape.data());
}

}  // namespace

std::shared_ptr<const Prepared> prepare(const AnyShape& shape, const BuildOptions& options) {
  const bool asked = options.triangulation == Triangulation::delaunay ||
                     options.triangulation == Triangulation::refined;
  if (asked && shape.kind() != DomainKind::surface)
    throw UsageError("a " + std::string(kind_noun(shape.kind())) +
                     " has no triangles to flip: leave its triangulation as it is");
  const bool measurable =
      shape.kind() == DomainKind::surface || shape.kind() == DomainKind::solid ||
      shape.kind() == DomainKind::wireframe || shape.kind() == DomainKind::mixed;
  if (options.lengths && !measurable)
    throw UsageError("a metric is for surfaces, solids, wireframes and mixed domains, not a " +
                     std::string(kind_noun(shape.kind())));
  return options.precision == Precision::single ? prepare_as<float>(shape, options)
                                                : prepare_as<double>(shape, options);
}

}  // namespace plexway
