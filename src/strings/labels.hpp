#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <vector>

#include <plexway/complex/ids.hpp>

#include "strings/place.hpp"

/// What vertices know of the strings that reach them.
namespace plexway::strings {

/// A string to a vertex.
struct Label {
  double distance = std::numeric_limits<double>::infinity();
  Index chain = none;
  Point last = {0, 0, 0};  ///< its last leg's direction, unit: the field's gradient
};

/// A vertex keeps the two shortest strings: where the second is not much longer and comes from
/// another side, it may be the shortest of a neighbour.
struct VertexLabels {
  static constexpr std::size_t remembered = 6;
  Label best, second;
  std::array<Index, remembered> tried;  ///< chains of late
  Index next = 0;

  VertexLabels() { tried.fill(none); }
  [[nodiscard]] bool knows(Index chain) const {
    if (best.chain == chain || second.chain == chain) return true;
    for (const Index t : tried)
      if (t == chain) return true;
    return false;
  }
  void remember(Index chain) {
    tried[next] = chain;
    next = (next + 1) % remembered;
  }
  /// Strings as long as this are of no use, whatever direction they come from.
  [[nodiscard]] double limit(double behind) const {
    return std::min(best.distance + behind, second.distance);
  }
  /// The same for one from this direction.
  [[nodiscard]] double limit(double behind, const Point& last) const {
    return differ(best.last, last) ? limit(behind) : best.distance;
  }
  /// Takes a string; false if it is of no use.
  bool take(const Label& label, double behind) {
    if (label.distance < best.distance) {
      if (best.chain != label.chain && best.distance < label.distance + behind &&
          differ(best.last, label.last))
        second = best;
      else if (second.chain == label.chain || !differ(second.last, label.last) ||
               !(second.distance < label.distance + behind))
        second = {};
      best = label;
      return true;
    }
    if (label.chain == best.chain || !(label.distance < limit(behind, label.last))) return false;
    second = label;
    return true;
  }

 private:
  static bool differ(const Point& a, const Point& b) {
    constexpr double alike = .99;  // cosine
    return dot(a, b) < alike;
  }
};

}  // namespace plexway::strings
