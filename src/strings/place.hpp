#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include <plexway/solid/detail/tet_record.hpp>

/// Strings, and where they bend: straight rows of edges with more than pi of solid around them, and
/// vertices.
namespace plexway::detail::strings {

using Point = Vector3<double>;

/// `a` over its length; 0 for 0.
inline Point unit(const Point& a) {
  const double length = norm(a);
  return length > 0 ? 1 / length * a : a;
}

/// A row of edges between the same two planes of the boundary, a plane between two media, or a
/// single point (low = high).
struct Place {
  Point origin, along;  ///< of points origin + t along, `along` a unit vector
  double low, high;     ///< the least and the greatest t
  Point into;           ///< into the solid, unit: halfway between the two planes
  Point floor, normal;  ///< across it: within the first plane, and square to that into the solid
  double angle;         ///< of solid around it, from the first plane to the second
  Index vertex = none;  ///< of a single point
  Index end[2] = {none, none};            ///< vertices at `low` and `high`
  Index first_wedge = 0, last_wedge = 0;  ///< where tetrahedra only touch: Boundary::wedges
  Point wide = {0, 0, 0};                 ///< of a plane: square to `along`, unit
  bool is_plane = false;                  ///< points origin + t along + u wide, all t and u

  /// Strings that come to it never lift off: a vertex, or an edge where tetrahedra only touch.
  [[nodiscard]] bool holds() const { return angle == 0; }
  [[nodiscard]] Point at(double t) const { return origin + t * along; }
  [[nodiscard]] Point at(double t, double u) const { return origin + t * along + u * wide; }
  /// Off the ends, where other faces begin.
  [[nodiscard]] Point off_ends(double t, double by) const {
    const double off = std::min(3 * by, (high - low) / 2);
    return at(std::clamp(t, low + off, high - off));
  }
  /// A little inside the solid.
  [[nodiscard]] Point beside(double t, double by) const { return off_ends(t, by) + by * into; }

  /// Where a direction leads, measured through the solid from the first plane. One that leads into
  /// the obstacle counts to the nearer plane.
  [[nodiscard]] double angle_of(const Point& direction) const {
    const double measured = std::atan2(dot(direction, normal), dot(direction, floor));
    return measured < (angle - turn) / 2 ? measured + turn : measured;
  }
  /// The same for one that was turned there from another one, by less than half a turn: two angles
  /// where that one was in the plane of a crack, on either side of it.
  [[nodiscard]] std::array<double, 2> angles_of(const Point& direction, const Point& before) const {
    constexpr double same = 1e-9;
    const double now = angle_of(direction);
    if (dot(before, before) < 1e-18) return {now, now};
    const double was = angle_of(before);
    const auto turned = [&](double from) { return now + turn * std::round((from - now) / turn); };
    const bool crack = angle > turn - same;
    return {turned(was), turned(crack && was < same          ? was + turn
                                : crack && was > turn - same ? was - turn
                                                             : was)};
  }
  /// Does a string press against the obstacle between legs that leave at these angles? A leg in
  /// the plane of a crack is on both of its sides.
  [[nodiscard]] bool presses(double a, double b) const {
    if (std::min(a, b) < -slack || std::max(a, b) > angle + slack) return true;
    const auto sides = [&](double x) {
      constexpr double same = 1e-10;
      if (angle < turn - same) return std::pair{x, x};
      return std::pair{x > angle - same ? 0 : x, x < same ? angle : x};
    };
    const auto [least_a, most_a] = sides(a);
    const auto [least_b, most_b] = sides(b);
    return std::max(most_a - least_b, most_b - least_a) >= std::numbers::pi - slack;
  }

  /// The same between the directions of legs that were turned there from others, by less than half
  /// a turn each: by signs, but in a crack.
  [[nodiscard]] bool presses(const Point& a, const Point& before_a, const Point& b,
                             const Point& before_b) const {
    if (angle > turn - 1e-3) {
      for (const double of_a : angles_of(a, before_a))
        for (const double of_b : angles_of(b, before_b))
          if (presses(of_a, of_b)) return true;
      return false;
    }
    const Across in = across(a), out = across(b);
    return leads_in(in) || leads_in(out) || are_around(in, out) ||
           (dot(before_a, before_a) > 1e-18 && are_around(across(before_a), in)) ||
           (dot(before_b, before_b) > 1e-18 && are_around(across(before_b), out));
  }

  static constexpr double turn = 2 * std::numbers::pi;

 private:
  /// A direction across the place: along the middle of the obstacle, and square to that.
  struct Across {
    double x, y;
  };
  [[nodiscard]] Across across(const Point& direction) const {
    const double cosine = dot(into, floor), sine = dot(into, normal);
    const double x = dot(direction, floor), y = dot(direction, normal);
    return {-cosine * x - sine * y, sine * x - cosine * y};
  }
  static constexpr double slack = 1e-6;  // of angles; costs its square
  [[nodiscard]] bool leads_in(const Across& d) const {
    const double depth = dot(into, normal) * d.x + dot(into, floor) * std::abs(d.y);
    return depth > 0 && depth * depth > slack * slack * (d.x * d.x + d.y * d.y);
  }
  /// Is the way between two directions through the solid half a turn or more?
  [[nodiscard]] static bool are_around(const Across& a, const Across& b) {
    if ((a.y >= 0) == (b.y >= 0)) return false;
    const Across &left = a.y >= 0 ? a : b, &right = a.y >= 0 ? b : a;
    const double sine = left.x * right.y - left.y * right.x,
                 cosine = left.x * right.x + left.y * right.y;
    if (sine <= 0) return cosine <= 0 || left.x > 0;
    return cosine < 0 && sine < -slack * cosine;
  }
};

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
