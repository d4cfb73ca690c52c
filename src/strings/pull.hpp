#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "strings/place.hpp"

/// Pulling strings taut.
namespace plexway::strings {

/// A string from one point to another along places.
struct String {
  Point from, to;
  std::vector<const Place*> places;
  std::vector<double> at;    ///< how far along each place: where a pull starts, and what it finds
  std::vector<double> wide;  ///< the same across planes; empty: there are none
  std::vector<double> slowness;  ///< of legs; empty: all have 1
  std::vector<Point> points;     ///< there
  double length = 0;             ///< each leg times its slowness
  std::size_t held = 0;  ///< so many places that a pull leaves alone: their `at` is as it should be
  double held_length = 0;

  [[nodiscard]] std::size_t bends() const { return places.size(); }
  /// The n-th corner, ends included.
  [[nodiscard]] const Point& corner(std::size_t n) const {
    return n == 0 ? from : n > bends() ? to : points[n - 1];
  }
  [[nodiscard]] double slow(std::size_t leg) const { return slowness.empty() ? 1 : slowness[leg]; }
  /// Where rows meet in a vertex and the string bends there at both, the leg from one to the other
  /// has no length: it leads along the other row. Null for any other leg.
  [[nodiscard]] std::optional<Point> row_from(std::size_t corner, std::size_t other) const {
    if (other == 0 || other > bends()) return {};
    constexpr double still = 1e-9;
    const Place& row = *places[other - 1];
    const Point leg = this->corner(other) - this->corner(corner);
    const double t = at[other - 1];
    if (!(row.low < row.high && dot(leg, leg) < still * still)) return {};
    if (t < row.low + still) return row.along;
    if (t > row.high - still) return -1. * row.along;
    return {};
  }
  /// Of a string that was pulled, the first places shall stay as they are.
  void hold(std::size_t count) {
    held = count;
    held_length = 0;
    for (std::size_t n = 0; n < count; ++n)
      held_length += slow(n) * norm(corner(n + 1) - corner(n));
  }
};

/// Makes strings as short as they can be along their places. The length is convex in where they
/// bend, and each bend knows its neighbours alone: Newton's method on a block tridiagonal system,
/// and where that goes too far, each bend for itself. Bends stay at the end of a place while the
/// string presses them outward.
class Puller {
 public:
  void pull(String& string);

 private:
  void pull_each(String& string) const;
  void pull_fans(String& string);
  [[nodiscard]] bool is_kinked(const String& string) const;
  double measure(String& string);  // points, legs, length
  bool is_at_kink(const String& string, bool start, bool& leaves) const;
  double before_kink(const String& string, bool start) const;
  template <std::size_t D>
  void pull_by(String& string);
  template <std::size_t D>
  void differentiate(const String& string);
  template <std::size_t D>
  double solve(const String& string);
  template <std::size_t D>
  bool step(String& string, double share, double least);

  bool weighted_ = false;                   // media or planes, not bends in one solid alone
  bool at_start_ = false, at_end_ = false;  // the first, the last of the places is at an end
  std::vector<Point> legs_;                 // unit vectors
  std::vector<double> lengths_;             // of legs
  std::vector<double> gradient_, diagonal_, beside_, move_, kept_, kept_wide_;
};

/// Is a bend of a taut string held at the end of its place, and would go on past it?
[[nodiscard]] bool is_held(const String& string, std::size_t n);

/// Does a string stay that has a leg without length between two places, in a medium of that
/// slowness? `in` and `out` are the slopes before and behind it: there is one of the leg's with
/// which nothing is gained along either place.
[[nodiscard]] bool is_at_rest(const Place& one, const Point& in, const Place& two, const Point& out,
                              double slow);

}  // namespace plexway::strings
