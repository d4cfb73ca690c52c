#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "strings/flat/flat_sight.hpp"

/// A flat domain as strings see it, in any dimension: what SolidSpace is of a solid.
namespace plexway::detail::strings {
template <int N>
class FlatSpace {
 public:
  using Point = FlatPoint<N>;
  using Face = BendingFace<N>;
  using Along = typename Face::Along;

  /// Cost: linear in the simplices, and n log n in the boundary.
  template <class Real>
  FlatSpace(const SimplicialComplex<Real, N>& complex, const FlatDomain<N>& flat)
      : flat_(&flat), on_(std::max(1e-10, 100 * flat.rounding)), aside_(1e4 * on_) {
    const std::vector<FlatWall<N>> walls = find_walls(complex);
    sight_ = FlatSight<N>(flat, walls, on_, aside_);
    find_inside(complex, walls);
    find_gates(complex);
    join(complex);
    std::vector<Box<N>> boxes;
    for (const Face& face : flat.faces) {
      Box<N> box = Box<N>::empty();
      for (const auto& rim : flat.rims_of(face)) box.add(face.at(rim.from));
      box.widen(still);
      boxes.push_back(box);
    }
    tree_ = BoxTree<N>(boxes);
  }
  FlatSpace(const FlatSpace&) = delete;
  FlatSpace& operator=(const FlatSpace&) = delete;

  static constexpr double still = 1e-9;  ///< what moved less did not move

  [[nodiscard]] const FlatDomain<N>& flat() const { return *flat_; }
  [[nodiscard]] const FlatSight<N>& sight() const { return sight_; }
  [[nodiscard]] std::size_t vertices() const { return begin_.size() - 1; }
  [[nodiscard]] const Point& point(Index vertex) const { return flat_->positions[vertex]; }
  [[nodiscard]] const Face& face(Index number) const { return flat_->faces[number]; }
  /// Vertices that share an edge with one.
  [[nodiscard]] std::span<const Index> neighbours(Index vertex) const {
    return std::span(neighbours_).subspan(begin_[vertex], begin_[vertex + 1] - begin_[vertex]);
  }
  /// Where parts of the domain only touch in a face: vertex and face.
  [[nodiscard]] std::span<const std::pair<Index, Index>> gates_at(Index vertex) const {
    const auto [begin, end] =
        std::equal_range(gates_.begin(), gates_.end(), std::pair<Index, Index>{vertex, 0},
                         [](const auto& a, const auto& b) { return a.first < b.first; });
    return std::span(gates_).subspan(static_cast<std::size_t>(begin - gates_.begin()),
                                     static_cast<std::size_t>(end - begin));
  }

  /// Where a leg from or to a vertex ends: a little inside the domain, for one `toward` a point. On
  /// which side of a wall in that direction, or if it is behind the boundary, says `free`.
  [[nodiscard]] Point beside(Index vertex, const Point& toward, const Point& free) const {
    const Point& p = point(vertex);
    if (slot_[vertex] == none) return p;
    const Inside& inside = inside_[slot_[vertex]];
    if (inside.begin == inside.end) return plus(p, aside_, inside.direction);
    return into<N>(std::span(cones_).subspan(inside.begin, inside.end - inside.begin), p, toward,
                   free);
  }
  /// The same from or to a bend.
  [[nodiscard]] Point beside(Index number, Along at, const Point& toward, const Point& free) const {
    const Face& f = face(number);
    for (int turn = 0; turn < 2; ++turn)
      for (const auto& rim : flat_->rims_of(f)) {
        const double over = inner(rim.outward, at) - (rim.reach - 3 * aside_);
        if (over > 0) at = plus(at, -over, rim.outward);
      }
    const Point p = f.at(at);
    if (!f.gate) return plus(p, -aside_, f.into);
    const auto begin = std::partition_point(wedges_.begin(), wedges_.end(),
                                            [&](const Wedge& w) { return w.face < number; });
    const auto end = std::partition_point(begin, wedges_.end(),
                                          [&](const Wedge& w) { return w.face == number; });
    const std::span<const Wedge> there = std::span(wedges_).subspan(
        static_cast<std::size_t>(begin - wedges_.begin()), static_cast<std::size_t>(end - begin));
    return into<2>(there, p, toward, free);
  }
  /// Is a bend at the rim of its face?
  [[nodiscard]] bool is_at_rim(Index number, const Along& at) const {
    return !flat_->holds(face(number), at, -still);
  }
  /// visit(face) for all on which a point lies.
  template <class Visit>
  void faces_at(const Point& p, const Visit& visit) const {
    const auto meets = [&](const Box<N>& box) {
      for (std::size_t d = 0; d < N; ++d)
        if (p[d] < box.low[d] || p[d] > box.high[d]) return false;
      return true;
    };
    tree_.search(meets, [&](Index number) {
      const Face& f = face(number);
      if (is_on(f, p) && flat_->holds(f, f.along_of(p), still)) visit(number);
    });
  }
  [[nodiscard]] std::size_t bytes() const {
    const auto of = [](const auto& v) { return v.capacity() * sizeof(v[0]); };
    return sizeof(*this) + sight_.bytes() + tree_.bytes() + of(begin_) + of(neighbours_) +
           of(slot_) + of(inside_) + of(cones_) + of(gates_) + of(wedges_);
  }

