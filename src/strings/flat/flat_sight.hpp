#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include <plexway/simplicial/simplicial_complex.hpp>

#include "complexes/simplicial/flat_domain.hpp"
#include "complexes/simplicial/simplex_shape.hpp"

/// What hides one point of a flat domain of any dimension from another. As Sight (solid_space.hpp),
/// but for how the first touch is found.
namespace plexway::detail::strings {
/// A point of R^N.
template <int N>
using FlatPoint = std::array<double, N>;

/// `a` over its length; 0 for 0.
template <std::size_t N>
std::array<double, N> unit(const std::array<double, N>& a) {
  const double length = std::sqrt(inner(a, a));
  return length > 0 ? plus(std::array<double, N>{}, 1 / length, a) : a;
}

/// How the barycentric coordinates of a simplex grow.
template <std::size_t N, class Record>
std::array<std::array<double, N>, N + 1> gradients(
    const Record& record, std::span<const std::array<double, N>> positions) {
  std::array<std::array<double, N>, N + 1> gradient{};
  for (std::size_t k = 1; k <= N; ++k) {
    double m[N][N + 1];
    for (std::size_t j = 0; j < N; ++j) {
      const auto edge = minus(positions[record.corner[j + 1]], positions[record.corner[0]]);
      std::copy(edge.begin(), edge.end(), m[j]);
      m[j][N] = j + 1 == k ? 1 : 0;
    }
    eliminate(m);
    for (std::size_t d = 0; d < N; ++d) gradient[k][d] = m[d][N] / m[d][d];
    gradient[0] = plus(gradient[0], -1., gradient[k]);
  }
  return gradient;
}

/// A facet of the boundary.
template <int N>
struct FlatWall {
  struct Plane {
    FlatPoint<N> normal;
    double offset;
    [[nodiscard]] double height(const FlatPoint<N>& p) const { return inner(normal, p) - offset; }
  };
  Plane plane;    ///< into the domain
  Plane side[N];  ///< within the plane, inward
  std::array<Index, N> corner;
};

template <int N>
class FlatSight {
 public:
  using Point = FlatPoint<N>;
  using Wall = FlatWall<N>;
  using Along = typename BendingFace<N>::Along;

  FlatSight() = default;
  /// Of all walls those are kept that have something of the domain behind their plane.
  FlatSight(const FlatDomain<N>& flat, std::span<const Wall> walls, double on, double aside)
      : flat_(&flat), on_(on), aside_(aside) {
    std::vector<Index> vertices;
    for (const Wall& wall : walls)
      vertices.insert(vertices.end(), wall.corner.begin(), wall.corner.end());
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    std::vector<Box<N>> boxes;
    for (const Index v : vertices) boxes.push_back({flat.positions[v], flat.positions[v]});
    const BoxTree<N> tree(boxes);
    std::vector<Box<N>> around;
    for (const Wall& wall : walls) {
      bool hides = false;
      tree.search(
          [&](const Box<N>& box) {
            Point lowest;
            for (std::size_t d = 0; d < N; ++d)
              lowest[d] = wall.plane.normal[d] > 0 ? box.low[d] : box.high[d];
            return !hides && wall.plane.height(lowest) < -on;
          },
          [&](Index n) { hides = hides || wall.plane.height(boxes[n].low) < -on; });
      if (!hides) continue;
      Box<N> box = Box<N>::empty();
      for (const Index v : wall.corner) box.add(flat.positions[v]);
      box.widen(on);
      walls_.push_back(wall);
      around.push_back(box);
    }
    tree_ = BoxTree<N>(around);
  }

  /// Is a wall between them? Ends lie a little inside the domain. A leg that no more than touches
  /// faces is free if it is beside them.
  [[nodiscard]] bool is_blocked(const Point& from, const Point& to) const {
    bool blocked = false, grazing = false;
    Point off{};
    along(from, to, [&](const Wall& wall) {
      const Point at = crossing(wall, from, to);
      bool inside = true;
      for (const auto& side : wall.side) {
        if (side.height(at) > on_) continue;
        inside = false;
        if (!grazing) off = plus(Point{}, -.01 * aside_, side.normal);
      }
      grazing = true;
      return blocked = inside;
    });
    if (blocked || !grazing) return blocked;
    along(plus(from, 1, off), plus(to, 1, off), [&](const Wall&) { return blocked = true; });
    return blocked;
  }

