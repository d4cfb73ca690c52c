#pragma once

#include <cstddef>
#include <vector>

#include "strings/place.hpp"

/// Pulling strings taut.
namespace plexway::strings {

/// A string from one point to another along places.
struct String {
  Point from, to;
  std::vector<const Place*> places;
  std::vector<double> at;     ///< how far along each place: where a pull starts, and what it finds
  std::vector<Point> points;  ///< there
  double length = 0;
  std::size_t held = 0;  ///< so many places that a pull leaves alone: their `at` is as it should be
  double held_length = 0;

  [[nodiscard]] std::size_t bends() const { return places.size(); }
  /// The n-th corner, ends included.
  [[nodiscard]] const Point& corner(std::size_t n) const {
    return n == 0 ? from : n > bends() ? to : points[n - 1];
  }
  /// Of a string that was pulled, the first places shall stay as they are.
  void hold(std::size_t count) {
    held = count;
    held_length = 0;
    for (std::size_t n = 0; n < count; ++n) held_length += norm(corner(n + 1) - corner(n));
  }
};

/// Makes strings as short as they can be along their places. The length is convex in where they
/// bend, and each bend knows its neighbours alone: Newton's method on a tridiagonal system, and
/// where that goes too far, each bend for itself. Bends stay at the end of a place while the string
/// presses them outward.
class Puller {
 public:
  void pull(String& string);

 private:
  void pull_each(String& string) const;
  double measure(String& string);  // points, legs, length
  void differentiate(const String& string);
  double solve(const String& string);
  bool step(String& string, double least);
  void pull_fans(String& string);
  [[nodiscard]] bool is_kinked(const String& string) const;

  std::vector<Point> legs_;      // unit vectors
  std::vector<double> lengths_;  // of legs
  std::vector<double> gradient_, diagonal_, beside_, move_, kept_;
};

}  // namespace plexway::strings
