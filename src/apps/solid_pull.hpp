#pragma once

#include <vector>

#include <plexway/complex/tet_mesh.hpp>

#include "apps/solid_walk.hpp"

namespace plexway {

/// A point of a polygonal way through a solid.
struct Knot {
  Vector3<double> at;
  std::vector<Index> tets;  ///< some in which lines may begin there; never empty
  Index vertex = none;      ///< if it is one (inside)
};

/// Makes polygonal ways through a solid locally shortest.
///
/// Three moves, each of which keeps the way inside and makes it shorter:
///  * a corner is left out where the straight line between its neighbours stays in the solid;
///  * else it gives way to the tight string in the triangle of the three: the convex hull of the
///    points where reflex edges pierce that triangle. (An obstacle between hull and corner would
///    have a corner of its own there, and that is a reflex edge, so the hull is free.)
///  * a corner on a reflex edge slides along it to where the way unfolds to a straight line, which
///    is a convex problem.
/// Lines are walked through the tetrahedra before a move counts, so rounding cannot lead outside;
/// and to a knot that is there already, into a tetrahedron from which the way goes on: the other
/// side of a crack is at the same place.
/// It ends when a round gains less than 1e-10 of the length, or after 200 rounds.
template <class Real>
class SolidPull {
 public:
  using Point = Vector3<double>;

  explicit SolidPull(const SolidWalk<Real>& walk);

  /// `way` must be inside the solid and have two knots at least; its ends stay.
  void pull(std::vector<Knot>& way);

  static double length(const std::vector<Knot>& way);

 private:
  struct Edge {
    Point end[2];
  };

  bool sees(const Knot& from, const Point& to, Knot& arrived) const;
  bool sees(const Knot& from, const Knot& to) const;
  void skip(std::vector<Knot>& way) const;
  bool tighten(std::vector<Knot>& way, std::size_t k) const;
  bool slide(std::vector<Knot>& way, std::size_t k) const;
  bool chain(const Knot& a, const Point& b, const Knot& c, bool without_b,
             std::vector<Knot>& between) const;

  void look_near(const std::vector<Knot>& way);

  const SolidWalk<Real>& walk_;
  std::vector<Edge> all_edges_;  // reflex, in the caller's unit
  std::vector<Edge> edges_;      // of these, where a way shorter than the present one may pass
};

}  // namespace plexway
