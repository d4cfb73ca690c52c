#pragma once

#include <memory>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/solve.hpp>

#include "complexes/common/kept_parts.hpp"
#include "shape/path_state.hpp"
#include "shape/prepared.hpp"
#include "shape/warnings/linear_field.hpp"

namespace plexway {

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
      return linear_field(shared_from_this(), shape_, executor, sources, options);
    }
  }

 protected:
  PreparedKind(AnyShape shape, bool measured) : shape_(std::move(shape)), measured_(measured) {}

  [[nodiscard]] virtual const Complex& of() const = 0;

  AnyShape shape_;
  bool measured_;  // by a metric: positions do not tell lengths
};

}  // namespace plexway
