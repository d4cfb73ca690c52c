#pragma once

#include <cstddef>
#include <vector>

#include <plexway/common/ids.hpp>

#include "labels/front.hpp"
#include "labels/wavefront.hpp"

namespace plexway {

/// The front of a piece of a mixed domain. Others may offer labels while its own wait beyond a
/// horizon; and it lists what was expanded, since what they must know of has changed nowhere else.
template <class Real, class SimplexLabel>
class MixedFront : public Wavefront<Real, SimplexLabel, DualQueue<Real>, true> {
 public:
  using Base = Wavefront<Real, SimplexLabel, DualQueue<Real>, true>;
  using typename Base::Label;

  MixedFront(const Base& base, std::vector<Index>& expanded) : Base(base), expanded_(&expanded) {}

  [[gnu::always_inline]] void accept(Index s, std::size_t hinge, const Label& label, Real distance,
                                     Index source) {
    Base::take(s, hinge, label, distance, source);
  }
  template <class DistanceOf>
  [[gnu::always_inline]] bool next(Index& s, DistanceOf distance_of) {
    if (!Base::next(s, distance_of)) return false;
    expanded_->push_back(s);
    return true;
  }

 private:
  std::vector<Index>* expanded_;
};

}  // namespace plexway
