#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include <plexway/common/ids.hpp>
#include <plexway/solve/options.hpp>

namespace plexway::detail {

/// Room for so many simplices waiting at once, allocated once and touched only where used.
struct FrontStorage {
  std::unique_ptr<Index[]> near, far;
  std::size_t capacity = 0;
  std::vector<std::pair<double, Index>> heap;

  void reserve(std::size_t simplices) {
    if (capacity > simplices) return;
    capacity = std::bit_ceil(simplices + 1);
    near = std::make_unique_for_overwrite<Index[]>(capacity);
    far = std::make_unique_for_overwrite<Index[]>(capacity);
    heap.reserve(std::min<std::size_t>(capacity, 1024));  // where it holds repairs, few
  }
};

/// The front as two first-in first-out queues: labels nearer than a limit wait in one, the others
/// in the second; when the first is empty the limit moves on by `step` and they change places.
///
/// GSP's dual queue (GSP 2021, section 5) with one change: what is still beyond the limit when its
/// turn comes goes back to the second queue, so that the order stays near to far for any step. With
/// an infinite step it is a plain queue. Each simplex waits at most once. What is at a horizon or
/// beyond waits until that moves on.
template <class Real>
class DualQueue {
 public:
  DualQueue(FrontStorage& storage, Real step)
      : near_(storage.near.get()),
        far_(storage.far.get()),
        capacity_(storage.capacity),
        step_(step),
        limit_(step) {}

  /// Adds a simplex if `wanted`. Written to both queues and kept in one: no branch to mispredict.
  [[gnu::always_inline]] void push(Index simplex, Real distance, bool wanted = true) {
    const bool is_near = distance < limit_;
    near_[near_end_] = simplex;
    far_[far_end_] = simplex;
    near_end_ = advance(near_end_, wanted && is_near);
    far_end_ = advance(far_end_, wanted && !is_near);
    nearest_far_ = std::min(nearest_far_, wanted && !is_near ? distance : nearest_far_);
  }

  /// Takes the next simplex. False when none waits. `distance_of` gives its present distance.
  template <class DistanceOf>
  [[gnu::always_inline]] bool pop(Index& simplex, DistanceOf distance_of) {
    for (;;) {
      if (near_begin_ == near_end_) {
        if (far_end_ == 0 || nearest_far_ >= horizon_) return false;
        std::swap(near_, far_);
        near_begin_ = 0;
        near_end_ = far_end_;
        far_end_ = 0;
        limit_ = std::max(limit_, nearest_far_) + step_;
        if (!(nearest_far_ < limit_))  // the step drowns in the distance
          limit_ = std::nextafter(nearest_far_, std::numeric_limits<Real>::infinity());
        if (!(limit_ + step_ / 2 < horizon_)) limit_ = horizon_;  // no short turn before it
        nearest_far_ = std::numeric_limits<Real>::infinity();
      }
      simplex = near_[near_begin_];
      near_begin_ = advance(near_begin_, true);
      const Real distance = distance_of(simplex);
      if (distance < limit_) [[likely]]
        return true;
      far_[far_end_] = simplex;
      far_end_ = advance(far_end_, true);
      nearest_far_ = std::min(nearest_far_, distance);
    }
  }

  /// Never moves back. Before the first it is infinite.
  void set_horizon(Real horizon) {
    horizon_ = horizon;
    limit_ = std::min(limit_, horizon);
  }
  /// No simplex that waits is nearer: 0 where some are in turn, +inf where none waits.
  [[nodiscard]] Real nearest() const {
    if (near_begin_ != near_end_) return 0;
    return far_end_ == 0 ? std::numeric_limits<Real>::infinity() : nearest_far_;
  }
  /// One that waits has got nearer than it was when it was added.
  void note(Real distance) { nearest_far_ = std::min(nearest_far_, distance); }

 private:
  std::size_t advance(std::size_t at, bool by) const { return (at + by) & (capacity_ - 1); }

