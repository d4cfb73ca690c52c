#pragma once

#include <cstddef>
#include <functional>

#include <plexway/executors.hpp>

namespace plexway::detail {

/// Calls work(k, thread) for all k < count, thread by thread as they come, until one throws.
/// Throws what the first of them threw. `threads` is at most the team's size.
void share_out(const OpenMP& executor, std::size_t count,
               const std::function<void(std::size_t k, std::size_t thread)>& work);

}  // namespace plexway::detail
