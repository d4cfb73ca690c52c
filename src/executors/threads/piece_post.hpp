#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <plexway/common/ids.hpp>
#include <plexway/executors/piece_ranks.hpp>

#include "complexes/partition/cut.hpp"
#include "complexes/partition/deal.hpp"
#include "executors/threads/rank_mail.hpp"
#include "labels/pieces/mail.hpp"

namespace plexway {

/// In a message, of a piece that posted: then come entries, and then the messages of each in turn.
struct MailHead {
  Index piece;
  Index peers;  ///< so many entries
  std::uint64_t messages;
};
struct MailEntry {
  Index peer;  ///< of the piece's
  Index messages;
};

/// What pieces of one process tell those of others in supersteps: one message to each, and the sums
/// and minima by the way. Of a piece that is another's there is a copy of what it posted to ours.
/// Does nothing for a process alone.
template <class Message>
class PiecePost {
 public:
  PiecePost(PieceRanks* ranks, const Cut& cut)
      : alone_(ranks == nullptr),
        deal_(deal_of(ranks)),
        cut_(cut),
        mail_(ranks),
        foreign_(alone_ ? 0 : cut.pieces.size()),
        reported_(deal_.count) {}

  [[nodiscard]] bool alone() const { return alone_; }
  /// What a piece of another process posted.
  [[nodiscard]] Outboxes& mail_of(std::size_t piece) { return foreign_[piece]; }

  /// Takes along what a piece of ours has posted for pieces of others.
  void collect(Index piece, Outbox& box, std::size_t superstep) {
    if (alone_) return;
    const CutPiece& cut = cut_.pieces[piece];
    for (std::size_t peer = 0; peer < cut.peer_count(); ++peer)
      if (const std::size_t owner = deal_.owner(cut.peers[peer].piece);
          owner != deal_.ours && box.has_messages(superstep, peer))
        reported_[owner].push_back(static_cast<Index>(peer));
    for (std::size_t r = 0; r < reported_.size(); ++r) {
      if (reported_[r].empty()) continue;
      MailHead head{piece, static_cast<Index>(reported_[r].size()), 0};
      for (const Index peer : reported_[r])
        head.messages += box.template messages<Message>(superstep, peer).size();
      mail_.to(r).add(head);
      for (const Index peer : reported_[r])
        mail_.to(r).add(MailEntry{
            peer, static_cast<Index>(box.template messages<Message>(superstep, peer).size())});
      for (const Index peer : reported_[r])
        mail_.to(r).add(box.template messages<Message>(superstep, peer));
      reported_[r].clear();
    }
  }

  /// All processes meet: sums and minima become those of all, messages arrive, and got(piece) is
  /// called for each piece of ours that has some. Returns the bytes sent.
  template <class Got>
  std::size_t meet(std::size_t superstep, std::span<std::uint64_t> sums, double& least,
                   const Got& got) {
    const std::size_t sent = mail_.meet(sums, least);
    for (std::size_t r = 0; r < deal_.count; ++r) unpack(superstep, mail_.from(r), got);
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
      box.start<Message>(superstep, cut.peer_count(), head.messages);
      auto entry = entries_.begin();
      for (std::size_t peer = 0; peer < cut.peer_count(); ++peer) {
        if (entry != entries_.end() && entry->peer == peer) {
          for (Index i = 0; i < entry->messages; ++i) box.add(mail.take<Message>());
          got(cut.peers[peer].piece);
          ++entry;
        }
        box.end_peer();
      }
    }
  }

  bool alone_;
  Deal deal_;
  const Cut& cut_;
  RankMail mail_;
  std::vector<Outboxes> foreign_;
  std::vector<std::vector<Index>> reported_;  // of one piece: its peers there
  std::vector<MailEntry> entries_;
};

}  // namespace plexway
