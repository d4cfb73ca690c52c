#pragma once

#include <algorithm>
#include <cstddef>

#include <plexway/solve/distance_field.hpp>
#include <plexway/solve/options.hpp>

#include "labels/front.hpp"
#include "labels/label_memory.hpp"
#include "labels/progress_counter.hpp"

namespace plexway::detail {

/// The front of executors with one thread: labels, which simplices are reached, wait, and came in
/// by which hinge. `Queue` orders the waiting ones. kLabels: carry the nearest source along.
///
/// A rule is the step, the same for all executors: from labels and records it computes offers. What
/// an executor decides is behind the front that the rule is given:
///   label(s), hinge(s), source(s)  what a reached simplex knows
///   reached(s)
///   accept(s, hinge, label, distance, source)  an offer that beats what s knows: where it is kept,
///     how the least of several is taken, and how s comes to wait
///   narrow(s, label)  tighter limits for s, heard from a neighbour; its distance stays
template <class Real, class SimplexLabel, class Queue, bool kLabels>
class Wavefront {
 public:
  using Label = SimplexLabel;

  /// `labels` and `source` have room for a sentinel behind the simplices.
  Wavefront(VisitMarks& marks, Label* labels, Queue queue, Index* source, std::size_t simplices,
            double unit, const PropagateOptions& options)
      : mark_(marks.data()),
        current_(marks.current()),
        labels_(labels),
        queue_(queue),
        source_(source),
        simplices_(simplices),
        unit_(unit),
        options_(&options) {}

  [[nodiscard, gnu::always_inline]] bool reached(Index s) const { return is_current(mark_[s]); }
  [[nodiscard, gnu::always_inline]] std::size_t hinge(Index s) const {
    return mark_[s] & VisitMarks::hinge_mask;
  }

  /// A reached simplex: is it still to be expanded?
  [[nodiscard]] bool waits(Index s) const { return (mark_[s] & VisitMarks::waiting) != 0; }

  [[nodiscard, gnu::always_inline]] const Label& label(Index s) const { return labels_[s]; }
  [[nodiscard]] Label* labels() const { return labels_; }
  /// Changes a label and nothing else.
  void put(Index s, const Label& label) { labels_[s] = label; }

  void narrow(Index s, const Label& label) { labels_[s] = label; }

  /// A simplex has a better label, come in by `hinge`, its centre at `distance`: it waits.
  [[gnu::always_inline]] void accept(Index s, std::size_t hinge, const Label& label, Real distance,
                                     Index source) {
    labels_[s] = label;
    const VisitMarks::Mark mark = mark_[s];
    const bool known = is_current(mark);
    const bool waits = known && (mark & VisitMarks::waiting) != 0;
    mark_[s] = static_cast<VisitMarks::Mark>(current_ | VisitMarks::waiting | hinge);
    if constexpr (kLabels) source_[s] = source;
    queue_.push(s, distance, !waits);
    reached_ += !known;
    ++updates_;
  }

  /// The same from elsewhere, while others of this front wait beyond a horizon.
  [[gnu::always_inline]] void take(Index s, std::size_t hinge, const Label& label, Real distance,
                                   Index source) {
    const bool waits = reached(s) && this->waits(s);
    accept(s, hinge, label, distance, source);
    if (waits) queue_.note(distance);
  }

  /// Likewise, but it need not wait for that: nothing is to be told from there.
  void know(Index s, std::size_t hinge, const Label& label, Index source) {
    labels_[s] = label;
    const bool waits = reached(s) && this->waits(s);
    mark_[s] = static_cast<VisitMarks::Mark>(current_ | (waits ? VisitMarks::waiting : 0) | hinge);
    if constexpr (kLabels) source_[s] = source;
  }

  [[nodiscard]] Index source(Index s) const {
    if constexpr (kLabels) return source_[s];
    return 0;
  }

  void set_source(Index s, Index source) {
    if constexpr (kLabels) source_[s] = source;
  }

  /// The next simplex to expand; false when none is left or the current share of the budget is
  /// spent: then `take_stock` says whether to go on.
  template <class DistanceOf>
  [[gnu::always_inline]] bool next(Index& s, DistanceOf distance_of) {
    if (countdown_ == 0 || !queue_.pop(s, distance_of)) return false;
    --countdown_;
    mark_[s] = static_cast<VisitMarks::Mark>(mark_[s] & ~VisitMarks::waiting);
    return true;
  }

  /// Calls take(simplex) for each that waits; none waits then.
  template <class Take>
  void drain(const Take& take) {
    const auto first_of_all = [](Index) { return Real(0); };
    for (Index s = 0; queue_.pop(s, first_of_all);) {
      mark_[s] = static_cast<VisitMarks::Mark>(mark_[s] & ~VisitMarks::waiting);
      take(s);
    }
  }
  /// What others did to labels and marks.
  void account(const PropagateStatistics& done, bool out_of_budget) {
    granted_ += done.expansions;
    updates_ += done.updates;
    reached_ += done.reached_simplices;
    out_of_budget_ = out_of_budget;
  }
  [[nodiscard]] PropagateStatistics statistics() const {
    return {expansions(), updates_, reached_};
  }

  // A propagation that goes on from what an earlier one left.

  /// So many simplices are reached already.
  void resume(std::size_t reached) { reached_ = reached; }
  /// A reached simplex that does not wait is unreached again.
  void forget(Index s) {
    mark_[s] = 0;
    --reached_;
  }

  [[nodiscard]] const Queue& queue() const { return queue_; }
  [[nodiscard]] Queue& queue() { return queue_; }

  [[nodiscard]] bool share_spent() const { return countdown_ == 0; }
  [[nodiscard]] std::size_t expansions() const { return granted_ - countdown_; }
  [[nodiscard]] std::size_t updates() const { return updates_; }
  [[nodiscard]] std::size_t reached_count() const { return reached_; }
  [[nodiscard]] bool out_of_budget() const { return out_of_budget_; }

  /// For rules whose steps take microseconds: shares are small, so that who wants to stop is heard
  /// within some hundredths of a second.
  void expect_slow_steps() { share_ = 4096; }

  /// So many expansions from now on, by one who keeps count himself: instead of `take_stock`.
  void grant(std::size_t expansions) {
    granted_ += expansions - countdown_;
    countdown_ = expansions;
  }

  /// Grants the next share of the budget and reports progress. `distance` is where the front is.
  /// False if the budget is spent. Throws Cancelled, and EndlessError.
  bool take_stock(Real distance) {
    if (countdown_ != 0) return false;
    if (options_->progress && granted_ > 0)
      tell_progress(*options_,
                    {granted_, reached_, simplices_, static_cast<double>(distance) * unit_});
    check_end(granted_, simplices_);
    const std::size_t most = options_->max_expansions;
    countdown_ = granted_ < most ? std::min(share_, most - granted_) : 0;
    granted_ += countdown_;
    out_of_budget_ = countdown_ == 0;
    return countdown_ != 0;
  }

 private:
  [[gnu::always_inline]] bool is_current(VisitMarks::Mark mark) const {
    return (mark ^ current_) < (1 << VisitMarks::epoch_shift);
  }

  VisitMarks::Mark* mark_;
  VisitMarks::Mark current_;
  Label* labels_;
  Queue queue_;
  Index* source_;
  std::size_t simplices_;
  double unit_;
  const PropagateOptions* options_;
  std::size_t share_ = 65536;
  std::size_t countdown_ = 0, granted_ = 0, updates_ = 0, reached_ = 0;
  bool out_of_budget_ = false;
};

}  // namespace plexway::detail
