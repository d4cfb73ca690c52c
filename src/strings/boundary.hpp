#pragma once

#include <array>
#include <span>
#include <utility>
#include <vector>

#include <plexway/solid/tet_mesh.hpp>

#include "strings/place.hpp"

/// The boundary of a solid as strings see it: faces, what joins them, and where strings may bend.
namespace plexway::detail::strings {

/// What counts as flat. Coordinates are in double, in mean edges.
struct Tolerances {
  static constexpr double on = 1e-10;     ///< so near to a plane a point is on it
  static constexpr double aside = 1e-6;   ///< so far beside the boundary legs run
  static constexpr double reflex = 1e-7;  ///< so much more than pi bends strings (radians)
  static constexpr double same = 1e-7;    ///< directions and normals of one row differ by less
};

struct Boundary {
  /// Edge k of a face is from corner k + 1 to corner k + 2, so opposite to corner k.
  struct Face {
    std::array<Index, 3> corner;  ///< vertices; counterclockwise as seen from the solid
    std::array<Index, 3> across;  ///< faces behind the edges, through the solid
    std::array<Index, 3> place;   ///< of the edges; none: strings do not bend there
    Point normal;                 ///< into the solid, unit; 0 without area
  };
  /// A tetrahedron at an edge: its two planes there, inward, and what is halfway between.
  struct Wedge {
    Point plane[2], middle;
  };
  std::vector<Face> faces;
  std::vector<Place> places;                     ///< rows of edges
  std::vector<Wedge> wedges;                     ///< of edges where tetrahedra only touch
  std::vector<std::pair<Index, Index>> rows_at;  ///< vertex and a row of edges there, ascending
};

/// Cost: linear in the tetrahedra, and n log n in the boundary.
template <class Real>
Boundary find_boundary(const TetMesh<Real>& mesh, std::span<const Point> points);

}  // namespace plexway::detail::strings
