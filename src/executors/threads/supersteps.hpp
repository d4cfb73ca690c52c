#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include <plexway/solve/distance_field.hpp>
#include <plexway/solve/options.hpp>

#include "complexes/partition/cut.hpp"
#include "complexes/partition/deal.hpp"
#include "executors/threads/rank_mail.hpp"
#include "executors/threads/team.hpp"
#include "labels/label_memory.hpp"
#include "labels/pieces/mail.hpp"
#include "labels/progress_counter.hpp"

namespace plexway::detail {

/// A propagation in pieces by a team. In a superstep each piece that has something to do takes the
/// messages of the superstep before, runs up to a horizon, and posts what its peers must know. So a
/// piece depends on what it knew, on messages in a fixed order and on the horizon, which depends on
/// sums and minima over all: the result is the same with any number of threads, and with any number
/// of processes that share the pieces.
///
/// A piece:
///   mail()              its messages
///   take(message), run(horizon, most, updates), post(superstep, work)
///   nearest()           no nearer label waits in it
///   statistics()        what it did so far
///   weight()            if it has that: summed up for goes_on
///
/// A piece belongs to a thread, whose cache has it; other threads take what that one has not come
/// to. Who does what changes nothing.
template <class Piece>
class Supersteps {
 public:
  using Real = typename Piece::Number;
  using Message = typename Piece::Message;

  /// `pieces` of the cut are ours. `pace`: so far the horizon moves on in a superstep, in the unit
  /// inside, which is `unit` of the caller's; of `simplices` in all. `counts` go on.
  Supersteps(const Team& team, const Cut& cut, OurPieces<Piece>& pieces, Real pace,
             std::size_t simplices, double unit, const PropagateOptions& options,
             SuperstepCounts& counts)
      : team_(team),
        cut_(cut),
        pieces_(pieces),
        post_(team.ranks(), cut),
        pace_(pace),
        simplices_(simplices),
        unit_(unit),
        options_(options),
        reported_(options, 65536),
        after_(pieces.size()),
        awake_(cut.pieces.size()),
        counts_(counts),
        watch_(team.size()),
        owned_(pieces.size()) {
    if (cut.pieces.size() == 1) pace_ = std::numeric_limits<Real>::infinity();
  }

  /// Until no label waits. `before` is what was done by others. False if it ended early, as
  /// max_expansions were spent or goes_on(expansions, weight), asked before each superstep, says
  /// no. Throws Cancelled, and what goes_on throws.
  template <class GoesOn>
  bool run(const PropagateStatistics& before, const GoesOn& goes_on) {
    before_ = before;
    goes_on_ = goes_on;
    ended_ = complete_ = false;
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      after_[i].nearest = pieces_[i].nearest();
      after_[i].weight = weight_of(pieces_[i]);
    }
    plan(meet({}), false);
    while (!ended_)
      if (worth_a_team())
        team_.hold([&] {
          do {
            together();
            advance();
          } while (!ended_ && worth_a_team());
        });
      else {
        for (std::size_t k = 0; k < active_.size(); ++k) step(k);
        advance();
      }
    return complete_;
  }

  /// run() for a front that does the rest of a solve, beside which pieces work: what they do is
  /// counted there as well.
  template <class Front, class GoesOn>
  void run_beside(Front& front, const GoesOn& goes_on) {
    PropagateStatistics others = front.statistics();
    others.expansions -= counted_.expansions;
    others.updates -= counted_.updates;
    others.reached_simplices -= counted_.reached_simplices;
    const bool complete = run(others, goes_on);
    const PropagateStatistics now = statistics();
    front.account({now.expansions - counted_.expansions, now.updates - counted_.updates,
                   now.reached_simplices - counted_.reached_simplices},
                  !complete);
    counted_ = now;
  }

  /// Of all pieces until now, those of other processes too, which must call it as well.
  [[nodiscard]] PropagateStatistics statistics() const {
    std::array<std::uint64_t, 3> sums{};
    for (const Piece& piece : pieces_) {
      const PropagateStatistics own = piece.statistics();
      sums[0] += own.expansions;
      sums[1] += own.updates;
      sums[2] += own.reached_simplices;
    }
    add_up(team_.ranks(), sums);
    const auto size = [&](std::size_t i) { return static_cast<std::size_t>(sums[i]); };
    return {size(0), size(1), size(2)};
  }

