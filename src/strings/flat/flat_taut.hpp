#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "complexes/simplicial/flat_domain.hpp"

namespace plexway::detail::strings {
/// The shortest string between two points over given bending faces, in their order. Between faces
/// nothing is in its way: that is for others to see to.
///
/// With one bend in closed form: unfolded about the face, the string is a line. With more, one bend
/// after another takes its best place between its neighbours, which no end of a face disturbs, and
/// Newton's method moves those together that are not at an end. (The length is a convex function.)
template <int N>
class Taut {
  static_assert(N > 2, "bends have a coordinate");

 public:
  using Point = std::array<double, N>;
  using Face = BendingFace<N>;
  using Along = typename Face::Along;
  static constexpr std::size_t most = 24;

  explicit Taut(const FlatDomain<N>& domain) : domain_(domain) {}

  void start(const Point& from, const Point& to) {
    from_ = from;
    to_ = to;
    count_ = 0;
  }
  void add(Index face, const Along& guess) {
    face_[count_] = &domain_.faces[face];
    along_[count_] = guess;
    point_[count_] = face_[count_]->at(guess);
    ++count_;
  }
  [[nodiscard]] const Along& along(std::size_t i) const { return along_[i]; }

  /// Its length.
  double solve() {
    if (count_ == 1) {
      relax(0);
      return length();
    }
    double best = infinity;
    for (int round = 0; round < 40; ++round) {
      double moved = 0;
      for (std::size_t i = 0; i < count_; ++i) moved = std::max(moved, relax(i));
      if (moved < enough) break;
      double off = newton();
      while (off >= enough && off < near) off = newton();
      if (off < enough) break;
      const double now = length();
      if (now > best * (1 - 1e-15) && round > 4) break;
      best = now;
    }
    return length();
  }

 private:
  static constexpr std::size_t K = N - 2;
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  static constexpr double enough = 1e-12;  // how well places are known
  static constexpr double near = 1e-3;     // how far off what is off is the square of it next

  [[nodiscard]] const Point& before(std::size_t i) const { return i > 0 ? point_[i - 1] : from_; }
  [[nodiscard]] const Point& behind(std::size_t i) const {
    return i + 1 < count_ ? point_[i + 1] : to_;
  }
  [[nodiscard]] double length() const {
    double sum = distance_of(before(count_), to_);
    for (std::size_t i = 0; i < count_; ++i) sum += distance_of(before(i), point_[i]);
    return sum;
  }

  void put(std::size_t i, const Along& a) {
    along_[i] = a;
    point_[i] = face_[i]->at(a);
  }

  /// Bend i to its best place between its neighbours. How far it went.
  double relax(std::size_t i) {
    free_[i] = true;
    {
      const Face& face = *face_[i];
      const Point p = minus(before(i), face.origin), q = minus(behind(i), face.origin);
      Along ap, aq;
      for (std::size_t k = 0; k < K; ++k) {
        ap[k] = inner(p, face.tangent[k]);
        aq[k] = inner(q, face.tangent[k]);
      }
      const double op = root_of_squares(inner(p, face.into), inner(p, face.side));
      const double oq = root_of_squares(inner(q, face.into), inner(q, face.side));
      Along best;
      const double sum = op + oq;
      for (std::size_t k = 0; k < K; ++k)
        best[k] = sum > 0 ? (ap[k] * oq + aq[k] * op) / sum : along_[i][k];
      if (!domain_.holds(face, best, 0)) {
        free_[i] = false;
        best = at_rim(face, ap, op, aq, oq);
      }
      const double moved = distance_of(best, along_[i]);
      put(i, best);
      return moved;
    }
  }

  // Lengths are about 1: no care against overflow, as std::hypot takes, at ten times the cost.
  static double root_of_squares(double a, double b) { return std::sqrt(a * a + b * b); }

  /// The best place on the rims: about each one the string unfolds as about a face.
  [[nodiscard]] Along at_rim(const Face& face, const Along& ap, double op, const Along& aq,
                             double oq) const {
    Along best{};
    double least = infinity;
    for (const BendingRim<N>& rim : domain_.rims_of(face)) {
      const Along way = minus(rim.to, rim.from);
      const double length = std::sqrt(inner(way, way));
      double t = 0;
      if (length > 0) {
        const Along p = minus(ap, rim.from), q = minus(aq, rim.from);
        const double tp = inner(p, way) / length, tq = inner(q, way) / length;
        const double wp = root_of_squares(op, inner(ap, rim.outward) - rim.reach);
        const double wq = root_of_squares(oq, inner(aq, rim.outward) - rim.reach);
        t = wp + wq > 0 ? std::clamp((tp * wq + tq * wp) / (wp + wq) / length, 0., 1.) : 0;
      }
      const Along a = plus(rim.from, t, way);
      const double sum =
          root_of_squares(distance_of(ap, a), op) + root_of_squares(distance_of(a, aq), oq);
      if (sum < least) least = sum, best = a;
    }
    return best;
  }

