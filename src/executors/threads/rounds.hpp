#pragma once

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <limits>
#include <mutex>
#include <vector>

#include <plexway/solve/distance_field.hpp>
#include <plexway/solve/options.hpp>

#include "executors/threads/team.hpp"
#include "executors/threads/team_front.hpp"
#include "labels/progress_counter.hpp"

namespace plexway {

/// A propagation by a team, in rounds of two halves (GSP 2021, section 5, has one). First the
/// offers that wait are *settled*: the least offer to a simplex becomes its label, the others are
/// stale. Then the simplices that got a label are *expanded*: their offers wait for the next round.
/// So nobody reads what somebody writes, and the result is a matter of the offers, not of who was
/// faster.
///
/// Order is that of DualQueue: offers beyond a limit wait apart until none is left before it.
template <class Real, class Store>
class Rounds {
 public:
  using Front = TeamFront<Real, Store>;
  using Label = typename Store::Label;
  using Key = OfferKey<Real>;
  using Waiting = typename Front::Waiting;

  /// `live` has room for a number a simplex; `step` is the dual queue's, in the unit inside.
  Rounds(const Team& team, TeamRooms& rooms, const Store& store, Index* live, std::size_t simplices,
         Real step, double unit, const PropagateOptions& options)
      : team_(team),
        store_(store),
        options_(options),
        told_(options, 4096),
        simplices_(simplices),
        unit_(unit),
        step_(step),
        key_(rooms.key.reserve<std::uint64_t>(simplices)),
        tie_(Key::ties_apart ? rooms.tie.reserve<std::uint64_t>(simplices) : nullptr),
        live_(live),
        near_(rooms.near, 64 + simplices / 8),
        far_(rooms.far, 64 + simplices / 8),
        kept_(rooms.kept, 64 + simplices / 8) {
    rooms.hand.resize(std::max(rooms.hand.size(), 3 * static_cast<std::size_t>(team.size())));
    hands_.reserve(static_cast<std::size_t>(team.size()));
    for (std::size_t i = 0; i < static_cast<std::size_t>(team.size()); ++i)
      hands_.push_back(Hand{
          Front(store, key_, rooms.hand[3 * i], rooms.hand[3 * i + 1], rooms.hand[3 * i + 2])});
    team.over(simplices, [&](std::size_t begin, std::size_t end) {
      std::fill(key_ + begin, key_ + end, Key::unreached);
      if constexpr (Key::ties_apart) std::fill(tie_ + begin, tie_ + end, no_rank);
    });
  }

  /// A label to expand, before `run`: the simplex has it already or it is the least for it.
  void add(Index s, std::size_t hinge, const Label& label, Real distance, Index source) {
    const Index tie = OfferTie::of(source, hinge);
    key_[s] = Key::of(distance, tie);
    hands_.front().front.far().add({key_[s], s, tie, {round_}, label});
    if (hands_.front().front.far().count() > 4096) far_.take_alone(hands_.front().front.far());
  }
  /// The distance of the least offer to a simplex.
  [[nodiscard]] Real least(Index s) const {
    return key_[s] == Key::unreached ? std::numeric_limits<Real>::infinity()
                                     : Key::distance(key_[s]);
  }

  /// Until no offer waits. `make(front)` gives what expands a simplex for a thread: expand(s), and
  /// ahead(s), called a little earlier, and far_ahead(s), earlier still, for
  /// prefetching. `before` is what was done so far. False
  /// if it ended early, as max_expansions were spent or `patience` expansions done: offers then
  /// still wait. Throws Cancelled.
  template <class Make>
  bool run(const Make& make, const PropagateStatistics& before,
           std::size_t patience = std::numeric_limits<std::size_t>::max()) {
    before_ = before;
    narrows_ = requires(decltype(make(hands_.front().front))& expand) { expand.narrow(Index()); };
    patience_ = patience;
    done_ = {};
    ended_early_ = out_of_budget_ = stuck_ = false;
    told_.restart();
    far_.take_alone(hands_.front().front.far());
    live_count_ = 0;
    next_queue();
    Gate gate(team_.size());
    team_.run([&](int i, int threads) {
      Hand& hand = hands_[static_cast<std::size_t>(i)];
      auto expand = make(hand.front);
      while (phase_ != Phase::done) {
        attempt([&] { work(hand, expand); });
        if (i != 0) {
          gate.pass(threads);
          continue;
        }
        gate.lead(threads, [&] {
          attempt([&] {
            advance();
            // A short front is not worth waking the others for.
            while (phase_ != Phase::done && (threads == 1 || todo() <= team_.chunk())) {
              work(hand, expand);
              advance();
            }
          });
          if (failure_) phase_ = Phase::done;
        });
      }
    });
    if (failure_) std::rethrow_exception(failure_);
    for (Hand& hand : hands_) {
      done_.reached_simplices += hand.reached;
      hand.reached = 0;
    }
    return !ended_early_;
  }

