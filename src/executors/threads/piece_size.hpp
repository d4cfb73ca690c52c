#pragma once

#include <algorithm>
#include <cstddef>

#include <plexway/executors.hpp>

namespace plexway {

/// How a domain is cut where the executor does not say it.
struct PieceChoice {
  std::size_t least;  ///< simplices a piece: fewer cost more than they are good for
  std::size_t count;  ///< so many pieces where they are larger: enough for a dozen threads
};

/// Of wireframes, in vertices.
inline constexpr PieceChoice wire_pieces = {4096, 64};

/// About so many simplices a piece, of so many. Of the domain alone, never of threads. What one
/// thread does in some milliseconds is a single piece.
inline std::size_t piece_size(const OpenMP& executor, std::size_t simplices,
                              const PieceChoice& choice) {
  if (executor.piece != 0) return executor.piece;
  constexpr std::size_t too_few = std::size_t{1} << 15;
  if (simplices < too_few) return simplices + 1;
  return std::max(choice.least, simplices / choice.count);
}

/// Is all of it one piece? Then one thread does what Serial does.
inline bool is_one_piece(std::size_t size, std::size_t simplices) {
  return simplices < size + size / 2;
}

}  // namespace plexway
