#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <plexway/common/ids.hpp>
#include <plexway/executors/piece_ranks.hpp>

#include "complexes/partition/cut.hpp"
#include "complexes/partition/deal.hpp"
#include "executors/threads/rank_mail.hpp"
#include "labels/pieces/mail.hpp"

namespace plexway::detail {

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
