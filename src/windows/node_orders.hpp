#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include <plexway/common/ids.hpp>
#include <plexway/solve/options.hpp>

namespace plexway::detail::windows {

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
