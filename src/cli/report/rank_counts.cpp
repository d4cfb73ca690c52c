#include "cli/report/rank_counts.hpp"

#include <sys/resource.h>

#include <limits>

namespace plexway::cli {

RankCounts rank_counts(PieceRanks& ranks, std::size_t sent_bytes) {
  rusage used{};
  ::getrusage(RUSAGE_SELF, &used);
  // A number each: in its own place, and zeros elsewhere.
  std::vector<std::uint64_t> sums(ranks.count() + 1);
  sums[ranks.rank()] = 1024 * static_cast<std::uint64_t>(used.ru_maxrss);
  sums.back() = sent_bytes;
  const std::vector<PieceRanks::Bytes> to(ranks.count());
  std::vector<std::vector<std::byte>> from(ranks.count());
  double least = std::numeric_limits<double>::infinity();
  ranks.meet(to, from, sums, least);
  RankCounts counts{sums.back(), sums};
  counts.peak_bytes.pop_back();
  return counts;
}

}  // namespace plexway::cli