 private:
  // The domain near a vertex, as seen from it: of a simplex the planes and its middle.
  struct Cone {
    Point plane[N], middle;
  };
  // Of a vertex of the boundary: one direction that leads off all of its walls; else its cones.
  struct Inside {
    Point direction;
    Index begin, end;
  };
  // A simplex at a face where parts only touch: its two planes there, and its middle.
  struct Wedge {
    Index face;
    Point plane[2], middle;
  };

  static bool is_on(const Face& f, const Point& p) {
    return std::abs(inner(p, f.side) - f.origin_side) < still &&
           std::abs(inner(p, f.into) - f.origin_into) < still;
  }
  // Off a point into the part that has the direction to `toward`, if there is such, and of these
  // the one that holds that to `free` best.
  template <std::size_t planes, class Part>
  [[nodiscard]] Point into(std::span<const Part> parts, const Point& p, const Point& toward,
                           const Point& free) const {
    const Point first = unit(minus(toward, p)), second = unit(minus(free, p));
    const auto depth = [](const Part& part, const Point& d) {
      double least = 1;
      for (std::size_t k = 0; k < planes; ++k) least = std::min(least, inner(part.plane[k], d));
      return least;
    };
    const Part* best = nullptr;
    double deepest = 0;
    bool held = false;
    for (const Part& part : parts) {
      const bool holds = depth(part, first) >= -on_;
      const double now = depth(part, second);
      if (best != nullptr && (held > holds || (held == holds && now <= deepest))) continue;
      best = &part;
      deepest = now;
      held = holds;
    }
    return plus(p, aside_, best->middle);
  }

  template <class Real>
  std::vector<FlatWall<N>> find_walls(const SimplicialComplex<Real, N>& complex) const {
    std::vector<FlatWall<N>> walls;
    for (const auto& record : complex.records()) {
      if (std::count(record.across, record.across + N + 1, none) == 0) continue;
      const auto gradient = gradients<N>(record, flat_->positions);
      for (std::size_t i = 0; i <= N; ++i) {
        if (record.across[i] != none) continue;
        FlatWall<N> wall;
        const Point normal = unit(gradient[i]);
        for (std::size_t n = 0; n < N; ++n) {
          const std::size_t k = SimplexLayout<N>::corner(i, n);
          wall.corner[n] = record.corner[k];
          // Towards corner k from any other one of the wall.
          const Point inward = unit(plus(gradient[k], -inner(gradient[k], normal), normal));
          const std::size_t other = SimplexLayout<N>::corner(i, n == 0 ? 1 : 0);
          wall.side[n] = {inward, inner(inward, point(record.corner[other]))};
        }
        wall.plane = {normal, inner(normal, point(wall.corner[0]))};
        walls.push_back(wall);
      }
    }
    return walls;
  }

