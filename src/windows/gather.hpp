#pragma once

#include <algorithm>
#include <cmath>

#include "windows/overlay.hpp"

namespace plexway::detail::windows {

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

}  // namespace plexway::detail::windows
