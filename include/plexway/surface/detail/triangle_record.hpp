#pragma once

#include <cmath>
#include <cstddef>

#include <plexway/common/ids.hpp>

namespace plexway::detail {

/// The halfedge on the other side of an edge, packed.
struct Across {
  static constexpr Index edge_mask = 3;  ///< its edge in its triangle
  static constexpr Index flip = 4;  ///< it runs in the same direction: the sheet turns over here
  static constexpr Index fan = 8;   ///< a cycle: more than two triangles share the edge, or two
                                    ///< that measure it differently
  static constexpr Index special = flip | fan;
  static constexpr int face_shift = 4;
  static constexpr Index limit = Index{1} << 28;  ///< so many triangles at most
};

/// Added to TriangleRecord::face where orientation turned the caller's triangle over.
inline constexpr Index reversed = Index{1} << 31;

/// The edges before and after an edge of a triangle. Without a branch: which edge a path came in by
/// is as good as random.
[[nodiscard]] constexpr std::size_t edge_before(std::size_t i) { return 0x12u >> (2 * i) & 3; }
[[nodiscard]] constexpr std::size_t edge_after(std::size_t i) { return 0x09u >> (2 * i) & 3; }

/// All that propagation reads of one triangle, in one cache line (float). Edge i runs from corner
/// i to corner i + 1 (mod 3); its apex is corner i + 2. Lengths are in units of the mean edge.
///
/// Cosines and sines rather than apexes: turning a label from one edge to the next is what
/// propagation does most, and then needs no division.
template <class Real>
struct alignas(sizeof(Real) == 4 ? 64 : 8) TriangleRecord {
  Index across[3];  ///< Across of each edge; the sentinel's index on a boundary
  Real length[3];
  Real cosine[3];       ///< of the angle at corner i
  Real signed_sine[3];  ///< of that angle, >= 0; the sign bit says that a path may bend at corner i
  Index corner[3];      ///< vertices, numbers inside
  Index face;           ///< the caller's number; `reversed` is added if the corners run backwards

  [[nodiscard]] Real sine(std::size_t i) const { return std::abs(signed_sine[i]); }
  [[nodiscard]] bool saddle(std::size_t i) const { return std::signbit(signed_sine[i]); }
  /// The apex over edge i: along the edge from corner i, and off it.
  [[nodiscard]] Real apex_x(std::size_t i) const { return length[i == 0 ? 2 : i - 1] * cosine[i]; }
  [[nodiscard]] Real apex_h(std::size_t i) const { return length[i == 0 ? 2 : i - 1] * sine(i); }
};

}  // namespace plexway::detail
