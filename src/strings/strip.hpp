#pragma once

#include <cstddef>
#include <vector>

#include "strings/string.hpp"

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

}  // namespace plexway::detail::strings