 private:
  struct alignas(64) After {
    Real nearest;  ///< of what waits there
    Real told;     ///< of what it posted
    PieceWork work;
    std::size_t updates, reached, weight;
  };
  /// Of all pieces.
  struct Sums {
    enum Name { expansions, first, messages, updates, reached, weight, names };

    Real nearest = std::numeric_limits<Real>::infinity();  ///< of what waits or was told
    std::size_t sent = 0;                                  ///< bytes
    /// Of a superstep up to `messages`, else until now.
    std::array<std::uint64_t, names> sum{};

    [[nodiscard]] std::size_t of(Name name) const { return static_cast<std::size_t>(sum[name]); }
  };

  [[nodiscard]] static std::size_t weight_of(const Piece& piece) {
    if constexpr (requires { piece.weight(); })
      return piece.weight();
    else
      return 0;
  }

  /// A superstep by the team.
  void together() {
    const double since = seconds_on_wall();
    team_.run([&](int thread, int threads) {
      watch_.watch(thread, [&] {
        owned_.share(
            superstep_, thread, threads, active_.size(), [&](std::size_t k) { return active_[k]; },
            [&](std::size_t k) { step(k); });
      });
    });
    watch_.end_turn(seconds_on_wall() - since);
  }
  /// One piece is not worth waking others for.
  [[nodiscard]] bool worth_a_team() const {
    return team_.size() > 1 && active_.size() > 1 && !Crowding::crowded();
  }

  /// Its number among all.
  [[nodiscard]] std::size_t number(std::size_t i) const {
    return pieces_.deal().ours + i * pieces_.deal().count;
  }

  /// Of the k-th that is active; by some thread.
  void step(std::size_t k) {
    const std::size_t i = active_[k];
    Piece& piece = pieces_[i];
    const CutPiece& cut = cut_.pieces[number(i)];
    for (std::size_t peer = 0; peer < cut.peer_count(); ++peer) {
      const CutPiece::Peer& from = cut.peers[peer];
      if (Piece* const posted = pieces_.find(from.piece)) {
        Outbox& box = posted->mail().of(superstep_ - 1);
        for (const Message& message : box.template messages<Message>(superstep_ - 1, from.place))
          piece.take(message);
      } else {
        for (Unpacked mail = post_.heard(number(i), peer); !mail.empty();)
          piece.take(mail.template take<Message>());
      }
    }
    After& after = after_[i];
    after.work = piece.run(horizon_, grants_.empty() ? share_ : grants_[k], updates_);
    after.told = piece.post(superstep_, after.work);
    after.nearest = piece.nearest();
    const PropagateStatistics now = piece.statistics();
    after.updates = now.updates;
    after.reached = now.reached_simplices;
    after.weight = weight_of(piece);
  }

  /// Sums up, with the other processes if there are any: who waits for messages is awake then.
  Sums meet(std::span<const std::size_t> ran) {
    Sums all;
    std::fill(awake_.begin(), awake_.end(), 0);
    for (const std::size_t i : ran) {
      const After& after = after_[i];
      all.sum[Sums::expansions] += after.work.expansions;
      all.sum[Sums::first] += after.work.first;
      all.sum[Sums::messages] += after.work.messages;
      if (after.work.messages == 0) continue;
      all.nearest = std::min(all.nearest, after.told);
      const CutPiece& cut = cut_.pieces[number(i)];
      Outbox& box = pieces_[i].mail().of(superstep_);
      for (std::size_t peer = 0; peer < cut.peer_count(); ++peer)
        if (!box.template messages<Message>(superstep_, peer).empty())
          awake_[cut.peers[peer].piece] = 1;
      post_.collect(number(i), box, superstep_);
    }
    for (const After& after : after_) {
      all.nearest = std::min(all.nearest, after.nearest);
      all.sum[Sums::updates] += after.updates;
      all.sum[Sums::reached] += after.reached;
      all.sum[Sums::weight] += after.weight;
    }
    if (post_.alone()) return all;
    double nearest = static_cast<double>(all.nearest);
    all.sent = post_.meet(all.sum, nearest, [&](std::size_t piece) { awake_[piece] = 1; });
    all.nearest = static_cast<Real>(nearest);
    return all;
  }

