#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

#include <plexway/complex/ids.hpp>

namespace plexway::windows {

/// What waits, nearest first by buckets of equal width: a ring of lists through `next`, which
/// belongs to the nodes (pool slots, halfedges or vertices, as the caller likes). No heap. A bucket
/// is taken whole, so what comes next is known and can be looked up beforehand; what is added to it
/// meanwhile comes afterwards. What is farther than the ring reaches waits in a list of its own.
///
/// Node numbers below `none`. Next(node) gives a reference to the node's link, near(node) its
/// distance.
class BucketRing {
 public:
  static constexpr std::size_t buckets = 256;

  /// Empty, starting at distance 0. `width` > 0.
  void start(double width) {
    head_.fill(none);
    far_ = in_turn_ = none;
    width_ = width;
    per_width_ = 1 / width;
    near_count_ = far_count_ = 0;
    nearest_far_ = std::numeric_limits<double>::infinity();
    go_to(0);
  }

  /// About how far the front is.
  [[nodiscard]] double distance() const { return static_cast<double>(at_) * width_; }

  /// What comes next, or none where that is not known yet.
  [[nodiscard]] Index peek() const { return in_turn_; }

  template <class Next>
  [[gnu::always_inline]] void push(Index node, double near, const Next& next) {
    const double place = near * per_width_;
    if (place < last_) [[likely]] {
      const std::int64_t bucket = std::max(static_cast<std::int64_t>(std::max(place, 0.)), at_);
      Index& head = head_[static_cast<std::size_t>(bucket) % buckets];
      next(node) = head;
      head = node;
      ++near_count_;
    } else {
      next(node) = far_;
      far_ = node;
      ++far_count_;
      nearest_far_ = std::min(nearest_far_, near);
    }
  }

  /// The next node, or none where nothing waits.
  template <class Next, class Near>
  [[gnu::always_inline]] Index pop(const Next& next, const Near& near) {
    if (in_turn_ == none) [[unlikely]]
      take_turn(next, near);
    const Index node = in_turn_;
    if (node == none) return none;
    in_turn_ = next(node);
    --near_count_;
    return node;
  }

 private:
  static constexpr double most = 1e18;  // numbers of buckets stay whole numbers

  void go_to(std::int64_t bucket) {
    at_ = bucket;
    last_ = static_cast<double>(at_ + static_cast<std::int64_t>(buckets) - 1);
  }

  /// All that waits in the nearest bucket.
  template <class Next, class Near>
  [[gnu::noinline]] void take_turn(const Next& next, const Near& near) {
    for (;;) {
      if (near_count_ == 0) {
        if (far_count_ == 0) return;
        go_to(static_cast<std::int64_t>(std::min(nearest_far_ * per_width_, most)));
        bring_near(next, near);
        continue;
      }
      in_turn_ = std::exchange(head_[static_cast<std::size_t>(at_) % buckets], none);
      if (in_turn_ != none) return;
      go_to(at_ + 1);
      if (nearest_far_ * per_width_ < last_ - static_cast<double>(buckets / 2))
        bring_near(next, near);
    }
  }

  template <class Next, class Near>
  void bring_near(const Next& next, const Near& near) {
    Index node = far_;
    far_ = none;
    far_count_ = 0;
    const bool alone = near_count_ == 0;
    nearest_far_ = std::numeric_limits<double>::infinity();
    while (node != none) {
      const Index after = next(node);
      // Beyond what can be counted all are equally near.
      push(node, std::min(near(node), most * width_), next);
      node = after;
    }
    if (alone && near_count_ == 0) {  // the step drowned in the distance: take them all
      node = far_;
      far_ = none;
      near_count_ = far_count_;
      far_count_ = 0;
      nearest_far_ = std::numeric_limits<double>::infinity();
      head_[static_cast<std::size_t>(at_) % buckets] = node;
    }
  }

  std::array<Index, buckets> head_;
  Index in_turn_ = none;  // what is left of the bucket in turn
  Index far_ = none;
  double width_ = 1, per_width_ = 1;
  std::int64_t at_ = 0;  // the bucket in turn, counted from distance 0
  double last_ = 0;      // the ring ends there, in buckets
  std::size_t near_count_ = 0, far_count_ = 0;
  double nearest_far_ = 0;
};

}  // namespace plexway::windows
