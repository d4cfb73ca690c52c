#pragma once

#include <cstddef>
#include <tuple>

#include "labels/label_memory.hpp"

namespace plexway::detail {

/// What an N-simplex remembers under the plain step: the virtual source of the best path to its
/// centre, as squared distances to its own vertices. No coordinates.
template <class Real, int N>
struct SimplexLabel {
  Real distance2[N + 1];
  Real sigma;   ///< walked from the source to the virtual source
  Real centre;  ///< distance of the centre
};

/// Labels for whichever dimension a domain has; only these take room.
template <class Real>
class SimplexLabels {
 public:
  template <int N>
  SimplexLabel<Real, N>* reserve(std::size_t count) {
    return std::get<LabelStorage<SimplexLabel<Real, N>>>(storage_).reserve(count);
  }
  /// Those that there is room for, or null.
  template <int N>
  [[nodiscard]] const SimplexLabel<Real, N>* labels() const {
    return std::get<LabelStorage<SimplexLabel<Real, N>>>(storage_).labels.get();
  }
  [[nodiscard]] std::size_t bytes() const {
    return std::apply([](const auto&... s) { return (s.bytes() + ...); }, storage_);
  }

 private:
  std::tuple<LabelStorage<SimplexLabel<Real, 1>>, LabelStorage<SimplexLabel<Real, 2>>,
             LabelStorage<SimplexLabel<Real, 3>>, LabelStorage<SimplexLabel<Real, 4>>>
      storage_;
};

}  // namespace plexway::detail
