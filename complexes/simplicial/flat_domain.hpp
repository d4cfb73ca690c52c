#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include <plexway/common/detail/storage.hpp>
#include <plexway/common/ids.hpp>

#include "complexes/common/box_tree.hpp"

namespace plexway::detail {

/// Points of R^N, few operations, any N.
template <std::size_t N>
double inner(const std::array<double, N>& a, const std::array<double, N>& b) {
  double sum = 0;
  for (std::size_t d = 0; d < N; ++d) sum += a[d] * b[d];
  return sum;
}
template <std::size_t N>
std::array<double, N> minus(const std::array<double, N>& a, const std::array<double, N>& b) {
  std::array<double, N> c;
  for (std::size_t d = 0; d < N; ++d) c[d] = a[d] - b[d];
  return c;
}
/// a + s b
template <std::size_t N>
std::array<double, N> plus(const std::array<double, N>& a, double s,
                           const std::array<double, N>& b) {
  std::array<double, N> c;
  for (std::size_t d = 0; d < N; ++d) c[d] = a[d] + s * b[d];
  return c;
}
template <std::size_t N>
double distance_of(const std::array<double, N>& a, const std::array<double, N>& b) {
  double sum = 0;
  for (std::size_t d = 0; d < N; ++d) sum += (a[d] - b[d]) * (a[d] - b[d]);
  return std::sqrt(sum);
}

/// A flat piece of the boundary, of dimension N - 2, with more than pi of domain around it: a
/// corner in the plane, an edge in space, a polygon in four dimensions. Paths bend on these and
/// nowhere else. Faces between the same two walls are one, as far as they are convex together.
template <int N>
struct BendingFace {
  static constexpr std::size_t along = N - 2;
  using Point = std::array<double, N>;
  using Along = std::array<double, along>;  ///< coordinates within the face

  Point origin;
  std::array<Point, along> tangent;  ///< orthonormal, and with the next two a basis
  Point into;                        ///< halves the obstacle
  Point side;                        ///< across `into`
  double origin_into, origin_side;   ///< the origin's coordinates along these
  Index rims_begin, rims_end;
  bool gate =
      false;  ///< no obstacle: parts of the domain touch here and nowhere near, see FaceGate

  [[nodiscard]] Point at(const Along& a) const {
    Point p = origin;
    for (std::size_t k = 0; k < along; ++k) p = plus(p, a[k], tangent[k]);
    return p;
  }
  [[nodiscard]] Along along_of(const Point& p) const {
    const Point from = minus(p, origin);
    Along a;
    for (std::size_t k = 0; k < along; ++k) a[k] = inner(from, tangent[k]);
    return a;
  }
};

/// One end of a face: of an edge a point, of a polygon a side. `from` and `to` are its ends.
template <int N>
struct BendingRim {
  using Along = typename BendingFace<N>::Along;
  Along outward;  ///< unit normal; the face has inner(outward, a) <= reach
  double reach;
  Along from, to;
};

/// From one simplex to another that it touches in a piece of dimension N - 2 alone, where obstacles
/// touch: a hinge of one dimension less than a facet. Ways pass it at any point of the face.
template <int N>
struct FaceGate {
  Index from, to;                         ///< simplices
  Index face;                             ///< one with `gate` set
  typename BendingFace<N>::Along middle;  ///< of what they share
};

/// A complex of dimension N in R^N that does not overlap itself: its vertices as points, about the
/// middle and in units of the mean edge, and the faces on which paths bend.
template <int N>
struct FlatDomain {
  using Point = std::array<double, N>;

  std::vector<Point> positions;       ///< by the numbers inside
  std::vector<BendingFace<N>> faces;  ///< those that are gates come last
  std::vector<BendingRim<N>> rims;
  BoxTree<N> tree;                 ///< over faces but gates
  std::vector<FaceGate<N>> gates;  ///< by `from`
  double rounding;                 ///< coordinates and what is derived from them are good to this
  OnDemand space;                  ///< what strings know of it (src/strings)

  [[nodiscard]] std::span<const BendingRim<N>> rims_of(const BendingFace<N>& face) const {
    return std::span(rims).subspan(face.rims_begin, face.rims_end - face.rims_begin);
  }
  [[nodiscard]] bool holds(const BendingFace<N>& face, const typename BendingFace<N>::Along& a,
                           double slack) const {
    for (const BendingRim<N>& rim : rims_of(face))
      if (inner(rim.outward, a) > rim.reach + slack) return false;
    return true;
  }
  [[nodiscard]] std::size_t bytes() const {
    const auto of = [](const auto& v) { return v.capacity() * sizeof(v[0]); };
    return sizeof(*this) + of(positions) + of(faces) + of(rims) + of(gates) + tree.bytes() +
           space.bytes();
  }
};

}  // namespace plexway::detail
