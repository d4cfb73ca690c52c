#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <limits>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

#include <plexway/common/blocks.hpp>
#include <plexway/common/detail/storage.hpp>
#include <plexway/common/ids.hpp>

namespace plexway::detail {

/// So many simplices or vertices at a time while a domain is built: enough to be worth a thread,
/// and as few as any number of threads can share out.
inline constexpr std::size_t building_block = 16384;

/// Sets a mark that any thread may set. One that is set is only read, so that threads need not send
/// each other what they have in their caches.
inline void set_mark(char& mark) {
  const std::atomic_ref shared(mark);
  if (shared.load(std::memory_order_relaxed) == 0) shared.store(1, std::memory_order_relaxed);
}

/// Calls work(first, last) for the blocks below `count`, by any number of threads (0: all), of
/// which each has a whole block at least.
template <class Work>
void over_blocks(std::size_t count, int threads, const Work& work) {
  const std::size_t whole = std::max<std::size_t>(count / building_block, 1);
  if (whole < static_cast<std::size_t>(threads_for(threads))) threads = static_cast<int>(whole);
  for_blocks(count, building_block, threads, {}, work);
}

/// Calls work(first, last, own) for the blocks, each with a part of its own, and take(own) for each
/// that is done, in any order but one at a time. For sums that are the same in any order.
template <class Part, class Work, class Take>
void gather_blocks(std::size_t count, int threads, const Work& work, const Take& take) {
  std::mutex mutex;
  over_blocks(count, threads, [&](std::size_t first, std::size_t last) {
    Part own{};
    work(first, last, own);
    const std::lock_guard lock(mutex);
    take(std::move(own));
  });
}

/// Names vertices by their first use at the corners of simplices, which have the names from then
/// on; those of no simplex come behind. `first_use` gets how many were named before each block.
/// Returns how many simplices have.
template <class Corners>
std::size_t name_vertices(Corners& corners, std::vector<Index>& vertex_to_inside,
                          std::vector<Index>& first_use) {
  Index fresh = 0;
  for (std::size_t s = 0; s < corners.size(); ++s) {
    if (s % building_block == 0) first_use.push_back(fresh);
    for (Index& v : corners[s]) {
      Index& name = vertex_to_inside[v];
      if (name == none) name = fresh++;
      v = name;
    }
  }
  const std::size_t named = fresh;
  if (named < vertex_to_inside.size())
    for (Index& name : vertex_to_inside)
      if (name == none) name = fresh++;
  return named;
}

/// Of points.
struct Box3 {
  std::array<double, 3> low, high;

  Box3() {
    low.fill(std::numeric_limits<double>::infinity());
    high.fill(-std::numeric_limits<double>::infinity());
  }
  void take(const std::array<double, 3>& point) { take(point, point); }
  void take(const Box3& other) { take(other.low, other.high); }

 private:
  void take(const std::array<double, 3>& least, const std::array<double, 3>& most) {
    for (std::size_t d = 0; d < 3; ++d) {
      low[d] = std::min(low[d], least[d]);
      high[d] = std::max(high[d], most[d]);
    }
  }
};

/// What simplices tell their vertices, in the order of the simplices, by any number of threads.
///
/// Vertices are numbered by their first use, so those that a block of simplices is the first to use
/// are a range: first_use[b] and on. work(first, last, tell) calls tell(vertex, item) for what it
/// has to say, and apply(vertex, item) hears it: at once where the block is the first to use the
/// vertex, else after all blocks. So each vertex hears the same in the same order with any number
/// of threads, and no two threads write to one.
template <class Item, class Work, class Apply>
void tell_vertices(std::span<const Index> first_use, std::size_t simplices, int threads,
                   const Work& work, const Apply& apply) {
  if (first_use.size() < 2 || threads_for(threads) == 1) {
    work(std::size_t{0}, simplices, apply);
    return;
  }
  struct Late {
    Index vertex;
    Item item;
  };
  std::vector<std::vector<Late>> late(first_use.size());
  over_blocks(simplices, threads, [&](std::size_t first, std::size_t last) {
    const std::size_t block = first / building_block;
    const Index own = first_use[block];
    std::vector<Late> others;
    work(first, last, [&](Index vertex, const Item& item) {
      if (vertex >= own)
        apply(vertex, item);
      else
        others.push_back({vertex, item});
    });
    late[block] = std::move(others);
  });
  for (const std::vector<Late>& others : late)
    for (const Late& one : others) apply(one.vertex, one.item);
}

}  // namespace plexway::detail