  /// A bending face, and where on it.
  struct Touch {
    Index face;
    Along at;
  };
  /// A leg `from`-`to` is blocked, from `from` to `free` it is not. What does it touch first on its
  /// way from there, turning about `from`? Of the bending faces that the triangle of the three
  /// meets the one seen nearest to `free`; not one of `known`, where the leg's ends are.
  [[nodiscard]] std::optional<Touch> touch(const Point& from, const Point& to, const Point& free,
                                           const std::array<Index, 2>& known) const {
    if (const auto found = nearest(from, to, free, known)) return found;
    // It hardly turned: straight off the first wall between.
    Point off = free;
    along(from, to, [&](const Wall& wall) {
      off = plus(crossing(wall, from, to), 2, wall.plane.normal);
      return true;
    });
    return nearest(from, to, off, known);
  }

  [[nodiscard]] std::size_t bytes() const {
    return walls_.capacity() * sizeof(Wall) + tree_.bytes();
  }

 private:
  static Point crossing(const Wall& wall, const Point& from, const Point& to) {
    const double before = std::max(wall.plane.height(from), 0.);
    return plus(from, before / (before - wall.plane.height(to)), minus(to, from));
  }
  [[nodiscard]] bool is_between(const Wall& wall, const Point& from, const Point& to) const {
    if (!(wall.plane.height(from) > -on_ && wall.plane.height(to) < -on_)) return false;
    const Point at = crossing(wall, from, to);
    return std::none_of(std::begin(wall.side), std::end(wall.side),
                        [&](const auto& side) { return side.height(at) < -on_; });
  }
  template <class Visit>  // visit(wall), true to end
  void along(const Point& from, const Point& to, const Visit& visit) const {
    Point inverse, low, high;
    for (std::size_t d = 0; d < N; ++d) {
      const double way = to[d] - from[d];
      inverse[d] = 1 / (std::abs(way) < 1e-30 ? 1e-30 : way);
      low[d] = std::min(from[d], to[d]);
      high[d] = std::max(from[d], to[d]);
    }
    bool done = false;
    const auto meets = [&](const Box<N>& box) {
      if (done) return false;
      double begin = 0, end = 1;
      for (std::size_t d = 0; d < N; ++d) {
        if (box.low[d] > high[d] || box.high[d] < low[d]) return false;
        const double s = (box.low[d] - from[d]) * inverse[d],
                     t = (box.high[d] - from[d]) * inverse[d];
        begin = std::max(begin, std::min(s, t));
        end = std::min(end, std::max(s, t));
      }
      return begin <= end;
    };
    tree_.search(meets, [&](Index w) {
      done = done || (is_between(walls_[w], from, to) && visit(walls_[w]));
    });
  }

  [[nodiscard]] std::optional<Touch> nearest(const Point& from, const Point& to, const Point& free,
                                             const std::array<Index, 2>& known) const {
    constexpr double slack = 1e-9;
    Box<N> box = Box<N>::empty();
    for (const Point& p : {from, to, free}) box.add(p);
    std::optional<Touch> best;
    double highest = -1;
    const auto meets = [&](const Box<N>& other) {
      for (std::size_t d = 0; d < N; ++d)
        if (other.low[d] > box.high[d] || other.high[d] < box.low[d]) return false;
      return true;
    };
    flat_->tree.search(meets, [&](Index f) {
      if (f == known[0] || f == known[1]) return;
      const BendingFace<N>& face = flat_->faces[f];
      const auto side = [&](const Point& p) { return inner(p, face.side) - face.origin_side; };
      const auto into = [&](const Point& p) { return inner(p, face.into) - face.origin_into; };
      const double sa = side(from), sb = side(free), sc = side(to);
      const double ia = into(from), ib = into(free), ic = into(to);
      const double at_to = sa * ib - ia * sb, at_free = sc * ia - ic * sa,
                   all = at_to + at_free + sb * ic - ib * sc;
      if (std::abs(all) < 1e-18) return;
      const double x = at_to / all, y = at_free / all;
      if (x < -slack || y < -slack || x + y > 1 + slack || !(y > highest * (x + y))) return;
      const Point p = plus(plus(from, y, minus(free, from)), x, minus(to, from));
      const Along at = face.along_of(p);
      if (!flat_->holds(face, at, slack)) return;
      highest = y / (x + y);
      best = Touch{f, at};
    });
    return best;
  }

  const FlatDomain<N>* flat_ = nullptr;
  double on_ = 0, aside_ = 0;
  std::vector<Wall> walls_;
  BoxTree<N> tree_;
};

}  // namespace plexway::detail::strings
