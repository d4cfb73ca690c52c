#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "complexes/common/box_tree.hpp"
#include "strings/boundary.hpp"

/// What hides one point of a solid from another, and what a string touches first where it is moved
/// from a free place to one that is hidden.
namespace plexway::detail::strings {
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

}  // namespace plexway::detail::strings