  template <class Real>
  void find_inside(const SimplicialComplex<Real, N>& complex, std::span<const FlatWall<N>> walls) {
    constexpr double clear = .05;  // of a cosine
    std::vector<std::pair<Index, Index>> at;
    for (Index w = 0; w < walls.size(); ++w)
      for (const Index v : walls[w].corner) at.push_back({v, w});
    std::sort(at.begin(), at.end());
    slot_.assign(complex.vertex_count(), none);
    for (std::size_t first = 0, last = 0; first < at.size(); first = last) {
      const Index v = at[first].first;
      while (last < at.size() && at[last].first == v) ++last;
      const auto normal = [&](std::size_t i) { return walls[at[i].second].plane.normal; };
      Point sum{};
      for (std::size_t i = first; i < last; ++i) sum = plus(sum, 1, normal(i));
      sum = unit(sum);
      double least = 0;
      for (int tries = 0; tries < 32 && least <= clear; ++tries) {
        std::size_t worst = first;
        for (std::size_t i = first; i < last; ++i)
          if (inner(normal(i), sum) < inner(normal(worst), sum)) worst = i;
        least = inner(normal(worst), sum);
        if (least <= clear) sum = unit(plus(sum, 2 * clear - least, normal(worst)));
      }
      slot_[v] = static_cast<Index>(inside_.size());
      const auto begin = static_cast<Index>(cones_.size());
      if (least <= clear)
        for (const Index corner : complex.corners_at(v)) add_cone(complex, corner);
      inside_.push_back({sum, begin, static_cast<Index>(cones_.size())});
    }
  }
  template <class Real>
  void add_cone(const SimplicialComplex<Real, N>& complex, Index corner) {
    const auto& record = complex.records()[corner / (N + 1)];
    const auto gradient = gradients<N>(record, flat_->positions);
    Cone cone{};
    for (std::size_t n = 0; n < N; ++n) {
      const std::size_t k = SimplexLayout<N>::corner(corner % (N + 1), n);
      cone.plane[n] = unit(gradient[k]);
      cone.middle =
          plus(cone.middle, 1,
               unit(minus(point(record.corner[k]), point(record.corner[corner % (N + 1)]))));
    }
    cone.middle = unit(cone.middle);
    cones_.push_back(cone);
  }

  template <class Real>
  void find_gates(const SimplicialComplex<Real, N>& complex) {
    std::vector<std::pair<Index, Index>> sides;  // face, and a simplex there
    for (const FaceGate<N>& gate : flat_->gates) sides.push_back({gate.face, gate.from});
    std::sort(sides.begin(), sides.end());
    sides.erase(std::unique(sides.begin(), sides.end()), sides.end());
    for (const auto& [number, simplex] : sides) {
      const auto& record = complex.records()[simplex];
      const auto gradient = gradients<N>(record, flat_->positions);
      const Face& f = face(number);
      Wedge wedge{number, {}, {}};
      for (std::size_t k = 0, off = 0; k <= N; ++k) {
        const Point& p = point(record.corner[k]);
        if (is_on(f, p)) {
          gates_.push_back({record.corner[k], number});
        } else if (off < 2) {
          const Point d = minus(p, f.origin);
          wedge.plane[off++] = unit(gradient[k]);
          wedge.middle =
              plus(wedge.middle, 1,
                   unit(plus(plus(Point{}, inner(d, f.into), f.into), inner(d, f.side), f.side)));
        }
      }
      wedge.middle = unit(wedge.middle);
      wedges_.push_back(wedge);
    }
    std::sort(gates_.begin(), gates_.end());
    gates_.erase(std::unique(gates_.begin(), gates_.end()), gates_.end());
  }

  template <class Real>
  void join(const SimplicialComplex<Real, N>& complex) {
    std::vector<Index> seen(complex.vertex_count(), none);
    begin_.assign(1, 0);
    for (Index v = 0; v < complex.vertex_count(); ++v) {
      seen[v] = v;
      for (const Index corner : complex.corners_at(v))
        for (const Index w : complex.records()[corner / (N + 1)].corner)
          if (std::exchange(seen[w], v) != v) neighbours_.push_back(w);
      begin_.push_back(static_cast<Index>(neighbours_.size()));
    }
  }

  const FlatDomain<N>* flat_;
  double on_;     // so near to a plane a point is on it
  double aside_;  // so far beside the boundary legs run
  FlatSight<N> sight_;
  BoxTree<N> tree_;  // over faces
  std::vector<Index> begin_, neighbours_;
  std::vector<Index> slot_;  // into inside_; none: not on the boundary
  std::vector<Inside> inside_;
  std::vector<Cone> cones_;
  std::vector<std::pair<Index, Index>> gates_;  // vertex, face
  std::vector<Wedge> wedges_;                   // by face
};

}  // namespace plexway::detail::strings
