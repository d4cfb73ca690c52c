#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <plexway/common/ids.hpp>
#include <plexway/surface/detail/triangle_record.hpp>

namespace plexway::detail {

class FaceLayout;

/// Which corners meet at each vertex, and how.
struct VertexFans {
  std::vector<Index> corner;      ///< one corner 3 f + i a vertex, none where unreferenced
  std::vector<char> on_boundary;  ///< an end of an edge with one triangle
  std::vector<Index> irregular;   ///< vertices whose corners one walk does not find, ascending
  std::vector<Index> irregular_begin, irregular_corners;  ///< their corners, row by row
  std::vector<Index> pinched;  ///< irregular ones where no chain of edges joins all corners
  std::size_t components = 0;  ///< joined by edges or pinched vertices
};

/// By any number of threads.
VertexFans find_vertex_fans(const FaceLayout& layout, int threads);

/// Calls visit(corner) for the corners 3 f + i reached from `start` by crossing edges with two
/// triangles, first one way around, then the other. across_of(face, edge) is packed as Across.
template <class AcrossOf, class Visit>
void walk_fan(Index sentinel, AcrossOf across_of, Index start, Visit visit) {
  visit(start);
  for (int way = 0; way < 2; ++way) {
    Index f = start / 3, corner = start % 3;
    // Leave over edge `corner` (which starts here) or over the one before (which ends here).
    bool by_start = way == 0;
    for (;;) {
      const Index across = across_of(f, by_start ? corner : (corner == 0 ? 2 : corner - 1));
      const Index g = across >> Across::face_shift, j = across & Across::edge_mask;
      if (g == sentinel || (across & Across::fan)) break;
      // Opposite directions: the start of one side is the end of the other.
      const bool at_start = by_start == ((across & Across::flip) != 0);
      f = g;
      corner = at_start ? j : (j == 2 ? 0 : j + 1);
      by_start = !at_start;  // leave over the other edge of that corner
      if (3 * f + corner == start) return;
      visit(3 * f + corner);
    }
  }
}

/// The same in records, the last of which is the sentinel.
template <class Real, class Visit>
void walk_fan(std::span<const TriangleRecord<Real>> triangles, Index start, Visit visit) {
  walk_fan(
      static_cast<Index>(triangles.size() - 1),
      [&](Index f, Index edge) { return triangles[f].across[edge]; }, start, visit);
}

/// Do sheets at a vertex, given by its corners, lie like the pages of a book that is open wide or
/// less on a spine, so that any two together are flat or convex there? Then no path bends at it,
/// though there is more than 2 pi around.
template <class Real>
bool is_open_book(std::span<const TriangleRecord<Real>> triangles, std::span<const Index> corners);

}  // namespace plexway::detail
