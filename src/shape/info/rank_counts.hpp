#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <plexway/executors/piece_ranks.hpp>

namespace plexway {

/// What a field cost several processes.
struct RankCounts {
  std::size_t sent_bytes = 0;             ///< from each to the others, together
  std::vector<std::uint64_t> peak_bytes;  ///< memory of each at its most
};

/// All processes call it, each with what it sent.
[[nodiscard]] RankCounts rank_counts(PieceRanks& ranks, std::size_t sent_bytes);

}  // namespace plexway
