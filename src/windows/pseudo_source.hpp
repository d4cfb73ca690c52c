#pragma once

#include <cmath>
#include <span>

#include <plexway/surface/detail/triangle_record.hpp>

#include "windows/entered_triangle.hpp"

namespace plexway::detail::windows {
/// A corner of a triangle on a walk around its vertex: entered by one of the two edges that meet
/// there, left by the other. Sheets that turn over are walked like any other.
struct FanWalk {
  Index face;
  Index corner;
  bool by_start;  ///< leaves over edge `corner`, which starts here, not over the one before

  [[nodiscard]] Index leaving_edge() const {
    return by_start ? corner : static_cast<Index>(edge_before(corner));
  }
  [[nodiscard]] Index entering_edge() const {
    return by_start ? static_cast<Index>(edge_before(corner)) : corner;
  }

  /// To the next corner around the vertex. False, and nothing done, where the fan ends: at a
  /// boundary, or at an edge with more than two triangles.
  template <class Real>
  bool step(std::span<const TriangleRecord<Real>> triangles) {
    const Index across = triangles[face].across[leaving_edge()];
    const Index g = across >> Across::face_shift, j = across & Across::edge_mask;
    if (g + 1 == triangles.size() || (across & Across::fan)) return false;
    // Opposite directions: the start of one side is the end of the other.
    const bool at_start = by_start == ((across & Across::flip) != 0);
    face = g;
    corner = at_start ? j : static_cast<Index>(edge_after(j));
    by_start = !at_start;
    return true;
  }
};

/// Where the shortest path to a vertex comes from: a direction in one of its corners, `along` and
/// `off` the edge that starts there, of any length. No corner: from all around, as at a source.
template <class Real>
struct Arrival {
  Index corner = none;  ///< 3 f + i
  Real along = 0, off = 0;
};

/// What a vertex lights up of the edge opposite one of its corners: from `begin` to `end`, measured
/// from the edge's first corner.
struct Lit {
  Index face, edge;
  double begin, end;
};

/// A vertex that paths bend at, as a source of its own: it lights up what lies in the shadow of the
/// path that arrived, the directions pi or more away from it on both sides. Angles are turns of
/// unit vectors, never numbers: no trigonometry.
template <class Real>
class PseudoSource {
 public:
  explicit PseudoSource(std::span<const TriangleRecord<Real>> triangles) : triangles_(triangles) {}

  /// All around, by the corners at the vertex: calls lit(Lit) for each, and along(FanWalk) for the
  /// edges at the vertex, which the walks leave by.
  template <class OnLit, class OnEdge>
  void shine_all(std::span<const Index> corners, const OnLit& lit, const OnEdge& along) const {
    for (const Index c : corners) {
      const Index f = c / 3, i = c % 3, e = static_cast<Index>(edge_after(i));
      lit(Lit{f, e, 0, static_cast<double>(triangles_[f].length[e])});
      along(FanWalk{f, i, false});
      along(FanWalk{f, i, true});
    }
  }

  /// Likewise the shadow alone, its borders turned outwards by the angle of `widened`: more light
  /// only adds longer paths. The vertex has one fan, with more around than the arrival sees.
  template <class OnLit, class OnEdge>
  void shine(const Arrival<double>& arrival, bool open, Towards<double> widened, const OnLit& lit,
             const OnEdge& along) const {
    const Index f = arrival.corner / 3, i = arrival.corner % 3;
    const double size = std::sqrt(arrival.along * arrival.along + arrival.off * arrival.off);
    const Towards<double> from = size > 0
                                     ? Towards<double>{arrival.along / size, arrival.off / size}
                                     : Towards<double>{1, 0};
    const Towards<double> width = angle(f, i);
    Border first{{f, i, false}, turned(widened, {from.along, -from.off})};
    Border second{{f, i, true}, turned(widened, turned({width.along, -width.off}, from))};
    const bool has_first = find(first), has_second = find(second);
    if (open) {
      if (has_first) light(first, nullptr, lit, along);
      if (has_second) light(second, nullptr, lit, along);
    } else if (has_first && has_second) {
      light(first, &second, lit, along);
    }
  }

 private:
  using Turn = Towards<double>;  // cosine and sine
  static Turn turned(Turn a, Turn b) {
    return {a.along * b.along - a.off * b.off, a.along * b.off + a.off * b.along};
  }
  [[nodiscard]] Turn angle(Index f, std::size_t i) const {
    return {static_cast<double>(triangles_[f].cosine[i]),
            static_cast<double>(triangles_[f].sine(i))};
  }

  /// A border of the shadow, looked for one way around: the corner it lies in, and how far from the
  /// arrival the edge is by which that was entered.
  struct Border {
    FanWalk walk;
    Turn at;
  };

  /// Goes on to the corner that holds the direction opposite to the arrival. False if the fan ends,
  /// or has next to no angle and is only gone around.
  bool find(Border& border) const {
    constexpr int most_rounds = 16;
    const FanWalk start = border.walk;
    for (int rounds = 0; rounds < most_rounds;) {
      const Turn next = turned(border.at, angle(border.walk.face, border.walk.corner));
      if (border.at.off >= 0 && next.off < 0) return true;
      border.at = next;
      if (!border.walk.step(triangles_)) return false;
      rounds += border.walk.face == start.face && border.walk.corner == start.corner;
    }
    return false;
  }

  /// From one border to the other, or to the end of the fan.
  template <class OnLit, class OnEdge>
  void light(const Border& first, const Border* last, const OnLit& lit, const OnEdge& along) const {
    FanWalk walk = first.walk;
    double low = reach(first);
    for (;;) {
      const Index e = static_cast<Index>(edge_after(walk.corner));
      const double length = static_cast<double>(triangles_[walk.face].length[e]);
      const bool ends = last && walk.face == last->walk.face && walk.corner == last->walk.corner;
      const double high = ends ? length - reach(*last) : length;
      if (low < high)
        lit(walk.by_start ? Lit{walk.face, e, length - high, length - low}
                          : Lit{walk.face, e, low, high});
      if (ends) return;
      along(walk);
      if (!walk.step(triangles_)) return;
      low = 0;
    }
  }

  /// Where a border meets the edge opposite the vertex, from the end of the edge it came by.
  [[nodiscard]] double reach(const Border& border) const {
    const FanWalk& walk = border.walk;
    const TriangleRecord<Real>& t = triangles_[walk.face];
    const std::size_t next = edge_after(walk.corner), other = edge_after(next);
    const Turn end = angle(walk.face, walk.by_start ? other : next);
    const double side = static_cast<double>(t.length[walk.entering_edge()]);
    const double length = static_cast<double>(t.length[next]);
    const double sine = border.at.off, cosine = -border.at.along;  // of what is left to pi
    const double sum = sine * end.along + cosine * end.off;
    const double x = side * sine / sum;
    return sum > 0 && x < length ? x : length;
  }

  std::span<const TriangleRecord<Real>> triangles_;
};

}  // namespace plexway::detail::windows
