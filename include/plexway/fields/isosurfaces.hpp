#pragma once

#include <array>
#include <vector>

#include <plexway/common/ids.hpp>
#include <plexway/common/rows_of.hpp>

namespace plexway {

/// Triangles where a field on a solid has given values.
struct Isosurfaces {
  /// Vertices, in the unit of the solid's positions.
  std::vector<std::array<double, 3>> positions;
  std::vector<std::array<Index, 3>> triangles;  ///< value by value
  std::vector<Index> value;                     ///< of each vertex: a place in the list of values
};

/// The surfaces in a solid where a field has given values. Between vertices the field is linear, so
/// a surface is flat in a tetrahedron; one with a corner that is not reached has none. Triangles
/// that meet share vertices and run counterclockwise as seen from where the field is larger, so a
/// surface has no boundary but on that of the solid, and beside what is not reached.
///
/// Shapes: n positions and distances, m tetrahedra of vertices < n. Throws UsageError for other
/// counts, a tetrahedron of a vertex that is not there, or a value that is not finite. Cost: linear
/// in m for each value.
[[nodiscard]] Isosurfaces isosurfaces(const GivenPoints& positions, const GivenSimplices<4>& tets,
                                      const Given<double>& distance, const Given<double>& values);

}  // namespace plexway
