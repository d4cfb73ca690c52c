#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>

#include "executors/threads/offers.hpp"
#include "labels/visit_marks.hpp"

namespace plexway {

/// Where the labels of simplices are kept: written between rounds, by one thread each; read while
/// offers are made.
template <class SimplexLabel, bool kLabels>
class SimplexStore {
 public:
  using Label = SimplexLabel;

  SimplexStore(VisitMarks& marks, Label* labels, Index* source)
      : mark_(marks.data()), current_(marks.current()), labels_(labels), source_(source) {}

  [[nodiscard, gnu::always_inline]] bool reached(Index s) const {
    return (mark_[s] ^ current_) < (1 << VisitMarks::epoch_shift);
  }
  [[nodiscard, gnu::always_inline]] std::size_t hinge(Index s) const {
    return mark_[s] & VisitMarks::hinge_mask;
  }
  [[nodiscard, gnu::always_inline]] const Label& label(Index s) const { return labels_[s]; }
  [[nodiscard]] Index source(Index s) const {
    if constexpr (kLabels) return source_[s];
    return 0;
  }

  void put(Index s, const Label& label) const { labels_[s] = label; }
  /// The label of a simplex from now on. True if it had none.
  template <class Offer>
  [[gnu::always_inline]] bool settle(const Offer& offer) const {
    const Index s = offer.simplex;
    const bool known = reached(s);
    labels_[s] = offer.label;
    mark_[s] = static_cast<VisitMarks::Mark>(current_ | (offer.tie & OfferTie::hinge_mask));
    if constexpr (kLabels) source_[s] = offer.tie >> OfferTie::source_shift;
    return !known;
  }
  void prefetch(Index s) const {
    __builtin_prefetch(&labels_[s], 1);
    __builtin_prefetch(&mark_[s], 1);
    if constexpr (kLabels) __builtin_prefetch(&source_[s], 1);
  }

 private:
  VisitMarks::Mark* mark_;
  VisitMarks::Mark current_;
  Label* labels_;
  Index* source_;
};

/// What one thread knows while it makes offers: the front that rules see. An offer lowers the
/// simplex's key by an atomic minimum and, if it is the least so far, waits with its label; the
/// least of all becomes the label before the next round.
template <class Real, class Store>
class TeamFront : public Store {
 public:
  using Label = typename Store::Label;
  using Key = OfferKey<Real>;
  using Waiting = Offer<Label, Key::ties_apart>;

  /// Tighter limits for a simplex that this round settled: others may read its label now.
  struct Narrowed {
    Index simplex;
    Label label;
  };

  TeamFront(const Store& store, std::uint64_t* key, Room& near, Room& far, Room& narrowed)
      : Store(store),
        key_(key),
        waiting_{OfferList<Waiting>(near), OfferList<Waiting>(far)},
        narrowed_(narrowed) {}

  void narrow_later(Index s, const Label& label) { narrowed_.add({s, label}); }
  /// By one thread while no other is at it.
  void put_narrowed() {
    if constexpr (requires(const Label& label) { this->put(Index(), label); })
      for (std::size_t i = 0; i < narrowed_.count(); ++i)
        this->put(narrowed_.data()[i].simplex, narrowed_.data()[i].label);
    narrowed_.clear();
  }

  [[gnu::always_inline]] void accept(Index s, std::size_t hinge, const Label& label, Real distance,
                                     Index source) {
    const Index tie = OfferTie::of(source, hinge);
    const std::uint64_t key = Key::of(distance, tie);
    const std::atomic_ref<std::uint64_t> least(key_[s]);
    std::uint64_t known = least.load(std::memory_order_relaxed);
    do {
      if (key > known || (!Key::ties_apart && key == known)) return;
      if (key == known) break;
    } while (!least.compare_exchange_weak(known, key, std::memory_order_relaxed));
    waiting_[key >= limit_].add({key, s, tie, {round_}, label});
  }

  OfferList<Waiting>& near() { return waiting_[0]; }
  OfferList<Waiting>& far() { return waiting_[1]; }
  [[nodiscard]] bool expands_soon() const { return short_; }
  /// Before each round: offers beyond the limit wait apart; is the front so short that what is
  /// fetched in this round is still there in the next?
  void start(std::uint32_t round, std::uint64_t limit, bool is_short) {
    round_ = round, limit_ = limit, short_ = is_short;
  }

 private:
  std::uint64_t* key_;
  std::uint64_t limit_ = 0;
  std::uint32_t round_ = 0;
  bool short_ = true;
  OfferList<Waiting> waiting_[2];
  OfferList<Narrowed> narrowed_;
};

}  // namespace plexway
