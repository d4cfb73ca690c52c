#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <plexway/common/detail/storage.hpp>
#include <plexway/common/ids.hpp>

namespace plexway::detail {

/// An angle by its cosine and sine.
struct Turn {
  double c = 1, s = 0;
};

/// Keeps c^2 + s^2 = 1 where it nearly is.
[[nodiscard]] inline Turn normalised(Turn t) {
  const double rest = (3 - (t.c * t.c + t.s * t.s)) / 2;
  return {t.c * rest, t.s * rest};
}
[[nodiscard]] inline Turn sum(Turn a, Turn b) {
  return normalised({a.c * b.c - a.s * b.s, a.s * b.c + a.c * b.s});
}
[[nodiscard]] inline Turn difference(Turn a, Turn b) {
  return normalised({a.c * b.c + a.s * b.s, a.s * b.c - a.c * b.s});
}
/// From 0 to pi: what rounding put beyond goes back.
[[nodiscard]] inline Turn clamped(Turn t) { return t.s >= 0 ? t : Turn{t.c < 0 ? -1.0 : 1.0, 0.0}; }
/// pi minus an angle.
[[nodiscard]] inline Turn supplement(Turn t) { return {-t.c, t.s}; }
[[nodiscard]] inline Turn half(Turn t) {
  return normalised({std::sqrt(std::fmax(1 + t.c, 0) / 2), std::sqrt(std::fmax(1 - t.c, 0) / 2)});
}

/// A point of a plane.
struct Planar {
  double x = 0, y = 0;
};
[[nodiscard]] inline Planar operator+(Planar a, Planar b) { return {a.x + b.x, a.y + b.y}; }
[[nodiscard]] inline Planar operator-(Planar a, Planar b) { return {a.x - b.x, a.y - b.y}; }
[[nodiscard]] inline Planar operator*(double s, Planar a) { return {s * a.x, s * a.y}; }
[[nodiscard]] inline double dot(Planar a, Planar b) { return a.x * b.x + a.y * b.y; }
[[nodiscard]] inline double cross(Planar a, Planar b) { return a.x * b.y - a.y * b.x; }
[[nodiscard]] inline double norm(Planar a) { return std::hypot(a.x, a.y); }

/// The angle from a to b, in [0, pi] up to rounding; no angle where one has no length.
[[nodiscard]] inline Turn turn_between(Planar a, Planar b) {
  const double c = dot(a, b), s = cross(a, b), n = std::hypot(c, s);
  return n > 0 ? Turn{c / n, s / n} : Turn{};
}

/// Barycentric coordinates, not clamped. Measured off the longest edge, so that the point they make
/// is the one given up to rounding even where the triangle has hardly any height: then only the
/// height is in doubt.
[[nodiscard]] inline std::array<double, 3> barycentric(const std::array<Planar, 3>& corner,
                                                       Planar p) {
  std::size_t base = 0;
  double longest = -1;
  for (std::size_t i = 0; i < 3; ++i)
    if (const double l = norm(corner[(i + 1) % 3] - corner[i]); l > longest) longest = l, base = i;
  const std::size_t end = (base + 1) % 3, apex = (base + 2) % 3;
  std::array<double, 3> b{};
  b[base] = 1;
  if (!(longest > 0)) return b;
  const Planar e = 1 / longest * (corner[end] - corner[base]);
  const Planar to_p = p - corner[base], to_apex = corner[apex] - corner[base];
  const double height = cross(e, to_apex);
  b[apex] = height > 0 ? cross(e, to_p) / height : 0;
  b[end] = (dot(e, to_p) - b[apex] * dot(e, to_apex)) / longest;
  b[base] = 1 - b[apex] - b[end];
  return b;
}

/// The same, of a point that is in the triangle but for rounding: >= 0, sum 1.
[[nodiscard]] inline std::array<double, 3> clamped(std::array<double, 3> b) {
  double total = 0;
  for (double& x : b) total += x = std::fmax(x, 0);
  if (total != 1)
    for (double& x : b) x /= total;
  return b;
}

/// A point of a triangle in a slot.
struct SlotPoint {
  Index slot = none;
  std::array<double, 3> at = {0, 0, 0};  ///< barycentric
};

/// Which of a triangle's corners stand where in a patch: corner (first +- k) mod 3 is the patch's
/// k-th, minus where the triangle is turned over.
struct CornerOrder {
  std::uint8_t first = 0;
  std::uint8_t mirrored = 0;  ///< or 1
  [[nodiscard]] std::size_t operator()(std::size_t k) const {
    return (mirrored ? first + 3u - k : first + k) % 3;
  }
};

/// Remembers every change of a triangulation, so that points find their way from the first to the
/// last and back.
///
/// A change is a planar *patch*, a few triangles before and a few after it over the same points; a
/// slot's patches are a list in both directions. A point goes through the patches of the slots it
/// is in, each one look at which triangle of the patch it falls into: the directed graph by which
/// Guibas, Knuth and Sharir (Randomized incremental construction of Delaunay and Voronoi diagrams,
/// 1992) locate points. Nothing is traced across triangles, so nothing can miss: signposts (Sharp,
/// Soliman, Crane: Navigating intrinsic triangulations, 2019) accumulate angles along a path, and
/// normal coordinates (Gillespie, Sharp, Crane: Integer coordinates for intrinsic geometry
/// processing, 2021) are there to make that robust. Here each step is off by a rounding error of
/// the patch at most, thin triangles included.
class PatchHistory {
 public:
  /// What a patch's triangles are over its points a, b, c, d or p. a is the origin, b on the x
  /// axis.
  enum class Kind : std::uint8_t {
    flip,         ///< abc, bad become adc, bcd
    split,        ///< abc becomes abp, bcp, cap
    split_border  ///< abc becomes apc, pbc
  };
  /// A patch as it is told.
  struct Change {
    Kind kind = Kind::flip;
    std::array<Index, 2> slot = {none, none};  ///< of the triangles after, in order; a split's
                                               ///< third is the one behind its second
    double length = 0;                         ///< from a to b
    Planar c, other;                           ///< `other`: d of a flip, else p
    std::array<CornerOrder, 2> order;  ///< of the triangles before; after they are as listed
  };