  /// What `run` did. (Settling what was added counts as an update.)
  [[nodiscard]] const PropagateStatistics& done() const { return done_; }
  [[nodiscard]] bool out_of_budget() const { return out_of_budget_; }
  /// Updates so far, within a round.
  [[nodiscard]] std::size_t updates() const { return before_.updates + done_.updates; }

  /// After it ended early: settles what waits and calls take(simplex) for each.
  template <class Take>
  void hand_over(const Take& take) {
    for (OfferQueue<Waiting>* queue : {&near_, &far_}) {
      for (std::size_t i = 0; i < queue->count(); ++i) {
        const Waiting& offer = (*queue)[i];
        if (key_[offer.simplex] != offer.key) continue;
        done_.reached_simplices += store_.settle(offer);
        take(offer.simplex);
      }
      queue->clear();
    }
  }

 private:
  enum class Phase { contest, settle, narrow, expand, done };
  // So many labels, with what their expansion reads, are in a core's cache from round to round.
  static constexpr std::size_t short_front = 8192;
  static constexpr std::uint64_t no_rank = ~std::uint64_t{0};

  struct alignas(64) Hand {
    Front front;
    std::size_t reached = 0;
    std::uint64_t nearest = Key::unreached;  // of those that it kept waiting
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

  [[nodiscard]] std::size_t todo() const {
    return phase_ == Phase::expand || phase_ == Phase::narrow ? expanding_ : queue_->count();
  }

  // ---- Together ----

  template <class Expand>
  void work(Hand& hand, Expand& expand) {
    const std::size_t count = todo(), chunk = team_.chunk();
    for (;;) {
      const std::size_t begin = cursor_.fetch_add(chunk, std::memory_order_relaxed);
      if (begin >= count) return;
      const std::size_t end = std::min(begin + chunk, count);
      switch (phase_) {
        case Phase::contest:
          contest(begin, end);
          break;
        case Phase::settle:
          settle(hand, begin, end);
          break;
        case Phase::narrow:
          if constexpr (requires { expand.narrow(Index()); })
            fetching(expand, begin, end, [&](Index s) { expand.narrow(s); });
          break;
        case Phase::expand:
          expand_chunk(hand, expand, begin, end);
          break;
        case Phase::done:
          break;
      }
    }
  }

  /// Of equal offers in double the one with the least rank wins.
  void contest(std::size_t begin, std::size_t end) {
    constexpr std::size_t ahead = 16;
    for (std::size_t i = begin; i < end; ++i) {
      if (i + ahead < end) {
        const Index next = (*queue_)[i + ahead].simplex;
        __builtin_prefetch(&key_[next]);
        __builtin_prefetch(&tie_[next], 1);
      }
      const Waiting& offer = (*queue_)[i];
      if (key_[offer.simplex] != offer.key || offer.key >= limit_) continue;
      const std::atomic_ref<std::uint64_t> tie(tie_[offer.simplex]);
      std::uint64_t known = tie.load(std::memory_order_relaxed);
      while (offer.rank() < known &&
             !tie.compare_exchange_weak(known, offer.rank(), std::memory_order_relaxed)) {
      }
    }
  }
  [[nodiscard]] bool wins(const Waiting& offer) const {
    if constexpr (!Key::ties_apart) return true;
    const std::atomic_ref<std::uint64_t> tie(tie_[offer.simplex]);
    std::uint64_t known = offer.rank();
    return tie.load(std::memory_order_relaxed) == known &&
           tie.compare_exchange_strong(known, no_rank, std::memory_order_relaxed);
  }

  void settle(Hand& hand, std::size_t begin, std::size_t end) {
    constexpr std::size_t most = 256, ahead = 8;
    Index won[most];
    std::size_t count = 0, reached = 0;
    const auto pass_on = [&] {
      const std::size_t at = live_count_.fetch_add(count, std::memory_order_relaxed);
      std::copy_n(won, count, live_ + at);
      count = 0;
    };
    for (std::size_t i = begin; i < end; ++i) {
      if (i + ahead < end) {
        const Index next = (*queue_)[i + ahead].simplex;
        __builtin_prefetch(&key_[next]);
        store_.prefetch(next);
      }
      const Waiting& offer = (*queue_)[i];
      if (key_[offer.simplex] != offer.key) continue;  // stale
      if (offer.key >= limit_) {
        hand.nearest = std::min(hand.nearest, offer.key);
        hand.front.far().add(offer);
        continue;
      }
      if (!wins(offer)) continue;
      reached += store_.settle(offer);
      won[count++] = offer.simplex;
      if (count == most) pass_on();
    }
    if (count > 0) pass_on();
    hand.reached += reached;
    kept_.take(hand.front.far());
  }

  template <class Expand>
  void expand_chunk(Hand& hand, Expand& expand, std::size_t begin, std::size_t end) {
    hand.front.start(round_, limit_, expanding_ < short_front);
    fetching(expand, begin, end, [&](Index s) { expand(s); });
    near_.take(hand.front.near());
    far_.take(hand.front.far());
  }

