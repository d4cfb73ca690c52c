#include "strings/pull.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace plexway::detail::strings {
namespace {

constexpr double outward = 1e-7;  // of the gradient, at an end

Point off_place(const Place& place, const Point& p) {
  const Point d = p - place.origin;
  return d - dot(d, place.along) * place.along - dot(d, place.wide) * place.wide;
}

// Where between 0 and 1 a string crosses from one slowness to another, `near` off a line on one
// side and `far` on the other, `way` apart along it. The slope of its length ascends.
double crossing(double near, double far, double way, double before, double after) {
  if (before == after) return near / (near + far);
  constexpr double flat = 1e-12;
  if (near < flat * way) near = 0;
  if (far < flat * way) far = 0;
  if (near == 0 && far == 0) return before < after ? 1 : 0;
  const double n = near * near, f = far * far, w = way * way;
  if (near == 0 && before * std::sqrt(f + w) >= after * way) return 0;
  if (far == 0 && after * std::sqrt(n + w) >= before * way) return 1;
  double low = 0, high = 1, x = std::clamp(near / (near + far), .1, .9);
  constexpr int most = 60;
  for (int round = 0; round < most; ++round) {
    const double a = std::sqrt(n + x * x * w), b = std::sqrt(f + (1 - x) * (1 - x) * w);
    const double s =
        (a > 0 ? before * x * way / a : before) - (b > 0 ? after * (1 - x) * way / b : after);
    (s > 0 ? high : low) = x;
    const double bend = before * way * n / (a * a * a) + after * way * f / (b * b * b);
    double next = bend > 0 ? x - s / bend : -1;
    if (!(next > low && next < high)) next = (low + high) / 2;
    if (std::abs(next - x) < 1e-14) return next;
    x = next;
  }
  return x;
}

// Blocks of D by D, row by row.
template <std::size_t D>
using Block = std::array<double, D * D>;
Block<1> inverse(const Block<1>& m) { return {1 / std::max(m[0], 1e-12)}; }
Block<2> inverse(const Block<2>& m) {
  constexpr double least = 1e-12;
  const double a = std::max(m[0], least), share = m[1] / a,
               rest = std::max(m[3] - share * m[1], least);
  return {1 / a + share * share / rest, -share / rest, -share / rest, 1 / rest};
}

}  // namespace

// Each bend for itself, its neighbours fixed: unfold both sides of its place into a plane.
void Puller::pull_each(String& string) const {
  auto& knots = string.knots;
  for (std::size_t k = 1; k + 1 < knots.size(); ++k) {
    Knot& knot = knots[k];
    const Place& place = *knot.place;
    const Point &from = knots[k - 1].at, &to = knots[k + 1].at;
    const double near = norm(off_place(place, from)), far = norm(off_place(place, to));
    const double before = knots[k - 1].slowness, after = knot.slowness;
    if (near + far > 0 || before != after) {
      const Point a = from - place.origin, way = to - from;
      const double along = dot(way, place.along), wide = dot(way, place.wide);
      const double x = crossing(near, far, std::sqrt(along * along + wide * wide), before, after);
      knot.t = std::clamp(dot(a, place.along) + x * along, place.low, place.high);
      if (place.is_plane) knot.u = dot(a, place.wide) + x * wide;
    }
    knot.at = place.is_plane ? place.at(knot.t, knot.u) : place.at(knot.t);
  }
}

void Puller::measure(String& string) {
  auto& knots = string.knots;
  const std::size_t n = string.bends();
  legs_.resize(n + 1);
  lengths_.resize(n + 1);
  double sum = 0;
  for (std::size_t i = 0; i <= n; ++i) {
    Knot& next = knots[i + 1];
    if (i < n) {
      const Place& place = *next.place;
      next.at = place.is_plane ? place.at(next.t, next.u) : place.at(next.t);
    }
    const Point leg = next.at - knots[i].at;
    lengths_[i] = norm(leg);
    legs_[i] = lengths_[i] > 0 ? 1 / lengths_[i] * leg : Point{0, 0, 0};
    sum += knots[i].slowness * lengths_[i];
  }
  string.length = sum;
}

