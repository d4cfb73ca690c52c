#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "kernel/lanes.hpp"
#include "windows/entered_triangle.hpp"
#include "windows/merge.hpp"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpsabi"  // as in kernel/lanes.hpp

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

/// The windows of one edge, made as few as the limit allows.
template <class Real>
class Gathered : public Overlay<Real> {
 public:
  /// Neighbours are joined over gaps up to this share of the edge.
  static constexpr Real joint = Real(3e-2);

  /// Of windows on an edge of that length; `scale`: by so much may a merged one be off for each
  /// mean edge that it serves, up to one: errors at random add up to most where edges are long.
  void start(Real length, Real scale) {
    this->clear();
    length_ = length;
    scale_ = scale;
  }

  /// Are they neighbours between which distances go on? Then what lies in the gap is in no shadow
  /// worth a window.
  [[nodiscard]] bool joined(const Labelled<Real>& u, const Labelled<Real>& w) const {
    return (w.window.beam.begin - u.window.beam.end <= joint * length_) &
           (std::abs(w.window.at_begin - u.window.at_end) <= 4 * scale_ * length_);
  }

  /// One more that begins no sooner than the others: merged with the last, or beside it.
  void take(Labelled<Real> added) {
    if (this->size() == 0) {
      this->append(added);
      return;
    }
    Labelled<Real>& last = this->back();
    Window<Real>&u = last.window, &w = added.window;
    const Real overlap = u.beam.end - w.beam.begin;
    const bool nested = w.beam.end <= u.beam.end;
    if (overlap < joint * length_ && !nested && fits(last, added)) return;
    if (overlap > 0) {
      const Real end = nested ? w.beam.end : u.beam.end;
      const Real farther_first = u.at(w.beam.begin) - w.at_begin;
      const Real farther_last = nested ? u.at(end) - w.at_end : u.at_end - w.at(end);
      const bool u_first = farther_first <= 0, u_last = farther_last <= 0;
      if (u_first && u_last) {
        if (is_nearer_between(w, u, w.beam.begin, end)) {
          this->insert(added);
          return;
        }
        if (nested) return;
        w.begin_at(end);
      } else if (nested || u_last || (!u_first && is_nearer_between(u, w, w.beam.begin, end))) {
        this->insert(added);
        return;
      } else if (u_first) {
        const Real x = crossing(u, w, w.beam.begin, end, farther_first, farther_last);
        u.end_at(x);
        w.begin_at(x);
      } else {
        u.end_at(w.beam.begin);
      }
      if (!(u.beam.begin < u.beam.end)) {
        last = added;
        return;
      }
      if (!(w.beam.begin < w.beam.end) || fits(last, added)) return;
    }
    if (this->size() < this->most) this->append(added);
  }

 private:
  /// Makes one of two if it may.
  bool fits(Labelled<Real>& u, const Labelled<Real>& w) const {
    const Real length = w.window.beam.end - u.window.beam.begin;
    return u.source == w.source && joined(u, w) &&
           merge(u.window, w.window, scale_ * std::min(length, Real(1)));
  }

  Real length_ = 0, scale_ = 0;
};

/// Of merged windows: a window's light through a triangle, onto both edges it may leave by, at
/// once: lanes left near, left far, right near, right far. Each edge is measured from its pivot, A
/// or B, so that left and right, near and far are one formula; near is the end on the pivot's side.
template <class Real>
struct Spread {
  using L = kernel::Lanes<Real>;
  static constexpr Real rounding = sizeof(Real) == sizeof(float) ? Real(2e-6) : Real(1e-9);

  L x, h;    ///< the source as the edge sees it, as beams have it
  L behind;  ///< h, but below 0 where the edge turns its back to the source: at edges of no length
  L length;  ///< of the edge
  L at;      ///< where the light ends on it; `length` also for rays that leave by the other edge
  L distance;

