#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <vector>

#include <plexway/complex/ids.hpp>

namespace plexway::windows {

/// What waits, nearest first by buckets of equal width: a ring of lists through `next`, which
/// belongs to the nodes (pool slots, halfedges or vertices, as the caller likes). No heap: inside a
/// bucket the last comes first. What is farther than the ring reaches waits in a list of its own.
///
/// Node numbers below `none`. Next(node) gives a reference to the node's link, near(node) its
/// distance.
class BucketRing {
 public:
  static constexpr std::size_t buckets = 256;

  /// Empty, starting at distance 0. `width` > 0.
  void start(double width) {
    head_.fill(none);
    far_ = none;
    width_ = width;
    per_width_ = 1 / width;
    at_ = 0;
    near_count_ = far_count_ = 0;
    nearest_far_ = std::numeric_limits<double>::infinity();
  }

  [[nodiscard]] bool empty() const { return near_count_ + far_count_ == 0; }

  /// About how far the front is.
  [[nodiscard]] double distance() const { return static_cast<double>(at_) * width_; }

  /// What comes next if nothing nearer is added, or none.
  [[nodiscard]] Index peek() const { return head_[at_ % buckets]; }

  template <class Next>
  void push(Index node, double near, const Next& next) {
    const double place = near * per_width_;
    const double last = static_cast<double>(at_ + buckets - 1);
    if (place < last) [[likely]] {
      const std::size_t bucket = std::max(static_cast<std::size_t>(std::max(place, 0.)), at_);
      Index& head = head_[bucket % buckets];
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
  Index pop(const Next& next, const Near& near) {
    for (;;) {
      if (near_count_ == 0) {
        if (far_count_ == 0) return none;
        at_ = static_cast<std::size_t>(std::min(nearest_far_ * per_width_, most));
        bring_near(next, near);
        continue;
      }
      Index& head = head_[at_ % buckets];
      if (head != none) {
        const Index node = head;
        head = next(node);
        --near_count_;
        return node;
      }
      ++at_;
      if (nearest_far_ * per_width_ < static_cast<double>(at_ + buckets / 2))
        bring_near(next, near);
    }
  }

 private:
  static constexpr double most = 1e18;  // numbers of buckets stay whole numbers

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
      head_[at_ % buckets] = node;
    }
  }

  std::array<Index, buckets> head_;
  Index far_ = none;
  double width_ = 1, per_width_ = 1;
  std::size_t at_ = 0;  // the bucket in turn, counted from distance 0
  std::size_t near_count_ = 0, far_count_ = 0;
  double nearest_far_ = 0;
};

}  // namespace plexway::windows
