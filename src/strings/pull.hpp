#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "strings/place.hpp"

/// Pulling strings taut.
namespace plexway::strings {

/// A leg of a string on its way to a new end, from where it was free.
struct Leg {
  Point from, to;      ///< a little inside the solid
  bool known = false;  ///< it was seen to be free there
};

/// Where a string bends, or ends.
struct Knot {
  Point at;
  const Place* place = nullptr;  ///< null at the ends
  double t = 0, u = 0;           ///< how far along the place: where a pull starts, what it finds
  double slowness = 1;           ///< of the leg behind it
  // Of who pulls it, not of the puller:
  Index door = none, medium = 0;  ///< its place, and the medium of the leg behind it
  Index chain = none;             ///< up to there
  double before = 0;              ///< the length up to there
  Leg leg = {};                   ///< behind it
};

/// A string from one point to another along places.
struct String {
  std::vector<Knot> knots;  ///< both ends included
  double before = 0;        ///< how long it is up to the first of them
  double length = 0;        ///< each leg times its slowness

  /// The knots from 1 to this are bends.
  [[nodiscard]] std::size_t bends() const { return knots.size() - 2; }
  [[nodiscard]] const Point& at(std::size_t knot) const { return knots[knot].at; }
  /// Of the leg behind a knot, unit.
  [[nodiscard]] Point direction(std::size_t leg) const { return unit(at(leg + 1) - at(leg)); }
  /// Where rows meet in a vertex and the string bends there at both, the leg from one to the other
  /// has no length: it leads along the other row. Null for any other leg.
  [[nodiscard]] std::optional<Point> row_from(std::size_t knot, std::size_t other) const {
    if (knots[other].place == nullptr) return {};
    constexpr double still = 1e-9;
    const Place& row = *knots[other].place;
    const Point leg = at(other) - at(knot);
    if (!(row.low < row.high && dot(leg, leg) < still * still)) return {};
    const double t = knots[other].t;
    if (t < row.low + still) return row.along;
    if (t > row.high - still) return -1. * row.along;
    return {};
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
  void measure(String& string);  // points, legs, length
  void keep(const String& string);
  void restore(String& string);
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
  std::vector<double> gradient_, diagonal_, beside_, move_, kept_;  // of bends, from 0 on
};

/// Is a bend of a taut string held at the end of its place, and would go on past it?
[[nodiscard]] bool is_held(const String& string, std::size_t knot);

/// Of a string that is pulled on from a bend which stays where it was: how much shorter it may be
/// at most if that were pulled as well. Its length is convex, so no more than its slope there times
/// how far the bend can move. `in` is the direction of the leg that comes there, `slowness` that
/// leg's.
[[nodiscard]] double most_gain(const String& string, const Point& in, double slowness);

/// Does a string stay that has a leg without length between two places, in a medium of that
/// slowness? `in` and `out` are the slopes before and behind it: there is one of the leg's with
/// which nothing is gained along either place.
[[nodiscard]] bool is_at_rest(const Place& one, const Point& in, const Place& two, const Point& out,
                              double slow);

}  // namespace plexway::strings
