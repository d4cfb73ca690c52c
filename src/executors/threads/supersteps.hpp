#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <limits>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

#include <plexway/solve/distance_field.hpp>
#include <plexway/solve/options.hpp>

#include "complexes/partition/cut.hpp"
#include "complexes/partition/deal.hpp"
#include "executors/threads/crowding.hpp"
#include "executors/threads/piece_post.hpp"
#include "executors/threads/team.hpp"
#include "labels/piece_memory.hpp"
#include "labels/pieces/mail.hpp"
#include "labels/progress_counter.hpp"

namespace plexway {

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

  /// `pieces` is indexed by their numbers in the cut: null where another process has it. `pace`: so
  /// far the horizon moves on in a superstep, in the unit inside, which is `unit` of the caller's;
  /// of `simplices` in all. `counts` go on.
  Supersteps(const Team& team, const Cut& cut, std::span<Piece* const> pieces, Real pace,
             std::size_t simplices, double unit, const PropagateOptions& options,
             SuperstepCounts& counts)
      : team_(team),
        deal_(team.deal()),
        cut_(cut),
        pieces_(pieces.begin(), pieces.end()),
        post_(team.ranks(), cut),
        pace_(pace),
        simplices_(simplices),
        unit_(unit),
        options_(options),
        reported_(options, 65536),
        counts_(counts),
        owned_(pieces.size()) {
    for (Index p = 0; p < pieces_.size(); ++p)
      if (pieces_[p] != nullptr) ours_.push_back(p);
    after_.resize(pieces_.size());
    awake_.resize(pieces_.size());
    if (pieces_.size() == 1) pace_ = std::numeric_limits<Real>::infinity();
  }

