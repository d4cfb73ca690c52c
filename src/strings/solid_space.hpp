#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <plexway/solid/tet_mesh.hpp>

#include "complexes/common/box_tree.hpp"
#include "strings/boundary.hpp"

namespace plexway::detail::strings {

/// What hides one point of a solid from another, and what a string touches first where it is moved
/// from a free place to one that is hidden.
///
/// A straight leg is free if it leaves the solid nowhere: so only the boundary is looked at, and of
/// that only faces that have some of the solid behind their plane. A convex solid has none.
class Sight {
 public:
  Sight() = default;
  Sight(const Boundary& boundary, std::span<const Point> points);

  /// Is a face between them? Ends lie a little inside the solid, or on what hides nothing. A leg
  /// that no more than touches edges is free if it is beside them: in the plane of a crack the side
  /// is open.
  [[nodiscard]] bool is_blocked(const Point& from, const Point& to) const;

  /// A place, and how far along it.
  struct Touch {
    Index place;
    double at;
  };
  /// A leg `from`-`to` is blocked, from `from` to `free` it is not. What does it touch first on its
  /// way from there, turning about `from`? The boundary is cut by their plane, and the cut followed
  /// from each face that is between to where it rises highest; that is a bend. Not at the places
  /// `known`, where the leg's ends are.
  [[nodiscard]] std::optional<Touch> touch(const Point& from, const Point& to, const Point& free,
                                           const std::array<Index, 2>& known) const;

  [[nodiscard]] std::size_t bytes() const {
    return walls_.capacity() * sizeof(Wall) + tree_.bytes();
  }

 private:
  struct Plane {
    Point normal;
    double offset;
    [[nodiscard]] double height(const Point& p) const { return dot(normal, p) - offset; }
  };
  struct Wall {
    Plane plane;
    Plane side[3];  // in the plane, inward
    Index face;
  };
  [[nodiscard]] bool is_between(const Wall& wall, const Point& from, const Point& to) const;
  // The bend that is seen highest from `from`, in the plane of `rise`.
  [[nodiscard]] std::optional<Touch> highest(const Point& from, const Point& to, const Point& rise,
                                             const std::array<Index, 2>& known) const;
  template <class Visit>  // visit(wall), true to end
  void along(const Point& from, const Point& to, const Visit& visit) const;

  const Boundary* boundary_ = nullptr;
  std::span<const Point> points_;
  std::vector<Wall> walls_;
  BoxTree<3> tree_;
};

/// A flat solid as strings see it: what follows from the mesh alone, so that solves share it.
class SolidSpace {
 public:
  /// Cost: linear in the tetrahedra, and n log n in the boundary.
  template <class Real>
  explicit SolidSpace(const TetMesh<Real>& mesh);
  /// With other points, of the mesh's numbers inside: where several solids share theirs.
  template <class Real>
  SolidSpace(const TetMesh<Real>& mesh, std::vector<Point> points);
  SolidSpace(const SolidSpace&) = delete;
  SolidSpace& operator=(const SolidSpace&) = delete;

  [[nodiscard]] std::size_t vertices() const { return points_.size(); }
  [[nodiscard]] const Point& point(Index vertex) const { return points_[vertex]; }
  /// Vertices that share an edge with one.
  [[nodiscard]] std::span<const Index> neighbours(Index vertex) const {
    return std::span<const Index>(neighbours_)
        .subspan(begin_[vertex], begin_[vertex + 1] - begin_[vertex]);
  }
  /// Has it, or a neighbour, an edge where strings turn much? There they part in many ways.
  [[nodiscard]] bool is_sharp(Index vertex) const { return sharp_[vertex] != 0; }
  [[nodiscard]] const std::vector<Place>& places() const { return boundary_.places; }
  [[nodiscard]] const Sight& sight() const { return sight_; }

  /// Where a leg from or to a vertex ends: a little inside the solid, for one `toward` a point. On
  /// which side of a face in that direction, or if it is behind the boundary, says `free`.
  [[nodiscard]] Point beside(Index vertex, const Point& toward, const Point& free) const {
    const Index slot = slot_[vertex];
    return slot == none ? points_[vertex] : beside_boundary(slot, vertex, toward, free);
  }
  /// The same from or to a point of an edge where tetrahedra only touch.
  [[nodiscard]] Point beside(const Place& place, double t, const Point& toward,
                             const Point& free) const;
  [[nodiscard]] const Boundary::Face& face(Index number) const { return boundary_.faces[number]; }
  /// A little off `p` into one of the parts of the solid there: one that has the direction to
  /// `toward`, if there is such, and of these the one that holds that to `free` best.
  template <class Part>
  [[nodiscard]] Point into(std::span<const Part> parts, const Point& p, const Point& toward,
                           const Point& free) const;
  /// Rows of edges at a vertex: vertex and place.
  [[nodiscard]] std::span<const std::pair<Index, Index>> rows_at(Index vertex) const {
    return of(boundary_.rows_at, vertex);
  }
  /// Faces of the boundary at a vertex: vertex and face.
  [[nodiscard]] std::span<const std::pair<Index, Index>> faces_at(Index vertex) const {
    const Index slot = slot_[vertex];
    if (slot == none) return {};
    const std::size_t first = inside_[slot].face,
                      last = slot + 1 < inside_.size() ? inside_[slot + 1].face : faces_at_.size();
    return std::span(faces_at_).subspan(first, last - first);
  }
  /// Are two points of rows of edges, at `row` and at `next`, on one face of the boundary?
  [[nodiscard]] bool are_on_face(Index row, const Point& at, Index next, const Point& to) const;
  [[nodiscard]] std::size_t bytes() const;

 private:
  // The solid near a vertex, as seen from it: of a tetrahedron the planes and its middle.
  struct Cone {
    Point plane[3], middle;
  };
  // Of a vertex of the boundary: one direction that leads off all of its faces; else its cones.
  struct Inside {
    Point direction;
    Index begin, end;
    Index face;  // of faces_at_, the first one
  };
  static std::span<const std::pair<Index, Index>> of(
      const std::vector<std::pair<Index, Index>>& pairs, Index vertex) {
    const auto begin =
        std::lower_bound(pairs.begin(), pairs.end(), std::pair<Index, Index>{vertex, 0});
    auto end = begin;
    while (end != pairs.end() && end->first == vertex) ++end;
    return std::span(pairs).subspan(static_cast<std::size_t>(begin - pairs.begin()),
                                    static_cast<std::size_t>(end - begin));
  }
  template <class Real>
  void join(const TetMesh<Real>& mesh);
  void find_sharp();
  template <class Real>
  void find_inside(const TetMesh<Real>& mesh);
  [[nodiscard]] Point beside_boundary(Index slot, Index vertex, const Point& toward,
                                      const Point& free) const;

  std::vector<Point> points_;
  Boundary boundary_;
  Sight sight_;
  std::vector<Index> begin_, neighbours_;
  std::vector<char> sharp_;
  std::vector<std::pair<Index, Index>> faces_at_;
  std::vector<Index> slot_;  // into inside_; none: not on the boundary
  std::vector<Inside> inside_;
  std::vector<Cone> cones_;
};

}  // namespace plexway::detail::strings
