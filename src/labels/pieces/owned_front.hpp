#pragma once

#include <cstddef>
#include <vector>

#include <plexway/common/ids.hpp>
#include "labels/front.hpp"
#include "labels/wavefront.hpp"

namespace plexway {

/// An offer to a simplex of another piece.
template <class Real, class SimplexLabel>
struct OwnedLetter {
  Index to;  ///< the domain's number
  Index source;
  Index hinge;
  Real distance;
  SimplexLabel label;
};

/// The front of a piece that shares the labels of the whole: its own simplices it reads and writes
/// there; what belongs to another piece is as if it were unreached, and offers to it become
/// letters.
template <class Real, class SimplexLabel, bool kLabels>
class OwnedFront : public Wavefront<Real, SimplexLabel, DualQueue<Real>, kLabels> {
 public:
  using Base = Wavefront<Real, SimplexLabel, DualQueue<Real>, kLabels>;
  using typename Base::Label;
  using Letter = OwnedLetter<Real, SimplexLabel>;

  /// `piece_of` each simplex; `none` of the sentinel.
  OwnedFront(const Base& base, const Index* piece_of, Index piece)
      : Base(base), piece_of_(piece_of), piece_(piece) {}

  [[nodiscard, gnu::always_inline]] bool reached(Index s) const {
    return (piece_of_[s] == piece_ || piece_of_[s] == none) && Base::reached(s);
  }
  [[gnu::always_inline]] void accept(Index s, std::size_t hinge, const Label& label, Real distance,
                                     Index source) {
    if (piece_of_[s] == piece_) [[likely]]
      Base::accept(s, hinge, label, distance, source);
    else
      letters_.push_back({s, source, static_cast<Index>(hinge), distance, label});
  }

  /// From elsewhere, for a simplex of the piece.
  void take(Index s, std::size_t hinge, const Label& label, Real distance, Index source) {
    const bool waits = Base::reached(s) && this->waits(s);
    Base::accept(s, hinge, label, distance, source);
    if (waits) this->queue().note(distance);
  }

  [[nodiscard]] std::vector<Letter>& letters() { return letters_; }

 private:
  const Index* piece_of_;
  Index piece_;
  std::vector<Letter> letters_;
};

}  // namespace plexway