  [[gnu::always_inline]] void go(const EnteredTriangle<Real>& t, const Window<Real>& w) {
    const Beam<Real>& beam = w.beam;
    if (beam.is_parallel()) [[unlikely]] {
      go_parallel(t, w);
      return;
    }
    const Real a = t.width - beam.x;
    const L cosine(t.cos_a, t.cos_a, t.cos_b, t.cos_b), sine(t.sin_a, t.sin_a, t.sin_b, t.sin_b);
    const L source(beam.x, beam.x, a, a), off(beam.h);
    const L point(beam.begin, beam.end, t.width - beam.end, t.width - beam.begin);
    length = L(t.left, t.left, t.right, t.right);
    x = cosine * source - sine * off;
    behind = sine * source + cosine * off;
    h = max(behind, L(Real(0)));
    // Where the ray through `point` goes; it never comes down to the edge where `slope` <= 0. What
    // only rounding keeps from the apex reaches it: else the way around the light's end, as long as
    // the straight one, would make a source of the apex.
    const L slope = behind - sine * point;
    const L reached = point * off / slope;
    at = select((slope.v > 0) & (reached.v < (length * L(1 - rounding)).v), reached, length);
    measure(t, w);
  }

  /// The distances where the light ends.
  [[gnu::always_inline]] void measure(const EnteredTriangle<Real>& t, const Window<Real>& w) {
    if (w.beam.is_parallel()) [[unlikely]] {
      const Real to_b = t.sigma_at_b(w.beam, w.sigma);
      distance = at * x + L(w.sigma, w.sigma, to_b, to_b);
      return;
    }
    const L along = at - x;
    distance = sqrt(along * along + behind * behind) + L(w.sigma);
  }

  /// Does light on this side reach the apex?
  [[nodiscard]] bool left_reaches() const { return !(at[1] < length[1]); }
  [[nodiscard]] bool right_reaches() const { return !(at[3] < length[3]); }
  [[nodiscard]] bool reaches_apex() const { return left_reaches() & right_reaches(); }

  /// Which sides have light that no vertex makes needless: bits 0 left, 1 right. A side's light is
  /// needless where its pivot serves the far end as well by more than `give`, or the apex the near
  /// end.
  [[nodiscard, gnu::always_inline]] int wanted(Real to_a, Real to_b, Real to_p, L give) const {
    const L from(to_p + length[0], to_a, to_p + length[2], to_b), way(-1, 1, -1, 1);
    const L other = __builtin_shufflevector(at.v, at.v, 1, 0, 3, 2);
    const int needless = kernel::lane_bits((from + way * at < distance - give) | (at.v == other.v));
    // Bit 0 where 0 and 1 are not set, bit 1 where 2 and 3 are not: looked up, not branched on.
    return sides[needless];
  }

  /// The window on the left edge from A, on the right edge from P: as triangles across see them.
  [[nodiscard]] Window<Real> left(const Window<Real>& w) const {
    return {{x[0], h[0], at[0], at[1]}, w.sigma, distance[0], distance[1], w.error};
  }
  [[nodiscard]] Window<Real> right(const Window<Real>& w) const {
    const Real l = length[2];
    if (w.beam.is_parallel()) [[unlikely]]
      return {{-x[2], h[2], l - at[3], l - at[2]},
              distance[2] + (l - at[2]) * x[2],
              distance[3],
              distance[2],
              w.error};
    return {{l - x[2], h[2], l - at[3], l - at[2]}, w.sigma, distance[3], distance[2], w.error};
  }

 private:
  static constexpr int sides[16] = {3, 2, 2, 2, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};

  [[gnu::noinline]] void go_parallel(const EnteredTriangle<Real>& t, const Window<Real>& w) {
    const Beam<Real> to_left = t.seen_left(w.beam), to_right = t.seen_right(w.beam);
    x = L(to_left.x, to_left.x, to_right.x, to_right.x);
    h = L(to_left.h, to_left.h, to_right.h, to_right.h);
    length = L(t.left, t.left, t.right, t.right);
    const auto reached = [](Real place, Real all) {
      return place < all * (1 - rounding) ? place : all;
    };
    at = L(reached(t.onto_left(w.beam, w.beam.begin), t.left),
           reached(t.onto_left(w.beam, w.beam.end), t.left),
           reached(t.onto_right(w.beam, w.beam.end), t.right),
           reached(t.onto_right(w.beam, w.beam.begin), t.right));
    measure(t, w);
  }
};

}  // namespace plexway::detail::windows

#pragma GCC diagnostic pop
