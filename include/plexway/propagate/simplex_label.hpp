#pragma once

#include <cstddef>
#include <tuple>

#include <plexway/propagate/label_storage.hpp>

namespace plexway {

/// What an N-simplex remembers under the plain step: the virtual source of the best path to its
/// centre, as squared distances to its own vertices. No coordinates.
template <class Real, int N>
struct SimplexLabel {
  Real distance2[N + 1];
  Real sigma;   ///< walked from the source to the virtual source
  Real centre;  ///< distance of the centre
};

/// Labels for whichever dimension a domain has; only that one takes room.
template <class Real>
class SimplexLabels {
 public:
  template <int N>
  SimplexLabel<Real, N>* reserve(std::size_t simplices) {
    return std::get<N - 1>(storage_).reserve(simplices);
  }
  [[nodiscard]] std::size_t bytes() const {
    return std::apply([](const auto&... s) { return (s.bytes() + ...); }, storage_);
  }

 private:
  template <int N>
  using Storage = LabelStorage<SimplexLabel<Real, N>>;
  std::tuple<Storage<1>, Storage<2>, Storage<3>, Storage<4>> storage_;
};

}  // namespace plexway