  /// `visit(simplex)` for some of those that live, what it needs fetched on the way there.
  template <class Expand, class Visit>
  void fetching(Expand& expand, std::size_t begin, std::size_t end, const Visit& visit) {
    constexpr std::size_t ahead = 4, far_ahead = 8;
    for (std::size_t i = begin; i < std::min(begin + far_ahead, end); ++i)
      expand.far_ahead(live_[i]);
    for (std::size_t i = begin; i < std::min(begin + ahead, end); ++i) expand.ahead(live_[i]);
    for (std::size_t i = begin; i < end; ++i) {
      if (i + far_ahead < end) expand.far_ahead(live_[i + far_ahead]);
      if (i + ahead < end) expand.ahead(live_[i + ahead]);
      visit(live_[i]);
    }
  }

  // ---- Alone, between the halves of a round ----

  void advance() {
    cursor_.store(0, std::memory_order_relaxed);
    if (phase_ == Phase::contest) {
      phase_ = Phase::settle;
    } else if (phase_ == Phase::settle) {
      end_settling();
    } else if (phase_ == Phase::narrow) {
      for (Hand& hand : hands_) hand.front.put_narrowed();
      phase_ = Phase::expand;
    } else if (phase_ == Phase::expand) {
      done_.expansions += expanding_;
      ++round_;
      for (Hand& hand : hands_) {
        near_.take_alone(hand.front.near());
        far_.take_alone(hand.front.far());
      }
      const std::size_t live = live_count_.exchange(0, std::memory_order_relaxed);
      out_of_budget_ = expanding_ < live;
      ended_early_ = out_of_budget_ || done_.expansions > patience_;
      told_.count(done_.expansions, [&] { return progress(); });
      if (ended_early_)
        phase_ = Phase::done;
      else
        next_queue();
    }
  }

  void end_settling() {
    const std::size_t live = live_count_.load(std::memory_order_relaxed);
    done_.updates += live;
    if (queue_ == &near_) {
      near_.clear();
    } else {
      nearest_ = Key::unreached;
      for (Hand& hand : hands_) {
        kept_.take_alone(hand.front.far());
        nearest_ = std::min(nearest_, hand.nearest);
        hand.nearest = Key::unreached;
      }
      far_.clear();
      far_.swap(kept_);
    }
    if (live == 0) {
      stuck_ = queue_ == &far_;
      next_queue();
      return;
    }
    const std::size_t spent = before_.expansions + done_.expansions;
    expanding_ = std::min(live, options_.max_expansions - std::min(options_.max_expansions, spent));
    phase_ = narrows_ ? Phase::narrow : Phase::expand;
  }

  void next_queue() {
    if (near_.count() > 0) {
      queue_ = &near_;
    } else if (far_.count() > 0) {
      queue_ = &far_;
      raise_limit();
    } else {
      phase_ = Phase::done;
      return;
    }
    phase_ = Key::ties_apart ? Phase::contest : Phase::settle;
  }

  void raise_limit() {
    // Where the next step brings nothing, to where something is.
    const Real nearest = stuck_ && nearest_ != Key::unreached ? Key::distance(nearest_) : distance_;
    distance_ = nearest + step_;
    if (!(nearest < distance_))  // the step drowns in the distance
      distance_ = std::nextafter(nearest, std::numeric_limits<Real>::infinity());
    limit_ = Key::of(distance_, 0);
    stuck_ = false;
  }

  [[nodiscard]] Progress progress() const {
    std::size_t reached = before_.reached_simplices;
    for (const Hand& hand : hands_) reached += hand.reached;
    return {before_.expansions + done_.expansions, reached, simplices_,
            static_cast<double>(distance_) * unit_};
  }

  const Team& team_;
  Store store_;
  const PropagateOptions& options_;
  ProgressCounter told_;
  std::size_t simplices_;
  double unit_;
  Real step_, distance_ = 0;  // the limit as a distance
  std::uint64_t* key_;
  std::uint64_t* tie_;
  Index* live_;
  OfferQueue<Waiting> near_, far_, kept_;
  std::vector<Hand> hands_;

  // Changed alone.
  Phase phase_ = Phase::done;
  OfferQueue<Waiting>* queue_ = nullptr;  // what is being settled
  std::uint64_t limit_ = 0, nearest_ = Key::unreached;
  std::size_t expanding_ = 0, patience_ = 0;
  std::uint32_t round_ = 0;
  bool narrows_ = false, stuck_ = false, ended_early_ = false, out_of_budget_ = false;
  PropagateStatistics before_, done_;

  std::exception_ptr failure_;
  std::mutex failing_;
  alignas(64) std::atomic<std::size_t> cursor_{0};
  alignas(64) std::atomic<std::size_t> live_count_{0};
};

}  // namespace plexway
