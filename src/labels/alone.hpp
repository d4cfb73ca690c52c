#pragma once

#include <cstddef>

namespace plexway::detail {

/// Who does the work of a solve: one thread (scheduler.hpp: a team).
struct Alone {
  template <class Propagation, class Front>
  void run(Propagation& propagation, Front&, std::size_t) const {
    propagation.run();
  }
  /// work(begin, end) for all of [0, count).
  template <class Work>
  void over(std::size_t count, const Work& work) const {
    work(std::size_t{0}, count);
  }
  /// look(i) for at least those i < count that are `wanted`.
  template <class Wanted, class Look>
  void search(std::size_t count, const Wanted&, const Look& look) const {
    for (std::size_t i = 0; i < count; ++i) look(i);
  }
};

}  // namespace plexway::detail
