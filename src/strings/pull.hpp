#pragma once

#include <cstddef>
#include <vector>

#include "strings/place.hpp"

/// Pulling strings taut.
namespace plexway::detail::strings {

/// Rows of edges one after another, each of which shares a vertex with the next: unfolded into a
/// plane, the shortest way across them is a straight line, or turns at vertices. It is found as Lee
/// and Preparata do (Euclidean shortest paths in the presence of rectilinear barriers, 1984). Cost:
/// linear unless it turns at many vertices.
class Strip {
 public:
  /// Bends the string at the rows from a knot on until two share no vertex, where these and the
  /// knots before and behind stay; returns the knot behind.
  std::size_t pull(String& string, std::size_t first);

 private:
  struct Flat {
    double x, y;
    friend bool operator==(const Flat&, const Flat&) = default;
    friend Flat operator+(const Flat& a, const Flat& b) { return {a.x + b.x, a.y + b.y}; }
    friend Flat operator-(const Flat& a, const Flat& b) { return {a.x - b.x, a.y - b.y}; }
    friend Flat operator*(double s, const Flat& a) { return {s * a.x, s * a.y}; }
    friend double cross(const Flat& a, const Flat& b) { return a.x * b.y - a.y * b.x; }
  };
  /// A row, crossed upward.
  struct Portal {
    Flat left, right;
    bool rises;  ///< from left to right, as the row is measured
  };
  void unfold(const Place& row, const Place& next);
  std::size_t turn(Flat& from, std::size_t first, const Flat& end, Flat& to) const;
  static double share(const Portal& portal, const Flat& from, const Flat& to);

  std::vector<Portal> portals_;
};

/// Makes strings as short as they can be along their places. The length is convex in where they
/// bend, and each bend knows its neighbours alone: Newton's method on a block tridiagonal system,
/// and where that goes too far, each strip of rows for itself. Bends stay at the end of a place
/// while the string presses them outward.
class Puller {
 public:
  void pull(String& string);

 private:
  void pull_each(String& string) const;
  bool pull_strips(String& string);
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

  Strip strip_;
  bool weighted_ = false;                   // media or planes, not bends in one solid alone
  bool at_start_ = false, at_end_ = false;  // the first, the last of the places is at an end
  std::vector<Point> legs_;                 // unit vectors
  std::vector<double> lengths_;             // of legs
  std::vector<double> gradient_, diagonal_, beside_, move_, kept_;  // of bends, from 0 on
};

/// Is a bend of a taut string held at the end of its place, and would go on past it?
[[nodiscard]] bool is_held(const String& string, std::size_t knot);

/// Does a string stay that has a leg without length between two places, in a medium of that
/// slowness? `in` and `out` are the slopes before and behind it: there is one of the leg's with
/// which nothing is gained along either place.
[[nodiscard]] bool is_at_rest(const Place& one, const Point& in, const Place& two, const Point& out,
                              double slow);

}  // namespace plexway::detail::strings
