#include "strings/pull.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace plexway::strings {
namespace {

Point across(const Place& place, const Point& p) {
  const Point d = p - place.origin;
  return d - dot(d, place.along) * place.along;
}

}  // namespace

// Each bend for itself, its neighbours fixed: unfold both sides of its line into a plane.
void Puller::pull_each(String& string) const {
  for (std::size_t i = string.held; i < string.bends(); ++i) {
    const Place& place = *string.places[i];
    const Point &from = string.corner(i), &to = string.corner(i + 2);
    const double a = dot(from - place.origin, place.along), b = dot(to - place.origin, place.along),
                 near = norm(across(place, from)), far = norm(across(place, to));
    if (near + far > 0)
      string.at[i] = std::clamp(a + (b - a) * near / (near + far), place.low, place.high);
    string.points[i] = place.at(string.at[i]);
  }
}

double Puller::measure(String& string) {
  const std::size_t n = string.bends();
  legs_.resize(n + 1);
  lengths_.resize(n + 1);
  string.points.resize(n);
  double sum = string.held_length;
  Point last = string.corner(string.held);
  for (std::size_t i = string.held; i <= n; ++i) {
    if (i < n) string.points[i] = string.places[i]->at(string.at[i]);
    const Point& next = i < n ? string.points[i] : string.to;
    const Point leg = next - last;
    lengths_[i] = norm(leg);
    legs_[i] = lengths_[i] > 0 ? 1 / lengths_[i] * leg : Point{0, 0, 0};
    sum += lengths_[i];
    last = next;
  }
  return sum;
}

void Puller::differentiate(const String& string) {
  constexpr double least = 1e-9;  // a leg without length has no second derivative
  const std::size_t n = string.bends();
  gradient_.resize(n);
  diagonal_.resize(n);
  beside_.resize(n);
  for (std::size_t i = string.held; i < n; ++i) {
    const Point& d = string.places[i]->along;
    const double in = dot(d, legs_[i]), out = dot(d, legs_[i + 1]);
    gradient_[i] = in - out;
    diagonal_[i] = (1 - in * in) / std::max(lengths_[i], least) +
                   (1 - out * out) / std::max(lengths_[i + 1], least);
    if (i + 1 == n) continue;
    const Point& e = string.places[i + 1]->along;
    beside_[i] = -(dot(d, e) - out * dot(e, legs_[i + 1])) / std::max(lengths_[i + 1], least);
  }
}

// The move of each bend by Newton; returns the slope of the length along it.
double Puller::solve(const String& string) {
  const std::size_t n = string.bends();
  move_.resize(n);
  const auto held = [&](std::size_t i) {
    const Place& p = *string.places[i];
    return p.high <= p.low || (string.at[i] <= p.low && gradient_[i] > 0) ||
           (string.at[i] >= p.high && gradient_[i] < 0);
  };
  bool last_held = true;
  const std::size_t first = string.held;
  for (std::size_t i = first; i < n; ++i) {
    const bool now = held(i);
    if (now) {
      diagonal_[i] = 1;
      gradient_[i] = 0;
    } else {
      diagonal_[i] += 1e-12;
    }
    if (i > first && (now || last_held)) beside_[i - 1] = 0;
    last_held = now;
    move_[i] = -gradient_[i];
    if (i == first || beside_[i - 1] == 0) continue;
    const double share = beside_[i - 1] / diagonal_[i - 1];
    diagonal_[i] = std::max(diagonal_[i] - share * beside_[i - 1], 1e-12);
    move_[i] -= share * move_[i - 1];
  }
  double slope = 0;
  for (std::size_t i = n; i-- > first;) {
    if (i + 1 < n) move_[i] -= beside_[i] * move_[i + 1];
    move_[i] /= diagonal_[i];
    slope += gradient_[i] * move_[i];
  }
  return slope;
}