void Puller::keep(const String& string) {
  kept_.resize(2 * string.bends());
  for (std::size_t i = 0; i < string.bends(); ++i) {
    kept_[2 * i] = string.knots[i + 1].t;
    kept_[2 * i + 1] = string.knots[i + 1].u;
  }
}

void Puller::restore(String& string) {
  for (std::size_t i = 0; i < string.bends(); ++i) {
    string.knots[i + 1].t = kept_[2 * i];
    string.knots[i + 1].u = kept_[2 * i + 1];
  }
  measure(string);
}

template <std::size_t D>
void Puller::differentiate(const String& string) {
  constexpr double least = 1e-9;  // a leg without length has no second derivative
  const std::size_t n = string.bends();
  gradient_.resize(D * n);
  diagonal_.resize(D * D * n);
  beside_.resize(D * D * n);
  const auto axis = [&](std::size_t i, std::size_t a) -> const Point& {
    return a == 0 ? string.knots[i + 1].place->along : string.knots[i + 1].place->wide;
  };
  double bent = string.knots[0].slowness / std::max(lengths_[0], least);
  for (std::size_t i = 0; i < n; ++i) {
    const double before = string.knots[i].slowness, after = string.knots[i + 1].slowness;
    const double next = after / std::max(lengths_[i + 1], least);
    double in[D], out[D];
    for (std::size_t a = 0; a < D; ++a) {
      in[a] = dot(axis(i, a), legs_[i]);
      out[a] = dot(axis(i, a), legs_[i + 1]);
      gradient_[D * i + a] = before * in[a] - after * out[a];
    }
    for (std::size_t a = 0; a < D; ++a)
      for (std::size_t b = 0; b < D; ++b) {
        const double same = a == b ? 1 : 0;
        diagonal_[D * (D * i + a) + b] =
            (same - in[a] * in[b]) * bent + (same - out[a] * out[b]) * next;
      }
    if (i + 1 < n)
      for (std::size_t a = 0; a < D; ++a)
        for (std::size_t b = 0; b < D; ++b) {
          const Point& e = axis(i + 1, b);
          beside_[D * (D * i + a) + b] =
              -(dot(axis(i, a), e) - out[a] * dot(e, legs_[i + 1])) * next;
        }
    bent = next;
  }
}

// The move of each bend by Newton; returns the slope of the length along it.
template <std::size_t D>
double Puller::solve(const String& string) {
  const std::size_t n = string.bends();
  move_.resize(D * n);
  const auto held = [&](std::size_t i, std::size_t a) {
    const Place& p = *string.knots[i + 1].place;
    const double t = string.knots[i + 1].t;
    if (a == 1) return !p.is_plane || (i == 0 && at_start_) || (i + 1 == n && at_end_);
    if ((i == 0 && at_start_) || (i + 1 == n && at_end_)) return true;
    return p.high <= p.low || (t <= p.low && gradient_[D * i] > 0) ||
           (t >= p.high && gradient_[D * i] < 0);
  };
  for (std::size_t i = 0; i < n; ++i) {
    double* const diagonal = &diagonal_[D * D * i];
    double* const behind = i > 0 ? &beside_[D * D * (i - 1)] : nullptr;
    double* const ahead = &beside_[D * D * i];
    for (std::size_t a = 0; a < D; ++a) {
      if (!held(i, a)) {
        diagonal[D * a + a] += 1e-12;
        continue;
      }
      for (std::size_t b = 0; b < D; ++b) {
        diagonal[D * a + b] = diagonal[D * b + a] = 0;
        if (behind != nullptr) behind[D * b + a] = 0;
        if (i + 1 < n) ahead[D * a + b] = 0;
      }
      diagonal[D * a + a] = 1;
      gradient_[D * i + a] = 0;
    }
  }
  Block<D> before{};  // the inverse of what is left of the block before
  for (std::size_t i = 0; i < n; ++i) {
    Block<D> now;
    for (std::size_t a = 0; a < D * D; ++a) now[a] = diagonal_[D * D * i + a];
    for (std::size_t a = 0; a < D; ++a) move_[D * i + a] = -gradient_[D * i + a];
    if (i > 0) {
      const double* const c = &beside_[D * D * (i - 1)];
      for (std::size_t a = 0; a < D; ++a)
        for (std::size_t k = 0; k < D; ++k) {
          double share = 0;  // transposed c times the inverse
          for (std::size_t m = 0; m < D; ++m) share += c[D * m + a] * before[D * m + k];
          for (std::size_t b = 0; b < D; ++b) now[D * a + b] -= share * c[D * k + b];
          move_[D * i + a] -= share * move_[D * (i - 1) + k];
        }
    }
    before = inverse(now);
    for (std::size_t a = 0; a < D * D; ++a) diagonal_[D * D * i + a] = before[a];
  }
  double slope = 0;
  for (std::size_t i = n; i-- > 0;) {
    double right[D];
    for (std::size_t a = 0; a < D; ++a) {
      right[a] = move_[D * i + a];
      if (i + 1 < n)
        for (std::size_t b = 0; b < D; ++b)
          right[a] -= beside_[D * (D * i + a) + b] * move_[D * (i + 1) + b];
    }
    for (std::size_t a = 0; a < D; ++a) {
      double sum = 0;
      for (std::size_t b = 0; b < D; ++b) sum += diagonal_[D * (D * i + a) + b] * right[b];
      move_[D * i + a] = sum;
      slope += gradient_[D * i + a] * sum;
    }
  }
  return slope;
}