  Index* near_;
  Index* far_;
  std::size_t capacity_;
  std::size_t near_begin_ = 0, near_end_ = 0, far_end_ = 0;
  Real step_, limit_;
  Real horizon_ = std::numeric_limits<Real>::infinity();
  Real nearest_far_ = std::numeric_limits<Real>::infinity();
};

/// Nearest first. A simplex may wait several times; what is out of date is skipped. The heap has
/// four children a node, side by side: half the levels of a binary one, so half the misses.
template <class Real>
class PriorityQueue {
 public:
  explicit PriorityQueue(FrontStorage& storage) : heap_(&storage.heap) { heap_->clear(); }

  void push(Index simplex, Real distance, bool = true) {
    const Entry entry(static_cast<double>(distance), simplex);
    std::size_t at = heap_->size();
    heap_->push_back(entry);
    Entry* const heap = heap_->data();
    for (; at > 0 && entry.first < heap[(at - 1) / 4].first; at = (at - 1) / 4)
      heap[at] = heap[(at - 1) / 4];
    heap[at] = entry;
  }

  /// No simplex that waits is nearer; it may be one that is out of date.
  [[nodiscard]] Real nearest() const {
    return heap_->empty() ? std::numeric_limits<Real>::infinity()
                          : static_cast<Real>(heap_->front().first);
  }

  template <class DistanceOf>
  bool pop(Index& simplex, DistanceOf distance_of) {
    while (!heap_->empty()) {
      const auto [distance, candidate] = heap_->front();
      remove_first();
      simplex = candidate;
      if (static_cast<Real>(distance) == distance_of(candidate)) return true;
    }
    return false;
  }

 private:
  using Entry = std::pair<double, Index>;

  /// The place at the top sinks along the nearest children down to a leaf, and the last entry,
  /// which mostly belongs far down, rises from there.
  void remove_first() {
    const Entry last = heap_->back();
    heap_->pop_back();
    Entry* const heap = heap_->data();
    const std::size_t size = heap_->size();
    if (size == 0) return;
    std::size_t at = 0;
    for (std::size_t child = 1; child < size; child = 4 * at + 1) {
      std::size_t nearest = child;
      const std::size_t end = std::min(child + 4, size);
      for (std::size_t c = child + 1; c < end; ++c)
        nearest = heap[c].first < heap[nearest].first ? c : nearest;
      heap[at] = heap[nearest];
      at = nearest;
    }
    for (; at > 0 && last.first < heap[(at - 1) / 4].first; at = (at - 1) / 4)
      heap[at] = heap[(at - 1) / 4];
    heap[at] = last;
  }

  std::vector<Entry>* heap_;
};

/// Either of the two, chosen at run time: for loops that a branch more does not slow down, so that
/// they are compiled once.
template <class Real>
class ChosenQueue {
 public:
  ChosenQueue(FrontStorage& storage, Real step, bool by_priority)
      : dual_(storage, step), heap_(storage), by_priority_(by_priority) {}

  void push(Index simplex, Real distance, bool wanted = true) {
    if (by_priority_) [[unlikely]]
      heap_.push(simplex, distance, wanted);
    else
      dual_.push(simplex, distance, wanted);
  }
  template <class DistanceOf>
  bool pop(Index& simplex, DistanceOf distance_of) {
    return by_priority_ ? heap_.pop(simplex, distance_of) : dual_.pop(simplex, distance_of);
  }

 private:
  DualQueue<Real> dual_;
  PriorityQueue<Real> heap_;
  bool by_priority_;
};

/// The width of the limit in the unit inside, where `edge` is what counts as an edge.
template <class Real>
Real step_of(const PropagateOptions& options, double edge = 1) {
  return options.schedule == Schedule::fifo ? std::numeric_limits<Real>::infinity()
                                            : static_cast<Real>(options.step * edge);
}

}  // namespace plexway::detail