  /// Until no label waits. `before` is what was done by others. False if it ended early, as
  /// max_expansions were spent or goes_on(expansions, weight), asked before each superstep, says
  /// no. Throws Cancelled, and what goes_on throws.
  template <class GoesOn>
  bool run(const PropagateStatistics& before, const GoesOn& goes_on) {
    before_ = before;
    goes_on_ = goes_on;
    ended_ = complete_ = false;
    for (const Index p : ours_) {
      after_[p].nearest = pieces_[p]->nearest();
      after_[p].weight = weight_of(*pieces_[p]);
    }
    const Sums sums = meet({});
    plan(sums, false);
    while (!ended_ && !failure_)
      if (team_.size() == 1 || active_.size() <= 1 || Crowding::crowded())
        attempt([&] { alone(); });
      else
        team_.hold([&] { together(); });
    if (failure_) std::rethrow_exception(failure_);
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
    for (const Index p : ours_) {
      const PropagateStatistics own = pieces_[p]->statistics();
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
    Real nearest;  ///< of what waits or was told
    std::size_t expansions = 0, first = 0, runs = 0, messages = 0, sent = 0;  // of a superstep
    std::size_t updates = 0, reached = 0, weight = 0;                         // until now
  };

  [[nodiscard]] static std::size_t weight_of(const Piece& piece) {
    if constexpr (requires { piece.weight(); })
      return piece.weight();
    else
      return 0;
  }

  template <class Work>
  void attempt(const Work& work) noexcept {
    try {
      work();
    } catch (...) {
      const std::scoped_lock lock(failing_);
      if (!failure_) failure_ = std::current_exception();
    }
  }

  // ---- Together ----

  /// Until it ends, or one thread is better.
  void together() {
    Gate gate(team_.size());
    CrowdWatch watch(team_.size());
    double since = seconds_on_wall();  // without what is done between supersteps
    bool apart = false;
    team_.run([&](int i, int threads) {
      while (!ended_ && !apart) {
        watch.watch(i, [&] { attempt([&] { work(i, threads); }); });
        if (i != 0) {
          gate.pass(threads);
          continue;
        }
        gate.lead(threads, [&] {
          watch.end_turn(seconds_on_wall() - since);
          attempt([&] {
            if (!failure_) advance();
          });
          since = seconds_on_wall();
          // One piece is not worth waking the others for.
          apart = failure_ || threads == 1 || active_.size() <= 1 || Crowding::crowded();
        });
      }
    });
  }

  void work(int thread, int threads) {
    owned_.share(
        superstep_, thread, threads, active_.size(),
        [&](std::size_t i) { return deal_.place(active_[i]); },
        [&](std::size_t i) { step(active_[i], grants_.empty() ? share_ : grants_[i]); });
  }

  void step(std::size_t p, std::size_t most) {
    Piece& piece = *pieces_[p];
    const CutPiece& cut = cut_.pieces[p];
    for (std::size_t peer = 0; peer < cut.peer_count(); ++peer) {
      const CutPiece::Peer& from = cut.peers[peer];
      Outbox& box = mail_of(from.piece).of(superstep_ - 1);
      for (const Message& message : box.template messages<Message>(superstep_ - 1, from.place))
        piece.take(message);
    }
    After& after = after_[p];
    after.work = piece.run(horizon_, most, updates_);
    after.told = piece.post(superstep_, after.work);
    after.nearest = piece.nearest();
    const PropagateStatistics now = piece.statistics();
    after.updates = now.updates;
    after.reached = now.reached_simplices;
    after.weight = weight_of(piece);
  }

  /// What a piece posted, whosever it is.
  [[nodiscard]] Outboxes& mail_of(std::size_t p) {
    return pieces_[p] != nullptr ? pieces_[p]->mail() : post_.mail_of(p);
  }

  // ---- Alone ----

  void alone() {
    work(0, 1);
    advance();
  }

  /// Sums up, with the other processes if there are any: who waits for messages is awake then.
  Sums meet(std::span<const std::size_t> ran) {
    constexpr Real infinity = std::numeric_limits<Real>::infinity();
    Sums all{.nearest = infinity};
    std::fill(awake_.begin(), awake_.end(), 0);
    all.runs = ran.size();
    for (const std::size_t p : ran) {
      const After& after = after_[p];
      all.expansions += after.work.expansions;
      all.first += after.work.first;
      all.messages += after.work.messages;
      if (after.work.messages == 0) continue;
      all.nearest = std::min(all.nearest, after.told);
      const CutPiece& cut = cut_.pieces[p];
      Outbox& box = pieces_[p]->mail().of(superstep_);
      for (std::size_t peer = 0; peer < cut.peer_count(); ++peer)
        if (box.has_messages(superstep_, peer)) awake_[cut.peers[peer].piece] = 1;
      post_.collect(static_cast<Index>(p), box, superstep_);
    }
    for (const Index p : ours_) {
      const After& after = after_[p];
      all.nearest = std::min(all.nearest, after.nearest);
      all.updates += after.updates;
      all.reached += after.reached;
      all.weight += after.weight;
    }
    if (post_.alone()) return all;
    std::array<std::uint64_t, 7> sums = {all.expansions, all.first,   all.runs,  all.messages,
                                         all.updates,    all.reached, all.weight};
    double nearest = static_cast<double>(all.nearest);
    all.sent = post_.meet(superstep_, sums, nearest, [&](std::size_t piece) { awake_[piece] = 1; });
    const auto size = [&](std::size_t i) { return static_cast<std::size_t>(sums[i]); };
    return {static_cast<Real>(nearest),
            size(0),
            size(1),
            size(2),
            size(3),
            all.sent,
            size(4),
            size(5),
            size(6)};
  }

  void advance() {
    const Sums sums = meet(active_);
    counts_.messages += sums.messages;
    counts_.bytes += sums.messages * sizeof(Message);
    counts_.sent += sums.sent;
    ++counts_.supersteps;
    counts_.runs += sums.runs;
    done_ += sums.expansions;
    constexpr double most_repeats = 0.3;
    plan(sums, static_cast<double>(sums.first) <
                   (1 - most_repeats) * static_cast<double>(sums.expansions));
    reported_.count(done_, [&] { return progress(sums.reached); });
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
    for (const Index p : ours_)
      if (awake_[p] != 0 || after_[p].nearest < horizon_) active_.push_back(p);
    const std::size_t spent = before_.expansions + done_;
    if (!goes_on_(spent, sums.weight)) {
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
    updates_ = before_.updates + sums.updates;
  }

  /// Not more than are left, in shares that depend on nothing but numbers.
  void grant(std::size_t left) {
    constexpr std::size_t most = 65536;
    share_ = most;
    grants_.clear();
    if (left / pieces_.size() >= most) return;
    // Who runs, in all processes: a bit each.
    std::vector<std::uint64_t> runs((pieces_.size() + 63) / 64);
    for (const std::size_t p : active_) runs[p / 64] |= std::uint64_t{1} << (p % 64);
    add_up(team_.ranks(), runs);
    std::size_t count = 0;
    for (const std::uint64_t word : runs) count += static_cast<std::size_t>(std::popcount(word));
    const std::size_t share = std::min(left / count, most), more = share == most ? 0 : left % count;
    std::size_t before = 0;  // pieces that run
    for (std::size_t p = 0; p < pieces_.size(); ++p) {
      if ((runs[p / 64] >> (p % 64) & 1) == 0) continue;
      if (pieces_[p] != nullptr) grants_.push_back(share + (before < more));
      ++before;
    }
  }

  [[nodiscard]] Progress progress(std::size_t reached) const {
    return {before_.expansions + done_, before_.reached_simplices + reached, simplices_,
            static_cast<double>(horizon_) * unit_};
  }

  const Team& team_;
  Deal deal_;
  const Cut& cut_;
  std::vector<Piece*> pieces_;
  std::vector<Index> ours_;
  PiecePost<Message> post_;
  Real pace_;
  std::size_t simplices_;
  double unit_;
  const PropagateOptions& options_;
  std::function<bool(std::size_t, std::size_t)> goes_on_;
  ProgressCounter reported_;

  // Changed alone.
  std::vector<After> after_;
  std::vector<std::uint8_t> awake_;  // has messages to take
  std::vector<std::size_t> active_;  // of ours
  std::vector<std::size_t> grants_;  // of each that is active, where not all get the same share
  Real horizon_ = 0;
  std::size_t superstep_ = 1, share_ = 0, updates_ = 0;
  bool ended_ = false, complete_ = false;
  PropagateStatistics before_, counted_;  // by others; of pieces, in a front
  std::size_t done_ = 0;                  // expansions
  SuperstepCounts& counts_;

  std::exception_ptr failure_;
  std::mutex failing_;
  OwnedWork owned_;
};

}  // namespace plexway
