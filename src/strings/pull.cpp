#include "strings/pull.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace plexway::strings {
namespace {

constexpr double outward = 1e-7;  // of the gradient, at an end

Point across(const Place& place, const Point& p) {
  const Point d = p - place.origin;
  return d - dot(d, place.along) * place.along;
}

}  // namespace

// One bend, the last: unfold both sides of the line into a plane.
void Puller::pull_one(String& string) const {
  const Place& place = *string.places.back();
  const Point& from = string.corner(string.bends() - 1);
  const double a = dot(from - place.origin, place.along),
               b = dot(string.to - place.origin, place.along),
               near = norm(across(place, from)), far = norm(across(place, string.to));
  const double t = near + far > 0 ? a + (b - a) * near / (near + far) : a;
  string.at.back() = std::clamp(t, place.low, place.high);
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

// Along the move, as far as the string gets shorter. False if it does not.
bool Puller::step(String& string, double slope, bool ends) {
  kept_ = string.at;
  double share = 1;
  for (int tries = 0; tries < 12; ++tries, share /= 4) {
    for (std::size_t i = string.held; i < kept_.size(); ++i)
      string.at[i] = std::clamp(kept_[i] + share * move_[i], string.places[i]->low,
                                string.places[i]->high);
    const double length = measure(string);
    if (length <= string.length + 1e-4 * share * slope ||
        (ends && length <= string.length * (1 + 1e-15))) {
      string.length = length;
      return true;
    }
    if (ends) break;
  }
  string.at = kept_;
  string.length = measure(string);
  return false;
}

void Puller::pull(String& string) {
  // Newton's error is squared by each step, and the length's is the square of that of the bends:
  // once a step makes this share of a difference, it is the last.
  constexpr double last = 1e-9;
  const std::size_t n = string.bends();
  for (std::size_t i = string.held; i < n; ++i)
    string.at[i] = std::clamp(string.at[i], string.places[i]->low, string.places[i]->high);
  if (n == string.held + 1) pull_one(string);
  string.length = measure(string);
  if (n < string.held + 2) return;
  for (int round = 0; round < 40; ++round) {
    differentiate(string);
    const double slope = solve(string);
    const bool ends = -slope < last * string.length;
    if (!step(string, slope, ends) || ends) return;
  }
}

bool is_held(const String& string, std::size_t n) {
  const Place& p = *string.places[n];
  if (p.high <= p.low) return true;
  const bool low = string.at[n] <= p.low, high = string.at[n] >= p.high;
  if (!low && !high) return false;
  const double slope = dot(p.along, unit(string.corner(n + 1) - string.corner(n))) -
                       dot(p.along, unit(string.corner(n + 2) - string.corner(n + 1)));
  return low ? slope > outward : slope < -outward;
}

}  // namespace plexway::strings