// Along the move. False if that is no shorter, and nothing is changed.
bool Puller::step(String& string, double least) {
  kept_ = string.at;
  for (std::size_t i = string.held; i < kept_.size(); ++i)
    string.at[i] = std::clamp(kept_[i] + move_[i], string.places[i]->low, string.places[i]->high);
  const double length = measure(string);
  if (length <= string.length - least) {
    string.length = length;
    return true;
  }
  string.at = kept_;
  measure(string);
  return false;
}

// Rows that meet in a vertex, their neighbours fixed: unfolded about them, straight across, or
// where that turns pi or more all bends to the vertex. None of them gets there by itself.
void Puller::pull_fans(String& string) {
  constexpr double straight = std::numbers::pi - 1e-6;
  const auto angle = [](const Point& p, const Point& q) {
    return std::atan2(norm(cross(p, q)), dot(p, q));
  };
  const auto has = [&](std::size_t i, Index v) {
    const Place& p = *string.places[i];
    return p.end[0] == v || p.end[1] == v;
  };
  for (std::size_t i = string.held, end; i + 1 < string.bends(); i = end - 1) {
    end = i + 2;
    const Place& first = *string.places[i];
    const bool low = has(i + 1, first.end[0]);
    const Index v = first.end[low ? 0 : 1];
    if (v == none || string.places[i + 1] == &first || (!low && !has(i + 1, v))) continue;
    while (end < string.bends() && has(end, v)) ++end;
    const Point at = first.at(low ? first.low : first.high);
    const auto along = [&](std::size_t n) {
      const Place& p = *string.places[n];
      return p.end[0] == v ? p.along : -1. * p.along;
    };
    const Point in = string.corner(i) - at, out = string.corner(end + 1) - at;
    double turned = angle(in, along(i));
    move_[i] = turned;
    for (std::size_t n = i + 1; n < end; ++n) move_[n] = turned += angle(along(n - 1), along(n));
    turned += angle(along(end - 1), out);
    const double before = norm(in), behind = norm(out);
    for (std::size_t n = i; n < end; ++n) {
      const Place& p = *string.places[n];
      const double reach =
          turned < straight
              ? before * behind * std::sin(turned) /
                    (before * std::sin(move_[n]) + behind * std::sin(turned - move_[n]))
              : 0;
      string.at[n] =
          p.end[0] == v ? std::min(p.low + reach, p.high) : std::max(p.high - reach, p.low);
      string.points[n] = p.at(string.at[n]);
    }
  }
}

// Are bends so near to each other that Newton's method does not see what is beyond?
bool Puller::is_kinked(const String& string) const {
  for (std::size_t i = string.held + 1; i < string.bends(); ++i)
    if (lengths_[i] < 1e-5) return true;
  return false;
}

void Puller::pull(String& string) {
  // Newton's error is squared by each step, and the length's is the square of that of the bends:
  // once a step makes this share of a difference, it is the last.
  constexpr double last = 1e-9;
  constexpr double rounding = 1e-15;
  constexpr int most = 24;
  const std::size_t n = string.bends();
  for (std::size_t i = string.held; i < n; ++i)
    string.at[i] = std::clamp(string.at[i], string.places[i]->low, string.places[i]->high);
  string.length = measure(string);
  if (n == string.held) return;
  if (n == string.held + 1) {
    pull_each(string);
    string.length = measure(string);
    return;
  }
  for (int round = 0; round < most; ++round) {
    differentiate(string);
    const double slope = solve(string);
    const bool ends = -slope < last * string.length;
    if (step(string, ends ? -rounding * string.length : -1e-4 * slope)) {
      if (!ends) continue;
      if (!is_kinked(string)) return;
    }
    // Too far, or over a corner where rows of edges meet.
    const double before = string.length;
    kept_ = string.at;
    pull_fans(string);
    string.length = measure(string);
    if (string.length < before * (1 - 10 * rounding)) continue;
    string.at = kept_;
    measure(string);
    pull_each(string);
    string.length = measure(string);
    if (!(string.length < before * (1 - 10 * rounding))) return;
  }
}

}  // namespace plexway::strings