  /// One step for the bends that are not at a rim; half of it, and so on, until it is a gain. If
  /// there are no others and all of it was taken: how far off they may still be, its square by the
  /// shortest leg. Else +inf.
  double newton() {
    {
      constexpr std::size_t size = most * K;
      std::size_t place[most], unknowns = 0;
      for (std::size_t i = 0; i < count_; ++i) {
        place[i] = unknowns;
        if (free_[i]) unknowns += K;
      }
      if (unknowns < 2) return infinity;
      double matrix[size][size], right[size];
      for (std::size_t r = 0; r < unknowns; ++r) {
        right[r] = 0;
        std::fill(matrix[r], matrix[r] + unknowns, 0.);
      }
      double shortest = infinity;
      // Leg j goes from bend j - 1 to bend j.
      for (std::size_t j = 0; j <= count_; ++j) {
        const Point &p = before(j), &q = j < count_ ? point_[j] : to_;
        const Point leg = minus(q, p);
        const double length = std::sqrt(inner(leg, leg));
        if (!(length > 1e-9)) return infinity;
        shortest = std::min(shortest, length);
        const bool ends[2] = {j > 0 && free_[j - 1], j < count_ && free_[j]};
        double part[2][K];
        for (std::size_t e = 0; e < 2; ++e)
          for (std::size_t k = 0; k < K && ends[e]; ++k) {
            const std::size_t r = place[j - 1 + e] + k;
            part[e][k] = inner(leg, face_[j - 1 + e]->tangent[k]) / length;
            right[r] += e == 0 ? part[e][k] : -part[e][k];
            matrix[r][r] += 1 / length;
            for (std::size_t l = 0; l <= k; ++l)
              matrix[r][r - k + l] -= part[e][k] * part[e][l] / length;
          }
        if (ends[0] && ends[1])
          for (std::size_t k = 0; k < K; ++k)
            for (std::size_t l = 0; l < K; ++l)
              matrix[place[j] + k][place[j - 1] + l] -=
                  (inner(face_[j]->tangent[k], face_[j - 1]->tangent[l]) -
                   part[1][k] * part[0][l]) /
                  length;
      }
      // Cholesky, in the lower triangle.
      for (std::size_t r = 0; r < unknowns; ++r)
        for (std::size_t c = 0; c <= r; ++c) {
          double sum = matrix[r][c];
          for (std::size_t k = 0; k < c; ++k) sum -= matrix[r][k] * matrix[c][k];
          if (c < r) {
            matrix[r][c] = sum / matrix[c][c];
          } else {
            if (!(sum > 1e-14)) return infinity;
            matrix[r][r] = std::sqrt(sum);
          }
        }
      for (std::size_t r = 0; r < unknowns; ++r) {
        for (std::size_t k = 0; k < r; ++k) right[r] -= matrix[r][k] * right[k];
        right[r] /= matrix[r][r];
      }
      double step2 = 0;
      for (std::size_t r = unknowns; r-- > 0;) {
        for (std::size_t k = r + 1; k < unknowns; ++k) right[r] -= matrix[k][r] * right[k];
        right[r] /= matrix[r][r];
        step2 += right[r] * right[r];
      }
      const double off = unknowns == count_ * K ? step2 / shortest : infinity;
      Along old[most];
      std::copy(along_, along_ + count_, old);
      const double before_it = length();
      for (double share = 1; share > .05; share /= 2) {
        bool whole = share == 1;
        for (std::size_t i = 0; i < count_; ++i) {
          if (!free_[i]) continue;
          Along a = old[i];
          for (std::size_t k = 0; k < K; ++k) a[k] += share * right[place[i] + k];
          const Along b = within(*face_[i], old[i], a);
          whole = whole && a == b;
          put(i, b);
        }
        if (off < enough || length() <= before_it) return whole ? off : infinity;
      }
      for (std::size_t i = 0; i < count_; ++i) put(i, old[i]);
    }
    return infinity;
  }

  /// As far from `from` to `to` as the face goes.
  [[nodiscard]] Along within(const Face& face, const Along& from, const Along& to) const {
    double share = 1;
    for (const BendingRim<N>& rim : domain_.rims_of(face)) {
      const double a = inner(rim.outward, from), b = inner(rim.outward, to);
      if (b > rim.reach && b > a) share = std::min(share, std::max(0., (rim.reach - a) / (b - a)));
    }
    return share == 1 ? to : plus(from, share, minus(to, from));
  }

  const FlatDomain<N>& domain_;
  Point from_, to_;
  const Face* face_[most];
  Along along_[most];
  Point point_[most] = {};
  bool free_[most];
  std::size_t count_ = 0;
};

}  // namespace plexway::detail::strings
