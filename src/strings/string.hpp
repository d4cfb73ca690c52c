#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "strings/place.hpp"

namespace plexway::detail::strings {

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
  Leg leg = {};                   ///< behind it
};

/// A string from one point to another along places.
struct String {
  std::vector<Knot> knots;  ///< both ends included
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

}  // namespace plexway::detail::strings
