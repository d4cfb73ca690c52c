#pragma once

#include <cstddef>
#include <functional>

namespace plexway {

/// How many threads are meant: as asked, or for 0 as many as the machine has.
[[nodiscard]] int threads_for(int asked);

/// Calls work(first, last) for all blocks of `block` numbers below `count`, on `threads` threads
/// (0: as many as the machine has). Which thread does which block is left to chance, so that work
/// must not depend on it. `progress`, if any, is called by the caller's thread with the share that
/// is done; false ends it with Cancelled. What `work` throws reaches the caller once all threads
/// are done, that for the lowest numbers if several blocks fail.
void for_blocks(std::size_t count, std::size_t block, int threads,
                const std::function<bool(double share)>& progress,
                const std::function<void(std::size_t first, std::size_t last)>& work);

}  // namespace plexway
