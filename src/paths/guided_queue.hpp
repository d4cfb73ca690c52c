#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include <plexway/common/ids.hpp>

namespace plexway {

/// What a guided queue shares with those who ask and stop it. Guide has
///   bound(simplex, distance)   of all paths that its label, this far at its centre, leads to
///   settled(bound)   true if nothing at this bound or above is wanted any more
template <class Real, class Guide>
struct GuidedFront {
  struct Entry {
    double bound;
    Real distance;
    Index simplex;
  };
  std::vector<Entry> heap;
  Guide* guide;
};

/// Least bound first. A simplex may wait several times; what is out of date is skipped.
template <class Real, class Guide>
class GuidedQueue {
 public:
  using Front = GuidedFront<Real, Guide>;
  explicit GuidedQueue(Front& front) : front_(&front) {}

  void push(Index simplex, Real distance, bool = true) {
    const double bound = front_->guide->bound(simplex, static_cast<double>(distance));
    front_->heap.push_back({bound, distance, simplex});
    std::push_heap(front_->heap.begin(), front_->heap.end(), later);
  }

  template <class DistanceOf>
  bool pop(Index& simplex, DistanceOf distance_of) {
    auto& heap = front_->heap;
    while (!heap.empty()) {
      const auto first = heap.front();
      if (first.distance == distance_of(first.simplex) && front_->guide->settled(first.bound))
        return false;
      std::pop_heap(heap.begin(), heap.end(), later);
      heap.pop_back();
      if (first.distance != distance_of(first.simplex)) continue;
      simplex = first.simplex;
      return true;
    }
    return false;
  }

 private:
  static bool later(const typename Front::Entry& a, const typename Front::Entry& b) {
    return a.bound > b.bound;
  }
  Front* front_;
};

}  // namespace plexway
