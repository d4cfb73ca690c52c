#pragma once

#include <memory>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/solve.hpp>

#include "any/linear_field.hpp"
#include "any/path_state.hpp"
#include "any/prepared.hpp"
#include "any/workspaces.hpp"
#include "complex/kept_parts.hpp"
#include "executors/supported.hpp"

#ifdef PLEXWAY_HAS_GL
#include <plexway/executors/gl.hpp>
#endif

namespace plexway {

/// To so many vertices.
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
struct SolveRoom {
  WorkspaceOf<Serial, Complex> workspace;
  std::vector<PointSource> points;  // where they are in the complex
  std::vector<Source> sources;
  DistanceField<RealOf<Complex>> other;
#ifdef PLEXWAY_HAS_GL
  GLWorkspace gl;
#endif

  [[nodiscard]] std::size_t bytes() const {
    std::size_t sum = other.distance.capacity() * sizeof(RealOf<Complex>);
    sum += workspace.bytes();
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
          if constexpr (gl_built_in)
            plexway::solve(chosen, complex, sources, options, room.gl, field);
          else
            refuse_gl();
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

  void keep(KeptOut& out) const override {
    if constexpr (KeptParts::knows<Complex>) KeptParts::keep(out, of());
  }

  void solve(const AnyExecutor& executor, const SourceList& sources,
             const PropagateOptions& options, AnyField& field) const override {
    typename Workspaces<SolveRoom<Complex>>::Taken room(rooms_);
    solve_on(executor, of(), sources, options, *room, as<Real>(field));
    field.triangulation = {};
  }

  std::shared_ptr<const AnyPathField::State> path_field(
      const AnyExecutor& executor, std::span<const PointSource> sources,
      const PropagateOptions& options) const override {
    if constexpr (Complex::kind != DomainKind::mixed && support(Purpose::paths, Complex::kind)) {
      auto state = std::make_shared<PathsOf<Complex>>(shared_from_this(), shape_, of(), measured_);
      state->solve(executor, sources, options);
      return state;
    } else {
      return linear_field(shared_from_this(), shape_, executor, sources, options);
    }
  }

 protected:
  PreparedKind(AnyShape shape, bool measured) : shape_(std::move(shape)), measured_(measured) {}

  [[nodiscard]] virtual const Complex& of() const = 0;

  AnyShape shape_;
  bool measured_;  // by a metric: positions do not tell lengths
  mutable Workspaces<SolveRoom<Complex>> rooms_;
};

}  // namespace plexway
