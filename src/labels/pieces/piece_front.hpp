#pragma once

#include <cstddef>

#include <plexway/common/ids.hpp>

#include "labels/front.hpp"
#include "labels/wavefront.hpp"

namespace plexway {

/// The front inside a piece: what is offered to ghosts is their own piece's to find out.
template <class Real, class SimplexLabel, bool kLabels>
class PieceFront : public Wavefront<Real, SimplexLabel, DualQueue<Real>, kLabels> {
 public:
  using Base = Wavefront<Real, SimplexLabel, DualQueue<Real>, kLabels>;
  using typename Base::Label;

  PieceFront(const Base& base, std::size_t own) : Base(base), own_(static_cast<Index>(own)) {}

  [[gnu::always_inline]] void accept(Index s, std::size_t hinge, const Label& label, Real distance,
                                     Index source) {
    if (s < own_) [[likely]]
      Base::accept(s, hinge, label, distance, source);
  }

  /// So many simplices take what they are offered: those of the piece, or the ghosts, too.
  void set_open(std::size_t simplices) { own_ = static_cast<Index>(simplices); }

  /// A label from elsewhere, for a simplex of the piece or a ghost.
  void take(Index s, std::size_t hinge, const Label& label, Real distance, Index source) {
    const bool waits = this->reached(s) && this->waits(s);
    Base::accept(s, hinge, label, distance, source);
    if (waits) this->queue().note(distance);
  }

 private:
  Index own_;
};

}  // namespace plexway
