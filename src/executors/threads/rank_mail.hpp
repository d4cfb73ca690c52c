#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include <plexway/common/ids.hpp>
#include <plexway/executors/piece_ranks.hpp>

#include "complexes/partition/cut.hpp"
#include "complexes/partition/deal.hpp"
#include "labels/pieces/mail.hpp"

namespace plexway::detail {

/// Bytes that grow, value by value.
class Parcel {
 public:
  template <class Value>
  void add(const Value& value) {
    add(std::span<const Value>(&value, 1));
  }
  template <class Value>
  void add(std::span<const Value> values) {
    static_assert(std::is_trivially_copyable_v<Value>);
    const auto bytes = std::as_bytes(values);
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
  }
  void clear() { bytes_.clear(); }
  [[nodiscard]] std::span<const std::byte> bytes() const { return bytes_; }

 private:
  std::vector<std::byte> bytes_;
};

/// Takes values out of bytes, in order.
class Unpacked {
 public:
  explicit Unpacked(std::span<const std::byte> bytes) : bytes_(bytes) {}

  template <class Value>
  [[nodiscard]] Value take() {
    static_assert(std::is_trivially_copyable_v<Value>);
    Value value;
    std::memcpy(&value, bytes_.data(), sizeof value);
    bytes_ = bytes_.subspan(sizeof value);
    return value;
  }
  /// As many as there is room for.
  template <class Value>
  void take(std::span<Value> values) {
    static_assert(std::is_trivially_copyable_v<Value>);
    if (values.empty()) return;
    std::memcpy(values.data(), bytes_.data(), values.size_bytes());
    bytes_ = bytes_.subspan(values.size_bytes());
  }
  /// The next so many bytes.
  [[nodiscard]] std::span<const std::byte> cut_off(std::size_t count) {
    const auto first = bytes_.first(count);
    bytes_ = bytes_.subspan(count);
    return first;
  }
  [[nodiscard]] bool empty() const { return bytes_.empty(); }

 private:
  std::span<const std::byte> bytes_;
};

/// Which pieces are this process's; all of them where it is alone and has no ranks.
[[nodiscard]] inline Deal deal_of(const PieceRanks* ranks) {
  return ranks == nullptr ? Deal{} : Deal{ranks->rank(), ranks->count()};
}

/// What each process sends each, itself too: fill, meet, read. Of one process alone the same.
class RankMail {
 public:
  explicit RankMail(PieceRanks* ranks)
      : ranks_(ranks), deal_(deal_of(ranks)), to_(deal_.count), from_(deal_.count) {}

  [[nodiscard]] std::size_t count() const { return deal_.count; }
  [[nodiscard]] Parcel& to(std::size_t rank) { return to_[rank]; }

  /// All processes: mail arrives, `sums` and `least` become those of all. Returns the bytes sent
  /// from this process to the others.
  std::size_t meet(std::span<std::uint64_t> sums, double& least) {
    if (ranks_ == nullptr) return 0;
    std::vector<PieceRanks::Bytes> out(count());
    std::size_t sent = 0;
    for (std::size_t r = 0; r < count(); ++r)
      if (r != deal_.ours) sent += (out[r] = to_[r].bytes()).size();
    ranks_->meet(out, from_, sums, least);
    for (std::size_t r = 0; r < count(); ++r)
      if (r != deal_.ours) to_[r] = {};
    return sent;
  }
  std::size_t meet() {
    double least = std::numeric_limits<double>::infinity();
    return meet({}, least);
  }
  [[nodiscard]] Unpacked from(std::size_t rank) const {
    return Unpacked(rank == deal_.ours ? to_[rank].bytes() : PieceRanks::Bytes(from_[rank]));
  }
  /// Calls read(mail) with what arrived, rank by rank, until it has taken all.
  template <class Read>
  void each(const Read& read) const {
    for (std::size_t r = 0; r < count(); ++r)
      for (Unpacked mail = from(r); !mail.empty();) read(mail);
  }
  /// All that arrived, where it is of one kind.
  template <class Value>
  [[nodiscard]] std::vector<Value> all() const {
    std::vector<Value> values;
    each([&](Unpacked& mail) { values.push_back(mail.take<Value>()); });
    return values;
  }

