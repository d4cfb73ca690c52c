#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include <plexway/executors/piece_ranks.hpp>

#include "complexes/partition/deal.hpp"
#include "executors/threads/piece_post.hpp"

namespace plexway {

/// What each process tells each, itself too, once: fill, meet, read. Of one process alone, which
/// has no ranks, the same.
class PartMail {
 public:
  explicit PartMail(PieceRanks* ranks)
      : ranks_(ranks),
        deal_(ranks == nullptr ? Deal{} : Deal{ranks->rank(), ranks->count()}),
        to_(deal_.count),
        from_(deal_.count) {}

  [[nodiscard]] std::size_t count() const { return deal_.count; }
  [[nodiscard]] std::size_t ours() const { return deal_.ours; }
  [[nodiscard]] Parcel& to(std::size_t rank) { return to_[rank]; }

  /// All processes.
  void meet() {
    if (ranks_ == nullptr) return;
    std::vector<PieceRanks::Bytes> out(count());
    for (std::size_t r = 0; r < count(); ++r)
      if (r != ours()) out[r] = to_[r].bytes();
    double least = std::numeric_limits<double>::infinity();
    ranks_->meet(out, from_, {}, least);
    for (std::size_t r = 0; r < count(); ++r) {
      if (r == ours()) continue;
      sent_ += out[r].size();
      to_[r] = {};
    }
  }
  [[nodiscard]] Unpacked from(std::size_t rank) const {
    return Unpacked(rank == ours() ? to_[rank].bytes() : PieceRanks::Bytes(from_[rank]));
  }
  /// Bytes from this process to the others.
  [[nodiscard]] std::size_t sent() const { return sent_; }

 private:
  PieceRanks* ranks_;
  Deal deal_;
  std::vector<Parcel> to_;
  std::vector<std::vector<std::byte>> from_;
  std::size_t sent_ = 0;
};

/// The least over all processes.
[[nodiscard]] inline double least_of(PieceRanks* ranks, double own) {
  if (ranks == nullptr) return own;
  std::vector<PieceRanks::Bytes> to(ranks->count());
  std::vector<std::vector<std::byte>> from(ranks->count());
  ranks->meet(to, from, {}, own);
  return own;
}

}  // namespace plexway
