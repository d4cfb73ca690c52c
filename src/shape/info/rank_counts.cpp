#include "shape/info/rank_counts.hpp"

#include <sys/resource.h>

#include "executors/threads/rank_mail.hpp"

namespace plexway {

RankCounts rank_counts(PieceRanks& ranks, std::size_t sent_bytes) {
  rusage used{};
  ::getrusage(RUSAGE_SELF, &used);
  // A number each: in its own place, and zeros elsewhere.
  std::vector<std::uint64_t> sums(ranks.count() + 1);
  sums[ranks.rank()] = 1024 * static_cast<std::uint64_t>(used.ru_maxrss);
  sums.back() = sent_bytes;
  add_up(&ranks, sums);
  RankCounts counts{static_cast<std::size_t>(sums.back()), sums};
  counts.peak_bytes.pop_back();
  return counts;
}

}  // namespace plexway
