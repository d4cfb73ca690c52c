#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include <plexway/common/ids.hpp>
#include <plexway/solve/options.hpp>

namespace plexway::detail::windows {

/// What waits, nearest first by buckets of equal width: a ring of lists through `next`, which
/// belongs to the nodes (pool slots, halfedges or vertices, as the caller likes). No heap. A bucket
/// is taken whole, so what comes next is known and can be looked up beforehand; what is added to it
/// meanwhile comes afterwards. What is farther than the ring reaches waits in a list of its own.
///
/// Node numbers below `none`. Next(node) gives a reference to the node's link, near(node) its
/// distance.
///
/// At a horizon it stops as if nothing waited; afterwards what is nearer may still be let in.
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
    horizon_ = std::numeric_limits<std::int64_t>::max();
    go_to(0);
  }

  /// What is at `distance` or beyond waits from now on. Something nearer than that has its turn,
  /// whatever the width of a bucket.
  void set_horizon(double distance) {
    horizon_ = static_cast<std::int64_t>(std::ceil(std::min(distance * per_width_, 2 * most)));
    if (const std::int64_t first = first_bucket(); nearest() < distance && first < last_bucket)
      horizon_ = std::max(horizon_, first + 1);
  }
  /// Nothing that waits is nearer; +inf where nothing does.
  [[nodiscard]] double nearest() const {
    if (near_count_ == 0 && in_turn_ == none)
      return far_count_ == 0 ? std::numeric_limits<double>::infinity() : nearest_far_;
    return static_cast<double>(first_bucket()) * width_;
  }
  /// Between turns: what is as near as this may be pushed and comes first.
  template <class Next>
  void admit(double near, const Next& next) {
    if (in_turn_ != none) put_back(next);
    const auto bucket = static_cast<std::int64_t>(std::clamp(near * per_width_, 0., most));
    if (bucket >= at_) return;
    // The ring then ends sooner.
    constexpr auto reach = static_cast<std::int64_t>(buckets) - 1;
    for (std::int64_t k = std::max(bucket + reach, at_); k < at_ + reach; ++k)
      for (Index node = std::exchange(head_[static_cast<std::size_t>(k) % buckets], none);
           node != none;) {
        const Index after = next(node);
        next(node) = far_;
        far_ = node;
        --near_count_;
        ++far_count_;
        nearest_far_ = std::min(nearest_far_, static_cast<double>(k) * width_);
        node = after;
      }
    go_to(bucket);
  }

  /// About how far the front is.
  [[nodiscard]] double distance() const { return static_cast<double>(at_) * width_; }

  /// What comes next, or none where that is not known yet.
  [[nodiscard]] Index peek() const { return in_turn_; }

  template <class Next>
  [[gnu::always_inline]] void push(Index node, double near, const Next& next) {
    // What is nearer than the bucket in turn belongs there: said of numbers, since the whole number
    // then needs no second look.
    const double place = std::max(near * per_width_, first_);
    if (place < last_) [[likely]] {
      Index& head = head_[static_cast<std::size_t>(static_cast<std::int64_t>(place)) % buckets];
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
  static constexpr auto last_bucket = std::numeric_limits<std::int64_t>::max() - 1;

  /// The first bucket of the ring with something in it; where none has, `last_bucket`, or that of
  /// the nearest beyond.
  [[nodiscard]] std::int64_t first_bucket() const {
    if (in_turn_ != none) return at_;
    if (near_count_ > 0)
      for (std::int64_t k = at_;; ++k)
        if (head_[static_cast<std::size_t>(k) % buckets] != none) return k;
    if (far_count_ == 0) return last_bucket;
    return static_cast<std::int64_t>(std::min(nearest_far_ * per_width_, most));
  }

  /// A turn that was not ended is to be had again.
  template <class Next>
  void put_back(const Next& next) {
    Index last = in_turn_;
    while (next(last) != none) last = next(last);
    Index& head = head_[static_cast<std::size_t>(at_) % buckets];
    next(last) = head;
    head = std::exchange(in_turn_, none);
  }

  void go_to(std::int64_t bucket) {
    at_ = bucket;
    first_ = static_cast<double>(at_);
    last_ = static_cast<double>(at_ + static_cast<std::int64_t>(buckets) - 1);
  }

  /// All that waits in the nearest bucket.
  template <class Next, class Near>
  [[gnu::noinline]] void take_turn(const Next& next, const Near& near) {
    for (;;) {
      if (near_count_ == 0) {
        if (far_count_ == 0) return;
        const auto bucket = static_cast<std::int64_t>(std::min(nearest_far_ * per_width_, most));
        if (bucket >= horizon_) return;
        go_to(bucket);
        bring_near(next, near);
        continue;
      }
      if (at_ >= horizon_) return;
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
  std::int64_t horizon_ = std::numeric_limits<std::int64_t>::max();
  double first_ = 0, last_ = 0;  // the ring begins and ends there, in buckets
  std::size_t near_count_ = 0, far_count_ = 0;
  double nearest_far_ = 0;
};

/// What waits at a place, a halfedge (4 f + i) or a vertex: a table of the few where anything does,
/// not a number for each of all (24 bytes a vertex, and 4). Of places 64 that follow each other
/// hash side by side. What waits at one place forms a list by `link`, the latest first; Blocks is
/// indexed by their numbers and tells the `place` that each waits at.
class WaitingTable {
 public:
  /// Nothing waits.
  void clear() { heads_.assign(heads_.size(), none); }

  /// Where the list begins that has what waits there. Until the next `make_room`.
  [[nodiscard, gnu::always_inline]] Index& list(Index place) {
    const Index row = (place >> together) * Index{0x9E3779B1} >> shift_;
    return heads_[row ^ (place & ((Index{1} << together) - 1))];
  }

  /// The latest there, or none.
  template <class Blocks>
  [[nodiscard, gnu::always_inline]] static Index find(Index block, Index place,
                                                      const Blocks& blocks) {
    while (block != none && blocks[block].place != place) [[unlikely]] block = blocks[block].link;
    return block;
  }

  template <class Blocks>
  [[gnu::always_inline]] void remove(Index block, Blocks& blocks) {
    Index* at = &list(blocks[block].place);
    while (*at != block) [[unlikely]] at = &blocks[*at].link;
    *at = blocks[block].link;
  }

  /// For so many blocks.
  template <class Blocks>
  void make_room(std::size_t count, Blocks& blocks) {
    while (heads_.size() < sparse * count) {
      std::vector<Index> lists(2 * heads_.size(), none), blocks_of_one;
      lists.swap(heads_);
      --shift_;
      for (Index block : lists) {
        blocks_of_one.clear();
        for (; block != none; block = blocks[block].link) blocks_of_one.push_back(block);
        for (; !blocks_of_one.empty(); blocks_of_one.pop_back()) {  // the latest last
          const Index last = blocks_of_one.back();
          Index& head = list(blocks[last].place);
          blocks[last].link = head;
          head = last;
        }
      }
    }
  }

  /// A block more, and room for it here. What `list` gave is no longer good.
  template <class Block>
  [[nodiscard, gnu::noinline]] Index one_more(std::vector<Block>& blocks) {
    make_room(blocks.size() + 1, blocks);
    if (blocks.size() == blocks.capacity())  // doubled they would be 10 bytes a vertex
      blocks.reserve(blocks.size() + blocks.size() / 4 + 64);
    blocks.emplace_back();
    return static_cast<Index>(blocks.size() - 1);
  }

  [[nodiscard]] std::size_t bytes() const { return heads_.capacity() * sizeof(heads_[0]); }

 private:
  static constexpr int together = 6, least = 10;  // bits
  static constexpr std::size_t sparse = 16;

  std::vector<Index> heads_ = std::vector<Index>(std::size_t{1} << least, none);
  int shift_ = 32 - least;
};

/// First in, first out, with the interface of BucketRing.
class FirstIn {
 public:
  void start(double) { first_ = last_ = none; }
  [[nodiscard]] Index peek() const { return first_; }
  [[nodiscard]] double distance() const { return distance_; }

  template <class Next>
  void push(Index node, double, const Next& next) {
    next(node) = none;
    if (first_ == none)
      first_ = node;
    else
      next(last_) = node;
    last_ = node;
  }
  template <class Next, class Near>
  Index pop(const Next& next, const Near& near) {
    if (first_ == none) return none;
    const Index node = first_;
    first_ = next(node);
    distance_ = near(node);
    return node;
  }

 private:
  Index first_ = none, last_ = none;
  double distance_ = 0;
};

/// Nearest first, with the interface of BucketRing.
class NearestOfAll {
 public:
  void start(double) { heap_.clear(); }
  [[nodiscard]] Index peek() const { return heap_.empty() ? none : heap_.front().second; }
  [[nodiscard]] double distance() const { return distance_; }

  template <class Next>
  void push(Index node, double near, const Next&) {
    heap_.push_back({near, node});
    std::push_heap(heap_.begin(), heap_.end(), later);
  }
  template <class Next, class Near>
  Index pop(const Next&, const Near&) {
    if (heap_.empty()) return none;
    std::pop_heap(heap_.begin(), heap_.end(), later);
    const Index node = heap_.back().second;
    distance_ = heap_.back().first;
    heap_.pop_back();
    return node;
  }

 private:
  using Entry = std::pair<double, Index>;
  static bool later(const Entry& a, const Entry& b) { return a.first > b.first; }
  std::vector<Entry> heap_;
  double distance_ = 0;
};

/// What work(order) returns, in the order of a schedule.
template <class Ring, class Work>
auto in_order(Schedule schedule, NearestOfAll& nearest, Ring& ring, const Work& work) {
  FirstIn line;
  switch (schedule) {
    case Schedule::fifo:
      return work(line);
    case Schedule::priority:
      return work(nearest);
    default:
      return work(ring);
  }
}

}  // namespace plexway::detail::windows
