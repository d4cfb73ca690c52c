#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "kernel/lanes.hpp"
#include "windows/merge.hpp"

namespace plexway::detail::windows {

/// A window and the number of the source that it began at.
template <class Real>
struct Labelled {
  Window<Real> window;
  Index source;
};

/// Where two windows give the same distance, between two places where u's is the larger one by
/// `f_low` and `f_high`, of which one is below 0. Which place gives way is as good as random: no
/// branch.
template <class Real>
[[nodiscard]] Real crossing(const Window<Real>& u, const Window<Real>& w, Real low, Real high,
                            Real f_low, Real f_high) {
  using L = kernel::Lanes<Real>;
  constexpr int few = 2, most = 16;
  const Real near = (high - low) / 1024;
  L ends(low, f_low, high, f_high);
  Real f = 0;
  for (int i = 0;; ++i) {
    const Real t = ends[1] / (ends[1] - ends[3]);
    const Real x = ends[0] + (ends[2] - ends[0]) * (t >= 0 && t <= 1 ? t : Real(0.5));
    // Few will do, but not beside a source that is almost on the edge.
    if (i >= few && (std::abs(f) <= near || i == most)) return x;
    f = u.at(x) - w.at(x);
    ends = select(L(f * ends[1]) > L(Real(0)), L(x, f, ends[2], ends[3] / 2),
                  L(ends[0], ends[1] / 2, x, f));
  }
}

/// Is w the nearer of the two at its foot, strictly between two places where it is the farther one?
template <class Real>
[[nodiscard, gnu::always_inline]] inline bool is_nearer_between(const Window<Real>& w,
                                                                const Window<Real>& u, Real low,
                                                                Real high) {
  const Real foot = w.beam.x;
  return (foot > low) & (foot < high) && !w.beam.is_parallel() && w.sigma + w.beam.h < u.at(foot);
}

/// The windows on one edge that serve each of its points best: in order, none over another.
template <class Real>
class Overlay {
 public:
  static constexpr std::size_t most = 32;

  void clear() { count_ = 0; }
  [[nodiscard]] std::size_t size() const { return count_; }
  [[nodiscard]] Labelled<Real>& operator[](std::size_t i) { return pieces_[i]; }
  [[nodiscard]] const Labelled<Real>& operator[](std::size_t i) const { return pieces_[i]; }
  [[nodiscard]] Labelled<Real>& back() { return pieces_[count_ - 1]; }
  void append(const Labelled<Real>& piece) { pieces_[count_++] = piece; }

  /// Puts a window among those that are there; where two hold a point the nearer one keeps it.
  void insert(const Labelled<Real>& added) {
    if (count_ == 0 || !(added.window.beam.begin < back().window.beam.end)) {
      if (count_ < most) append(added);
      return;
    }
    const std::size_t old_count = std::exchange(count_, 0);
    std::array<Labelled<Real>, most> old;
    std::copy_n(pieces_.begin(), old_count, old.begin());
    owner_ = nullptr;
    Real from = added.window.beam.begin;
    const Real until = added.window.beam.end;
    bool left = true;  // is any of the new one still to be placed?
    for (std::size_t i = 0; i < old_count; ++i) {
      const Labelled<Real>& v = old[i];
      const Beam<Real>& beam = v.window.beam;
      if (!left || beam.end <= from) {
        add(v, beam.begin, beam.end);
        continue;
      }
      if (until <= beam.begin) {
        add(added, from, until);
        left = false;
        add(v, beam.begin, beam.end);
        continue;
      }
      if (from < beam.begin)
        add(added, from, beam.begin);
      else
        add(v, beam.begin, from);
      const Real low = std::max(from, beam.begin), high = std::min(until, beam.end);
      const Real farther_low = v.window.at(low) - added.window.at(low);
      const Real farther_high = v.window.at(high) - added.window.at(high);
      const bool low_new = farther_low > 0, high_new = farther_high > 0;
      if (low_new == high_new) {
        const Labelled<Real>&outer = low_new ? added : v, &inner = low_new ? v : added;
        const Window<Real>&o = outer.window, &n = inner.window;
        if (is_nearer_between(n, o, low, high)) {
          const Real foot = n.beam.x, nearer = n.at(foot) - o.at(foot);
          const Real begin = crossing(n, o, low, foot, n.at(low) - o.at(low), nearer);
          const Real end = crossing(n, o, foot, high, nearer, n.at(high) - o.at(high));
          add(outer, low, begin);
          add(inner, begin, end);
          add(outer, end, high);
        } else {
          add(outer, low, high);
        }
      } else {
        const Real x = crossing(v.window, added.window, low, high, farther_low, farther_high);
        add(low_new ? added : v, low, x);
        add(low_new ? v : added, x, high);
      }
      if (high < beam.end) add(v, high, beam.end);
      from = high;
      left = high < until;
    }
    if (left) add(added, from, until);
    flush();
  }

 private:
  void add(const Labelled<Real>& owner, Real begin, Real end) {
    if (!(begin < end)) return;
    if (owner_ != &owner) {
      flush();
      owner_ = &owner;
      begin_ = begin;
    }
    end_ = end;
  }
  void flush() {
    if (!owner_ || count_ == most) return;
    Labelled<Real> piece = *owner_;
    if (begin_ > piece.window.beam.begin) piece.window.begin_at(begin_);
    if (end_ < piece.window.beam.end) piece.window.end_at(end_);
    append(piece);
  }

  std::array<Labelled<Real>, most> pieces_;
  std::size_t count_ = 0;
  const Labelled<Real>* owner_ = nullptr;
  Real begin_ = 0, end_ = 0;
};

}  // namespace plexway::detail::windows
