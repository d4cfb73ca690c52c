#pragma once

#include <memory>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/paths/cloud_path_field.hpp>
#include <plexway/paths/path_field.hpp>
#include <plexway/solve.hpp>

#include "complexes/common/kept_archive.hpp"
#include "shape/prepared.hpp"
#include "shape/shape_state.hpp"
#include "shape/with_executor.hpp"

namespace plexway::detail {

/// Where paths are drawn; lengths of their own are not those between positions.
inline std::span<const std::array<double, 3>> path_places(const AnyShape& shape, bool measured) {
  if (measured) return {};
  if (shape.cloud() != nullptr) return shape.cloud()->measured();
  if (const auto* wireframe = std::get_if<io::Edges>(&shape.data()))
    if (!wireframe->lengths.empty()) return {};
  return shape.positions();
}

template <class Complex>
class PathsOf final : public AnyPathField::State {
 public:
  using Real = RealOf<Complex>;

  /// `paths` are made of what follows the places.
  template <class... Other>
  PathsOf(std::shared_ptr<const Prepared> keep, AnyShape shape, bool measured,
          const Complex& complex, const Other&... other)
      : keep_(std::move(keep)),
        shape_(std::move(shape)),
        complex_(complex),
        measured_(measured),
        paths_(complex, other..., path_places(shape_, measured)) {}

  void solve(const AnyExecutor& executor, std::span<const PointSource> sources,
             const PropagateOptions& options) {
    with_executor<Complex>(executor,
                           [&](const auto& chosen) { paths_.solve(chosen, sources, options); });
    field.data = paths_.distances();
    if (const OpenSimplices* const open = keep_->open()) open->spread(field);
  }

  Path trace(const PointSource& outside, const TraceOptions& options) const override {
    Path path = paths_.trace(inside(outside), options);
    if (const OpenSimplices* const open = keep_->open()) open->outside(path);
    if (measured_ && !shape_.positions().empty() && shape_.cloud() == nullptr) place(path, shape_);
    return path;
  }

  double at(const PointSource& outside, ReadOut level) const override {
    if constexpr (requires { paths_.at(outside, level); }) {
      return paths_.at(inside(outside), level);
    } else {
      support(Purpose::read_out, complex_).require();
      return 0;
    }
  }

  std::vector<std::array<double, 3>> gradient() const override {
    if constexpr (requires { paths_.gradient(); }) {
      std::vector<std::array<double, 3>> found = paths_.gradient();
      const OpenSimplices* const open = keep_->open();
      if (open == nullptr) return found;
      std::vector<std::array<double, 3>> all(shape_.simplices(), {0, 0, 0});
      for (Index s = 0; s < found.size(); ++s) all[open->outside(s)] = found[s];
      return all;
    } else {
      support(Purpose::directions, complex_).require();
      return {};
    }
  }

  std::size_t bytes() const override { return paths_.bytes(); }

 private:
  PointSource inside(const PointSource& point) const {
    const OpenSimplices* const open = keep_->open();
    return open == nullptr ? point : open->inside(point);
  }

  std::shared_ptr<const Prepared> keep_;
  AnyShape shape_;
  const Complex& complex_;
  bool measured_;
  PathField<Complex> paths_;
};

/// To so many vertices.
template <class Real>
void cut(DistanceField<Real>& field, std::size_t vertices) {
  field.distance.resize(vertices);
  if (!field.label.empty()) field.label.resize(vertices);
  if (!field.error.empty()) field.error.resize(vertices);
}

/// What all kinds have in common. A kind brings `complex_`, and says where sources are in it.
template <class Complex>
class PreparedKind : public Prepared {
 public:
  using Real = RealOf<Complex>;

  Precision precision() const final {
    return std::is_same_v<Real, float> ? Precision::float32 : Precision::float64;
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
  std::size_t bytes() const override { return of().bytes() + room_bytes(); }
  AnyComplex complex() const override { return &of(); }

  void keep(KeptOut& out) const override {
    if constexpr (KeptParts::knows<Complex>) KeptParts::keep(out, of());
  }

  std::shared_ptr<const AnyPathField::State> path_field(
      const AnyExecutor& executor, std::span<const PointSource> sources,
      const PropagateOptions& options) const override {
    if constexpr (Complex::kind != DomainKind::mixed && support(Purpose::paths, Complex::kind)) {
      auto state = std::make_shared<PathsOf<Complex>>(shared_from_this(), shape_, measured_, of());
      state->solve(executor, sources, options);
      return state;
    } else {
      return std::make_shared<LinearField>(shared_from_this(), shape_, executor, sources, options);
    }
  }

 protected:
  PreparedKind(AnyShape shape, bool measured) : shape_(std::move(shape)), measured_(measured) {}

  [[nodiscard]] virtual const Complex& of() const = 0;

  AnyShape shape_;
  bool measured_;  // by a metric: positions do not tell lengths
};

}  // namespace plexway::detail
