#pragma once

#include <algorithm>
#include <cstddef>

#include <plexway/executors.hpp>

namespace plexway {

/// About so many simplices a piece, of so many. Of the domain alone, never of threads.
inline std::size_t piece_size(const OpenMP& executor, std::size_t simplices) {
  if (executor.piece != 0) return executor.piece;
  return std::clamp<std::size_t>(simplices / 64, 4096, 65536);
}

/// Is all of it one piece? Then one thread does what Serial does.
inline bool is_one_piece(std::size_t size, std::size_t simplices) {
  return simplices < size + size / 2;
}

}  // namespace plexway