// Along the move. False if that is no shorter, and nothing is changed.
template <std::size_t D>
bool Puller::step(String& string, double share, double least) {
  const double before = string.length;
  keep(string);
  for (std::size_t i = 0; i < string.bends(); ++i) {
    Knot& knot = string.knots[i + 1];
    knot.t = std::clamp(knot.t + share * move_[D * i], knot.place->low, knot.place->high);
    if (D == 2) knot.u += share * move_[D * i + D - 1];
  }
  measure(string);
  if (string.length <= before - least) return true;
  restore(string);
  return false;
}

void Puller::pull(String& string) {
  auto& knots = string.knots;
  const std::size_t n = string.bends();
  weighted_ = false;
  bool has_planes = false;
  for (std::size_t k = 1; k <= n; ++k) {
    Knot& knot = knots[k];
    knot.t = std::clamp(knot.t, knot.place->low, knot.place->high);
    knot.at = knot.place->is_plane ? knot.place->at(knot.t, knot.u) : knot.place->at(knot.t);
    has_planes = has_planes || knot.place->is_plane;
    weighted_ = weighted_ || knot.slowness != knots[k - 1].slowness;
  }
  weighted_ = weighted_ || has_planes;
  if (n > 0 && !weighted_ && pull_strips(string)) return measure(string);
  if (n == 1) pull_each(string);
  measure(string);
  if (n < 2) return;
  if (has_planes)
    pull_by<2>(string);
  else
    pull_by<1>(string);
}

// Strips one after another, their neighbours fixed. Is one all of the string, which is as short as
// it can be then?
bool Puller::pull_strips(String& string) {
  const std::size_t end = string.knots.size() - 1;
  std::size_t k = 1, first = 0;
  while (k < end) {
    k = strip_.pull(string, k);
    if (first == 0) first = k;
  }
  return first == end;
}

// Are bends so near to each other that Newton's method does not see what is beyond?
bool Puller::is_kinked(const String& string) const {
  for (std::size_t i = 1; i < string.bends(); ++i)
    if (lengths_[i] < 1e-5) return true;
  return false;
}

// A leg that lies in the place at its free end has a kink where it has no length. Is the string
// held there, and would it rather leave?
bool Puller::is_at_kink(const String& string, bool start, bool& leaves) const {
  constexpr double none = 1e-11;
  const std::size_t n = string.bends(), leg = start ? 0 : n, next = start ? 1 : n - 1;
  if (lengths_[leg] > none) return false;
  const Place& place = *string.knots[start ? 1 : n].place;
  const double pulls = string.knots[next].slowness *
                       std::hypot(dot(legs_[next], place.along), dot(legs_[next], place.wide));
  if (pulls <= string.knots[leg].slowness) return true;
  leaves = true;
  return false;
}