  explicit PatchHistory(std::size_t slots = 0) : last_(std::vector<Index>(slots, none)) {}

  /// Slots beyond those known are new.
  void add(const Change& change);

  /// Gives back what was room for more. Cost: linear.
  void trim() { patches_.own().shrink_to_fit(); }

  /// From the first triangulation to the last.
  [[nodiscard]] SlotPoint forward(SlotPoint point) const;
  /// And back.
  [[nodiscard]] SlotPoint back(SlotPoint point) const;

  /// A straight line in a triangle of the last triangulation, from `from` to `to`, in pieces that
  /// each lie in one triangle of the first.
  struct Piece {
    Index slot;
    std::array<double, 3> from, to;
  };
  void back(const Piece& line, std::vector<Piece>& pieces) const;

  [[nodiscard]] std::size_t size() const { return patches_.size(); }
  /// Slots of the last triangulation.
  [[nodiscard]] std::size_t slots() const { return last_.size(); }
  /// For one that comes from a file: do all ways through it stay within it, and end? `first_slots`:
  /// of the first triangulation.
  [[nodiscard]] bool sound(std::size_t first_slots) const;
  /// Has anything happened to a slot of the first triangulation?
  [[nodiscard]] bool changed(Index slot) const { return last_[slot] != none; }
  [[nodiscard]] std::size_t bytes() const {
    return patches_.capacity() * sizeof(Patch) + last_.capacity() * sizeof(Index);
  }

 private:
  friend struct KeptParts;

  // In 64 bytes, as there are many.
  struct Patch {
    double length;
    Planar c, other;
    std::array<Index, 4> link;    // the patches before it of the slots that were, then those behind
                                  // it of the slots that are
    std::array<Index, 2> packed;  // slot << 4 | bit of the kind << 3 | order

    [[nodiscard]] std::size_t kind() const { return (packed[0] >> 3 & 1) | (packed[1] >> 2 & 2); }
    [[nodiscard]] Index slot(std::size_t k) const {
      return k == 2 ? (packed[1] >> 4) + 1 : packed[k] >> 4;
    }
    [[nodiscard]] CornerOrder order(std::size_t k) const {
      return {static_cast<std::uint8_t>(packed[k] & 3),
              static_cast<std::uint8_t>(packed[k] >> 2 & 1)};
    }
  };
  struct Form;
  static const std::array<Form, 3> forms;
  static const Form& form_of(const Patch& patch);
  static std::array<Planar, 3> points_of(const Patch& patch,
                                         const std::array<std::uint8_t, 3>& corners);
  static std::size_t place_of(const Patch& patch, Index slot);
  [[nodiscard]] Index first_of(Index slot) const;

  Rows<Patch> patches_;
  Rows<Index> last_;  // the last patch of each slot
};

}  // namespace plexway::detail