 private:
  PieceRanks* ranks_;
  Deal deal_;
  std::vector<Parcel> to_;
  std::vector<std::vector<std::byte>> from_;
};

/// The sum of each over all processes, which all call it.
inline void add_up(PieceRanks* ranks, std::span<std::uint64_t> sums) {
  double least = std::numeric_limits<double>::infinity();
  RankMail(ranks).meet(sums, least);
}
/// The sum over all processes.
[[nodiscard]] inline std::size_t sum_of(PieceRanks* ranks, std::size_t own) {
  std::uint64_t sum[] = {own};
  add_up(ranks, sum);
  return static_cast<std::size_t>(sum[0]);
}
/// The least over all processes.
[[nodiscard]] inline double least_of(PieceRanks* ranks, double own) {
  RankMail(ranks).meet({}, own);
  return own;
}
/// The largest over all processes.
[[nodiscard]] inline double most_of(PieceRanks* ranks, double own) {
  return -least_of(ranks, -own);
}

/// Each process hears of the pieces of all others: write(piece, parcel) for each of ours, and
/// read(piece, mail) for all that are not. Returns the bytes sent from this process to the others.
template <class Write, class Read>
std::size_t share_pieces(PieceRanks* ranks, std::size_t pieces, const Write& write,
                         const Read& read) {
  if (ranks == nullptr) return 0;
  const Deal deal = deal_of(ranks);
  Parcel all, one;
  for (std::size_t p = deal.ours; p < pieces; p += deal.count) {
    one.clear();
    write(p, one);
    all.add(std::uint64_t{p});
    all.add(std::uint64_t{one.bytes().size()});
    all.add(one.bytes());
  }
  std::vector<PieceRanks::Bytes> to(deal.count, all.bytes());
  to[deal.ours] = {};
  std::vector<std::vector<std::byte>> from(deal.count);
  double least = std::numeric_limits<double>::infinity();
  ranks->meet(to, from, {}, least);
  std::vector<std::span<const std::byte>> of(pieces);
  for (const auto& bytes : from)
    for (Unpacked mail(bytes); !mail.empty();) {
      const auto piece = mail.take<std::uint64_t>();
      of[piece] = mail.cut_off(mail.take<std::uint64_t>());
    }
  for (std::size_t p = 0; p < pieces; ++p)
    if (!deal.is_ours(p)) read(p, Unpacked(of[p]));
  return all.bytes().size() * (deal.count - 1);
}

/// What pieces of one process tell those of others in supersteps: one message to each, and the sums
/// and minima by the way. Does nothing for a process alone.
template <class Message>
class PiecePost {
 public:
  PiecePost(PieceRanks* ranks, const Cut& cut)
      : alone_(ranks == nullptr), deal_(deal_of(ranks)), cut_(cut), mail_(ranks) {
    if (alone_) return;
    heard_.resize(cut.pieces.size());
    deal_.each(heard_.size(), [&](std::size_t p) { heard_[p].resize(cut.pieces[p].peer_count()); });
  }

  [[nodiscard]] bool alone() const { return alone_; }
  /// What a peer that another process has posted to a piece of ours before the last meeting.
  [[nodiscard]] Unpacked heard(std::size_t piece, std::size_t peer) const {
    return Unpacked(heard_[piece][peer]);
  }

  /// Takes along what a piece of ours has posted for pieces of others.
  void collect(std::size_t piece, Outbox& box, std::size_t superstep) {
    if (alone_) return;
    const CutPiece& cut = cut_.pieces[piece];
    for (std::size_t peer = 0; peer < cut.peer_count(); ++peer) {
      const CutPiece::Peer& to = cut.peers[peer];
      const auto messages = box.template messages<Message>(superstep, peer);
      if (messages.empty() || deal_.is_ours(to.piece)) continue;
      Parcel& parcel = mail_.to(deal_.owner(to.piece));
      parcel.add(Head{messages.size(), to.piece, to.place});
      parcel.add(messages);
    }
  }

  /// All processes meet: sums and minima become those of all, messages arrive, and got(piece) is
  /// called for each piece of ours that has some. Returns the bytes sent.
  template <class Got>
  std::size_t meet(std::span<std::uint64_t> sums, double& least, const Got& got) {
    for (const auto& [piece, peer] : full_) heard_[piece][peer] = {};
    full_.clear();
    const std::size_t sent = mail_.meet(sums, least);
    mail_.each([&](Unpacked& in) {
      const Head head = in.take<Head>();
      heard_[head.to][head.from] = in.cut_off(head.messages * sizeof(Message));
      full_.push_back({head.to, head.from});
      got(head.to);
    });
    return sent;
  }

 private:
  struct Head {
    std::uint64_t messages;  ///< that follow
    Index to, from;          ///< a piece, and the place among its peers of who posted them
  };

  bool alone_;
  Deal deal_;
  const Cut& cut_;
  RankMail mail_;
  std::vector<std::vector<PieceRanks::Bytes>> heard_;  // of each piece of ours, by its peers
  std::vector<std::pair<Index, Index>> full_;          // which of these are not empty
};

}  // namespace plexway::detail
