#pragma once

#include <cstddef>
#include <limits>

#include <plexway/common/ids.hpp>

#include "labels/front.hpp"

namespace plexway {

/// What waits in a wireframe that others offer to as well, up to a horizon: in two queues, and when
/// those have looked too often nearest first.
template <class Real>
class WireFront {
 public:
  WireFront(FrontStorage& storage, Real step) : dual_(storage, step), heap_(storage) {}

  void push(Index v, Real distance, bool wanted = true) {
    if (sorted_) return heap_.push(v, distance);
    if (!wanted) dual_.note(distance);
    dual_.push(v, distance, wanted);
  }
  template <class DistanceOf>
  bool pop(Index& v, const DistanceOf& distance_of) {
    if (!sorted_) return dual_.pop(v, distance_of);
    return heap_.nearest() < horizon_ && heap_.pop(v, distance_of);
  }
  [[nodiscard]] Real nearest() const { return sorted_ ? heap_.nearest() : dual_.nearest(); }
  void set_horizon(Real horizon) {
    horizon_ = horizon;
    dual_.set_horizon(horizon);
  }
  /// From now on nearest first; whose label waits must be added anew.
  void sort() { sorted_ = true; }
  [[nodiscard]] bool sorted() const { return sorted_; }
  /// The two queues, which one who spreads by them alone may take and put back.
  [[nodiscard]] DualQueue<Real>& dual() { return dual_; }

 private:
  DualQueue<Real> dual_;
  PriorityQueue<Real> heap_;
  Real horizon_ = std::numeric_limits<Real>::infinity();
  bool sorted_ = false;
};

}  // namespace plexway
