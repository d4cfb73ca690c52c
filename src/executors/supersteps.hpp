#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <limits>
#include <mutex>
#include <utility>
#include <vector>

#include <plexway/propagate/distance_field.hpp>
#include <plexway/propagate/options.hpp>

#include "complex/cut.hpp"
#include "executors/crowding.hpp"
#include "executors/team.hpp"
#include "propagate/endless.hpp"
#include "propagate/piece_memory.hpp"
#include "propagate/pieces/mail.hpp"
#include "propagate/progress_counter.hpp"

namespace plexway {

/// A propagation in pieces by a team. In a superstep each piece that has something to do takes the
/// letters of the superstep before, runs up to a horizon, and posts what its peers must know. So a
/// piece depends on what it knew, on letters in a fixed order and on the horizon, which depends on
/// sums and minima over all: the result is the same with any number of threads.
///
/// A piece:
///   cut()               who its peers are
///   mail()              its letters
///   take(letter), run(horizon, most, updates), post(superstep, work)
///   nearest()           no nearer label waits in it
///   statistics()        what it did so far
///
/// A piece belongs to a thread, whose cache has it; other threads take what that one has not come
/// to. Who does what changes nothing.
template <class Piece>
class Supersteps {
 public:
  using Real = typename Piece::Number;
  using Letter = typename Piece::Letter;

  /// `pieces` is indexed by their numbers. `pace`: so far the horizon moves on in a superstep, in
  /// the unit inside, which is `unit` of the caller's; of `simplices` in all. `counts` are started
  /// anew.
  template <class Pieces>
  Supersteps(const Team& team, Pieces& pieces, Real pace, std::size_t simplices, double unit,
             const PropagateOptions& options, SuperstepCounts& counts)
      : team_(team),
        pace_(pace),
        simplices_(simplices),
        unit_(unit),
        options_(options),
        told_(options, 65536),
        counts_(counts) {
    counts_.supersteps = counts_.runs = counts_.letters = counts_.bytes = 0;
    counts_.log.clear();
    for (Piece& piece : pieces) pieces_.push_back(&piece);
    after_.resize(pieces_.size());
    awake_.resize(pieces_.size());
    taken_ = std::vector<std::atomic<std::size_t>>(pieces_.size());
    if (pieces_.size() == 1) pace_ = std::numeric_limits<Real>::infinity();
  }

  /// Until no label waits. `before` is what was done by others. False if it ended early, as
  /// max_expansions were spent or goes_on(expansions), asked before each superstep, says no. Throws
  /// Cancelled, and what goes_on throws.
  template <class GoesOn>
  bool run(const PropagateStatistics& before, const GoesOn& goes_on) {
    before_ = before;
    goes_on_ = goes_on;
    ended_ = complete_ = false;
    for (std::size_t p = 0; p < pieces_.size(); ++p) after_[p].nearest = pieces_[p]->nearest();
    plan(std::numeric_limits<Real>::infinity(), false);
    while (!ended_ && !failure_)
      if (team_.size() == 1 || active_.size() == 1 || Crowding::crowded())
        attempt([&] { alone(); });
      else
        team_.hold([&] { together(); });
    if (failure_) std::rethrow_exception(failure_);
    return complete_;
  }

 private:
  struct alignas(64) Worked {
    double seconds = 0;
  };
  struct alignas(64) After {
    Real nearest;  ///< of what waits there
    Real told;     ///< of what it posted
    PieceWork work;
    std::size_t updates, reached;
  };

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
    std::vector<Worked> worked(static_cast<std::size_t>(team_.size()));
    double since = seconds_on_wall();
    bool apart = false;
    team_.run([&](int i, int threads) {
      while (!ended_ && !apart) {
        const double before = seconds_of_thread();
        attempt([&] { work(i, threads); });
        worked[static_cast<std::size_t>(i)].seconds += seconds_of_thread() - before;
        if (i != 0) {
          gate.pass(threads);
          continue;
        }
        gate.lead(threads, [&] {
          attempt([&] { advance(); });
          const double now = seconds_on_wall();
          constexpr double enough = 1.5e-3;
          if (now - since > enough) {
            double sum = 0;
            for (Worked& w : worked) sum += std::exchange(w.seconds, 0);
            Crowding::report(sum, now - since);
            since = now;
          }
          // One piece is not worth waking the others for.
          apart = failure_ || threads == 1 || active_.size() == 1 || Crowding::crowded();
        });
      }
    });
  }

  void work(int thread, int threads) {
    const auto take = [&](std::size_t i) {
      std::atomic<std::size_t>& taken = taken_[i];
      if (taken.load(std::memory_order_relaxed) != superstep_ &&
          taken.exchange(superstep_, std::memory_order_relaxed) != superstep_)
        step(active_[i], share_ + (i < more_));
    };
    for (std::size_t i = 0; i < active_.size(); ++i)
      if (active_[i] % static_cast<std::size_t>(threads) == static_cast<std::size_t>(thread))
        take(i);
    if (threads > 1)
      for (std::size_t i = active_.size(); i-- > 0;) take(i);
  }