  void advance() {
    const Sums sums = meet(active_);
    const std::size_t messages = sums.of(Sums::messages), expansions = sums.of(Sums::expansions);
    counts_.messages += messages;
    counts_.bytes += messages * sizeof(Message);
    counts_.sent += sums.sent;
    ++counts_.supersteps;
    done_ += expansions;
    constexpr double most_repeats = 0.3;
    plan(sums, static_cast<double>(sums.of(Sums::first)) <
                   (1 - most_repeats) * static_cast<double>(expansions));
    reported_.count(done_, [&] { return progress(sums.of(Sums::reached)); });
  }

  /// The next superstep.
  void plan(const Sums& sums, bool withhold) {
    const Real nearest = sums.nearest;
    if (!(nearest < std::numeric_limits<Real>::infinity())) {
      ended_ = complete_ = true;
      return;
    }
    horizon_ = std::max(nearest + pace_, withhold ? horizon_ : horizon_ + pace_);
    if (!(nearest < horizon_))  // the pace drowns in the distance
      horizon_ = std::nextafter(nearest, std::numeric_limits<Real>::infinity());
    active_.clear();
    for (std::size_t i = 0; i < pieces_.size(); ++i)
      if (awake_[number(i)] != 0 || after_[i].nearest < horizon_) active_.push_back(i);
    const std::size_t spent = before_.expansions + done_;
    if (!goes_on_(spent, sums.of(Sums::weight))) {
      ended_ = true;
      return;
    }
    const std::size_t left = options_.max_expansions - std::min(options_.max_expansions, spent);
    if (left == 0) {
      ended_ = true;
      return;
    }
    grant(left);
    ++superstep_;
    updates_ = before_.updates + sums.of(Sums::updates);
  }

  /// Not more than are left, in shares that depend on nothing but numbers.
  void grant(std::size_t left) {
    constexpr std::size_t most = 65536;
    share_ = most;
    grants_.clear();
    const std::size_t pieces = cut_.pieces.size();
    if (left / pieces >= most) return;
    // Who runs, in all processes: a bit each.
    std::vector<std::uint64_t> runs((pieces + 63) / 64);
    for (const std::size_t i : active_)
      runs[number(i) / 64] |= std::uint64_t{1} << (number(i) % 64);
    add_up(team_.ranks(), runs);
    std::size_t count = 0;
    for (const std::uint64_t word : runs) count += static_cast<std::size_t>(std::popcount(word));
    const std::size_t share = std::min(left / count, most), more = share == most ? 0 : left % count;
    std::size_t before = 0;  // pieces that run
    for (std::size_t p = 0; p < pieces; ++p) {
      if ((runs[p / 64] >> (p % 64) & 1) == 0) continue;
      if (pieces_.deal().is_ours(p)) grants_.push_back(share + (before < more));
      ++before;
    }
  }

  [[nodiscard]] Progress progress(std::size_t reached) const {
    return {before_.expansions + done_, before_.reached_simplices + reached, simplices_,
            static_cast<double>(horizon_) * unit_};
  }

  const Team& team_;
  const Cut& cut_;
  OurPieces<Piece>& pieces_;
  PiecePost<Message> post_;
  Real pace_;
  std::size_t simplices_;
  double unit_;
  const PropagateOptions& options_;
  std::function<bool(std::size_t, std::size_t)> goes_on_;
  ProgressCounter reported_;

  // Changed alone.
  std::vector<After> after_;         // of ours
  std::vector<std::uint8_t> awake_;  // of all: has messages to take
  std::vector<std::size_t> active_;  // their numbers among ours
  std::vector<std::size_t> grants_;  // of each that is active, where not all get the same share
  Real horizon_ = 0;
  std::size_t superstep_ = 1, share_ = 0, updates_ = 0;
  bool ended_ = false, complete_ = false;
  PropagateStatistics before_, counted_;  // by others; of pieces, in a front
  std::size_t done_ = 0;                  // expansions
  SuperstepCounts& counts_;
  CrowdWatch watch_;
  OwnedWork owned_;
};

}  // namespace plexway::detail
