#pragma once

#include <cmath>
#include <cstddef>
#include <cstdio>
#include <limits>
#include <string>

#include <plexway/error.hpp>

namespace plexway::detail {

/// The distance of what cannot be reached.
inline constexpr double infinity = std::numeric_limits<double>::infinity();

/// What a Real can hold of a domain whose lengths are stored in units of their mean: asked where
/// the records are made, and where distances are. Each throws PrecisionError with the place. Ratios
/// within these ranges are harmless however large: arithmetic is relative to what is near.
template <class Real>
class NumberRange {
  static constexpr bool single = sizeof(Real) < sizeof(double);

 public:
  /// Distances, in the caller's unit, may be a million mean edges or a millionth of one. A domain
  /// knows its unit in double and can be without; a field of it cannot.
  static void check_unit(double unit) {
    constexpr double most_edges = single ? 1e6 : 1;
    constexpr double least =
        single ? std::numeric_limits<Real>::min() : std::numeric_limits<Real>::denorm_min();
    if (unit * most_edges <= double{std::numeric_limits<Real>::max()} && unit / most_edges >= least)
      return;
    refuse("edges of " + text(unit) + " are", "scale the input");
  }

  /// The longest edge of a simplex, in units. Where it is tiny, products of four lengths vanish.
  static void check_simplex(const char* simplex, std::size_t number, double longest) {
    static const double least = 8 * std::sqrt(std::sqrt(double{std::numeric_limits<Real>::min()}));
    if (longest == 0 || longest >= least) return;
    if (longest < 1e-30)  // no simplex is meant to be so small beside the others
      throw PrecisionError(named(simplex, number) + "its longest edge is " + text(longest) +
                           " of the mean: look for a vertex far off");
    refuse(named(simplex, number) + "its longest edge, " + text(longest) + " of the mean, is",
           "scale it up or leave it out");
  }

  /// An edge that is only ever added up, in units.
  static void check_edge(std::size_t number, double length) {
    if (length == 0 || length >= double{std::numeric_limits<Real>::min()}) return;
    refuse(named("edge", number) + "its length, " + text(length) + " of the mean, is",
           "scale it up or leave it out");
  }

  /// The least of the longest edge of a simplex kept by coordinates, beside their extent.
  static constexpr double least_of_extent = 256 * double{std::numeric_limits<Real>::epsilon()};

  /// The longest edge of a simplex kept by coordinates, and how far these reach from the middle.
  static void check_coordinates(const char* simplex, std::size_t number, double longest,
                                double extent) {
    if (longest == 0 || longest >= least_of_extent * extent) return;
    refuse(named(simplex, number) + "its longest edge, " + text(longest / extent) +
               " of the extent of all, is",
           "look for a vertex far off");
  }

  /// Two triangles measure the edge between them as `a` and `b`; `aspect` is the ratio of the
  /// longest to the shortest edge of the more slender one. A triangle that is slower or faster all
  /// over is held nearly as far as numbers go. One that is so in one direction is a needle in its
  /// own metric, and Fermat's point then a matter of differences of squares.
  static void check_refraction(std::size_t face, std::size_t other, double a, double b,
                               double aspect) {
    constexpr double epsilon = double{std::numeric_limits<Real>::epsilon()};
    static const double most = std::pow(epsilon, -0.75), most_slender = std::sqrt(most);
    const double ratio = std::fmax(a, b) / std::fmin(a, b);
    if (ratio <= most && std::fmin(ratio, aspect) <= most_slender) return;
    refuse("faces " + std::to_string(face) + " and " + std::to_string(other) +
               " measure the edge between them as " + text(a) + " and " + text(b) +
               ": lengths so different are",
           "keep them within 1 : " + text(ratio > most ? most : most_slender));
  }

 private:
  [[noreturn]] static void refuse(const std::string& what, const std::string& hint) {
    throw PrecisionError(what + " beyond " + (single ? "single" : "double") +
                         " precision: " + (single ? "use double" : hint));
  }
  static std::string named(const char* simplex, std::size_t number) {
    return std::string(simplex) + " " + std::to_string(number) + ": ";
  }
  static std::string text(double value) {
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%.3g", value);
    return buffer;
  }
};

}  // namespace plexway::detail
