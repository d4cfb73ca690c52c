#pragma once

#include <vector>

#include <plexway/common/ids.hpp>

namespace plexway {

/// A queue that writes down what was ever pushed: simplices may be listed several times.
template <class Real, class Queue>
class LoggedQueue {
 public:
  LoggedQueue(Queue queue, std::vector<Index>& log) : queue_(queue), log_(&log) {}
  void push(Index simplex, Real distance, bool wanted = true) {
    if (wanted) log_->push_back(simplex);
    queue_.push(simplex, distance, wanted);
  }
  template <class DistanceOf>
  bool pop(Index& simplex, DistanceOf distance_of) {
    return queue_.pop(simplex, distance_of);
  }

 private:
  Queue queue_;
  std::vector<Index>* log_;
};

}  // namespace plexway