// The share of a move at which a leg to the free end of which is in its place passes its kink.
double Puller::before_kink(const String& string, bool start) const {
  const std::size_t n = string.bends(), i = start ? 0 : n - 1, d = move_.size() / n;
  const Place& place = *string.knots[i + 1].place;
  const Point move = move_[d * i] * place.along + (d > 1 ? move_[d * i + 1] : 0) * place.wide;
  const Point& end = string.at(start ? 0 : n + 1);
  const Point leg = string.at(i + 1) - end;
  const double toward = -dot(leg, move), square = dot(move, move);
  constexpr double flat = 1e-12;
  if (toward <= 0 || norm(off_place(place, end)) > flat) return 1;
  return std::min(1., toward / square);
}

template <std::size_t D>
void Puller::pull_by(String& string) {
  // Newton's error is squared by each step, and the length's is the square of that of the bends:
  // once a step makes this share of a difference, it is the last.
  constexpr double last = 1e-9;
  constexpr double rounding = 1e-15;
  const int most = weighted_ ? 60 : 24;
  const double shortest = weighted_ ? 1e-5 : 1;
  at_start_ = at_end_ = false;
  int stalled = 0;
  for (int round = 0; round < most; ++round) {
    double share = 1;
    if (weighted_) {
      bool leaves = false;
      at_start_ = is_at_kink(string, true, leaves);
      at_end_ = is_at_kink(string, false, leaves);
      if (leaves) {
        pull_each(string);
        measure(string);
      }
    }
    differentiate<D>(string);
    const double slope = solve<D>(string);
    const bool ends = -slope < last * string.length;
    if (weighted_) share = std::min(before_kink(string, true), before_kink(string, false));
    const bool kinked = share < 1;
    const double least = shortest * share;
    bool shorter = false;
    for (; !shorter && share > 0 && share >= least; share /= 3) {
      shorter = step<D>(string, share, ends ? -rounding * string.length : -1e-4 * share * slope);
      if (ends) break;
    }
    if (shorter && !kinked) {
      if (!ends) continue;
      if (weighted_ || !is_kinked(string)) return;
    }
    // Too far, or over a vertex where rows meet.
    const double before = string.length;
    keep(string);
    if (weighted_)
      pull_each(string);
    else
      pull_strips(string);
    measure(string);
    if (!weighted_ && string.length > before) restore(string);
    // Two bends that meet are for who made the string to part or to join.
    if (weighted_) {
      constexpr double together = 1e-6;
      for (std::size_t i = 1; i < string.bends(); ++i)
        if (lengths_[i] < together) return;
    }
    if (shorter && weighted_) continue;
    if (!(string.length < before * (1 - 10 * rounding))) return;
    // Each for itself gets on slowly, as where bends gather at a corner.
    constexpr double slow = 1e-6;
    if (weighted_ && !(string.length < before * (1 - slow)) && ++stalled > 2) return;
  }
}

bool is_held(const String& string, std::size_t knot) {
  const Knot& k = string.knots[knot];
  const Place& p = *k.place;
  if (p.is_plane) return false;
  if (p.high <= p.low) return true;
  const bool low = k.t <= p.low, high = k.t >= p.high;
  if (!low && !high) return false;
  const double slope = string.knots[knot - 1].slowness * dot(p.along, string.direction(knot - 1)) -
                       k.slowness * dot(p.along, string.direction(knot));
  return low ? slope > outward : slope < -outward;
}

bool is_at_rest(const Place& one, const Point& in, const Place& two, const Point& out,
                double slow) {
  // The least vector that has the parts of `in` along one place and of `out` along the other.
  std::array<Point, 3> axis;
  std::size_t count = 0;
  Point least = {0, 0, 0};
  for (const auto& [along, slope] : {std::pair(one.along, in), std::pair(one.wide, in),
                                     std::pair(two.along, out), std::pair(two.wide, out)}) {
    Point a = along;
    for (std::size_t i = 0; i < count; ++i) a = a - dot(a, axis[i]) * axis[i];
    const double size = norm(a), part = dot(along, slope - least);
    if (size < 1e-6) {
      if (std::abs(part) > 1e-5 * slow) return false;
      continue;
    }
    axis[count] = 1 / size * a;
    least = least + part / size * axis[count++];
  }
  return dot(least, least) <= slow * slow * (1 + 1e-6);
}

}  // namespace plexway::detail::strings