  void step(std::size_t p, std::size_t most) {
    Piece& piece = *pieces_[p];
    const CutPiece& cut = piece.cut();
    for (std::size_t peer = 0; peer < cut.peer_count(); ++peer) {
      const CutPiece::Peer& from = cut.peers[peer];
      Outbox& box = pieces_[from.piece]->mail().of(superstep_ - 1);
      for (const Letter& letter : box.template letters<Letter>(superstep_ - 1, from.place))
        piece.take(letter);
    }
    After& after = after_[p];
    after.work = piece.run(horizon_, most, updates_);
    after.told = piece.post(superstep_, after.work);
    after.nearest = piece.nearest();
    const PropagateStatistics now = piece.statistics();
    after.updates = now.updates;
    after.reached = now.reached_simplices;
  }

  // ---- Alone ----

  void alone() {
    work(0, 1);
    advance();
  }

  void advance() {
    Real nearest = std::numeric_limits<Real>::infinity();
    std::size_t expansions = 0, first = 0;
    std::fill(awake_.begin(), awake_.end(), 0);
    for (const std::size_t p : active_) {
      const After& after = after_[p];
      expansions += after.work.expansions;
      first += after.work.first;
      counts_.letters += after.work.letters;
      counts_.bytes += after.work.letters * sizeof(Letter);
      if (after.work.letters == 0) continue;
      nearest = std::min(nearest, after.told);
      const CutPiece& cut = pieces_[p]->cut();
      const Outbox& box = pieces_[p]->mail().of(superstep_);
      for (std::size_t peer = 0; peer < cut.peer_count(); ++peer)
        if (box.has_letters(superstep_, peer)) awake_[cut.peers[peer].piece] = 1;
    }
    if (counts_.keeps_log) {
      auto& runs = counts_.log.emplace_back();
      for (const std::size_t p : active_) runs.push_back(after_[p].work.expansions);
    }
    ++counts_.supersteps;
    counts_.runs += active_.size();
    done_.expansions += expansions;
    constexpr double most_repeats = 0.3;
    plan(nearest,
         static_cast<double>(first) < (1 - most_repeats) * static_cast<double>(expansions));
    told_.count(done_.expansions, [&] { return progress(); });
  }

  /// The next superstep. `told` is the nearest of all letters.
  void plan(Real told, bool withhold) {
    Real nearest = told;
    for (const After& after : after_) nearest = std::min(nearest, after.nearest);
    if (!(nearest < std::numeric_limits<Real>::infinity())) {
      ended_ = complete_ = true;
      return;
    }
    horizon_ = std::max(nearest + pace_, withhold ? horizon_ : horizon_ + pace_);
    if (!(nearest < horizon_))  // the pace drowns in the distance
      horizon_ = std::nextafter(nearest, std::numeric_limits<Real>::infinity());
    active_.clear();
    for (std::size_t p = 0; p < pieces_.size(); ++p)
      if (awake_[p] != 0 || after_[p].nearest < horizon_) active_.push_back(p);
    // Not more than are left, in shares that depend on nothing but numbers.
    const std::size_t spent = before_.expansions + done_.expansions;
    if (!goes_on_(spent)) {
      ended_ = true;
      return;
    }
    const std::size_t left = options_.max_expansions - std::min(options_.max_expansions, spent);
    if (left == 0) {
      ended_ = true;
      return;
    }
    constexpr std::size_t most = 65536;
    share_ = std::min(left / active_.size(), most);
    more_ = share_ == most ? 0 : left % active_.size();
    ++superstep_;
    updates_ = before_.updates;
    for (const After& after : after_) updates_ += after.updates;
  }

  [[nodiscard]] Progress progress() const {
    std::size_t reached = before_.reached_simplices;
    for (const After& after : after_) reached += after.reached;
    return {before_.expansions + done_.expansions, reached, simplices_,
            static_cast<double>(horizon_) * unit_};
  }

  const Team& team_;
  std::vector<Piece*> pieces_;
  Real pace_;
  std::size_t simplices_;
  double unit_;
  const PropagateOptions& options_;
  std::function<bool(std::size_t)> goes_on_;
  ProgressCounter told_;

  // Changed alone.
  std::vector<After> after_;
  std::vector<std::uint8_t> awake_;  // has letters to take
  std::vector<std::size_t> active_;
  Real horizon_ = 0;
  std::size_t superstep_ = 1, share_ = 0, more_ = 0, updates_ = 0;
  bool ended_ = false, complete_ = false;
  PropagateStatistics before_, done_;
  SuperstepCounts& counts_;

  std::exception_ptr failure_;
  std::mutex failing_;
  std::vector<std::atomic<std::size_t>> taken_;  // of each that is active: in which superstep last
};

}  // namespace plexway
