#pragma once

#include <algorithm>
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

namespace plexway {

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

/// In a message, of a piece that posted: then come entries, and then the letters of each in turn.
struct MailHead {
  Index piece;
  Index peers;  ///< so many entries
  std::uint64_t letters;
};
struct MailEntry {
  Index peer;  ///< of the piece's
  Index letters;
};

/// What pieces of one process tell those of others in supersteps: one message to each, and the sums
/// and minima by the way. Of a piece that is another's there is a copy of what it posted to ours.
/// Does nothing for a process alone.
template <class Letter>
class PiecePost {
 public:
  PiecePost(PieceRanks* ranks, Deal deal, const Cut& cut)
      : ranks_(ranks), deal_(deal), cut_(cut), foreign_(ranks ? cut.pieces.size() : 0) {
    if (ranks_ == nullptr) return;
    to_.resize(deal.count);
    out_.resize(deal.count);
    from_.resize(deal.count);
    reported_.resize(deal.count);
  }

  [[nodiscard]] bool alone() const { return ranks_ == nullptr; }
  /// What a piece of another process posted.
  [[nodiscard]] Outboxes& mail_of(std::size_t piece) { return foreign_[piece]; }

  /// Takes along what a piece of ours has posted for pieces of others.
  void collect(Index piece, Outbox& box, std::size_t superstep) {
    if (ranks_ == nullptr) return;
    const CutPiece& cut = cut_.pieces[piece];
    for (std::size_t peer = 0; peer < cut.peer_count(); ++peer)
      if (const std::size_t owner = deal_.owner(cut.peers[peer].piece);
          owner != deal_.ours && box.has_letters(superstep, peer))
        reported_[owner].push_back(static_cast<Index>(peer));
    for (std::size_t r = 0; r < reported_.size(); ++r) {
      if (reported_[r].empty()) continue;
      MailHead head{piece, static_cast<Index>(reported_[r].size()), 0};
      for (const Index peer : reported_[r])
        head.letters += box.template letters<Letter>(superstep, peer).size();
      to_[r].add(head);
      for (const Index peer : reported_[r])
        to_[r].add(MailEntry{
            peer, static_cast<Index>(box.template letters<Letter>(superstep, peer).size())});
      for (const Index peer : reported_[r])
        to_[r].add(box.template letters<Letter>(superstep, peer));
      reported_[r].clear();
    }
  }

  /// All processes meet: sums and minima become those of all, letters arrive, and got(piece) is
  /// called for each piece of ours that has some. Returns the bytes sent.
  template <class Got>
  std::size_t meet(std::size_t superstep, std::span<std::uint64_t> sums, double& least,
                   const Got& got) {
    if (ranks_ == nullptr) return 0;
    std::size_t sent = 0;
    for (std::size_t r = 0; r < to_.size(); ++r) sent += (out_[r] = to_[r].bytes()).size();
    ranks_->meet(out_, from_, sums, least);
    for (Parcel& parcel : to_) parcel.clear();
    for (std::size_t r = 0; r < from_.size(); ++r)
      if (r != deal_.ours) unpack(superstep, Unpacked(from_[r]), got);
    return sent;
  }

 private:
  template <class Got>
  void unpack(std::size_t superstep, Unpacked mail, const Got& got) {
    while (!mail.empty()) {
      const MailHead head = mail.take<MailHead>();
      const CutPiece& cut = cut_.pieces[head.piece];
      Outbox& box = foreign_[head.piece].of(superstep);
      entries_.clear();
      for (Index i = 0; i < head.peers; ++i) entries_.push_back(mail.take<MailEntry>());
      box.start<Letter>(superstep, cut.peer_count(), head.letters);
      auto entry = entries_.begin();
      for (std::size_t peer = 0; peer < cut.peer_count(); ++peer) {
        if (entry != entries_.end() && entry->peer == peer) {
          for (Index i = 0; i < entry->letters; ++i) box.add(mail.take<Letter>());
          got(cut.peers[peer].piece);
          ++entry;
        }
        box.end_peer();
      }
    }
  }

  PieceRanks* ranks_;
  Deal deal_;
  const Cut& cut_;
  std::vector<Outboxes> foreign_;
  std::vector<Parcel> to_;  // of each process
  std::vector<PieceRanks::Bytes> out_;
  std::vector<std::vector<std::byte>> from_;
  std::vector<std::vector<Index>> reported_;  // of one piece: its peers there
  std::vector<MailEntry> entries_;
};

/// What each process knows of its own pieces, for all of them.
class SharedPieces {
 public:
  /// write(piece, parcel) for each piece of ours. All processes call it.
  template <class Write>
  SharedPieces(PieceRanks& ranks, Deal deal, std::size_t pieces, const Write& write)
      : of_(pieces), from_(deal.count) {
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
    double least = std::numeric_limits<double>::infinity();
    ranks.meet(to, from_, {}, least);
    for (const auto& bytes : from_)
      for (Unpacked mail(bytes); !mail.empty();) {
        const auto piece = mail.take<std::uint64_t>();
        of_[piece] = mail.cut_off(mail.take<std::uint64_t>());
      }
    sent_ = all.bytes().size() * (deal.count - 1);
  }
  SharedPieces(const SharedPieces&) = delete;
  SharedPieces& operator=(const SharedPieces&) = delete;

  /// What was written of a piece that is not ours.
  [[nodiscard]] Unpacked of(std::size_t piece) const { return Unpacked(of_[piece]); }
  /// Bytes from this process to the others.
  [[nodiscard]] std::size_t sent() const { return sent_; }

 private:
  std::vector<std::span<const std::byte>> of_;
  std::vector<std::vector<std::byte>> from_;
  std::size_t sent_ = 0;
};

/// The sum of each over all processes; unchanged where there is one.
inline void add_up(PieceRanks* ranks, std::span<std::uint64_t> sums) {
  if (ranks == nullptr) return;
  std::vector<PieceRanks::Bytes> to(ranks->count());
  std::vector<std::vector<std::byte>> from(ranks->count());
  double least = std::numeric_limits<double>::infinity();
  ranks->meet(to, from, sums, least);
}

}  // namespace plexway
