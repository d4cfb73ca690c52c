#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include <plexway/common/ids.hpp>
#include <plexway/surface/detail/triangle_record.hpp>
#include <plexway/surface/triangle_mesh.hpp>

#include "complexes/common/building_blocks.hpp"

namespace plexway::detail {

/// across[f][i]: the halfedge 3 g + j that comes after halfedge 3 f + i around its edge, or none.
using Gluing = std::vector<std::array<Index, 3>>;
using Faces = std::span<const std::array<Index, 3>>;

/// Glues triangles where two corners share both vertices. More than two on an edge form a cycle.
Gluing glue_by_vertices(std::size_t vertices, Faces faces);

/// Throws InputError where `across` is not made of cycles over the same pair of vertices.
void check_gluing(Faces faces, std::span<const std::array<Index, 3>> across);

/// A triangle's edge from its higher end: packed as Across, with Across::flip where it runs down.
struct EdgeSide {
  Index upper, halfedge;
};

/// Part of match_edges: the buckets of the vertices from `begin` to `stop`; end[v]: where that of v
/// ends.
template <class Before, class Visit>
void match_in_buckets(EdgeSide* sides, std::span<const Index> end, std::size_t begin,
                      std::size_t stop, Before before, Visit& visit) {
  constexpr std::ptrdiff_t few = 32;
  std::vector<EdgeSide> run;
  EdgeSide* first = sides + (begin == 0 ? 0 : end[begin - 1]);
  for (Index v = static_cast<Index>(begin); v < stop; ++v) {
    EdgeSide* const next = sides + end[v];
    EdgeSide* last = next;
    if (last - first > few) {
      std::sort(first, last, [&](const EdgeSide& a, const EdgeSide& b) {
        return a.upper != b.upper ? a.upper < b.upper : before(a, b);
      });
      for (EdgeSide* behind = first; first != last; first = behind) {
        while (behind != last && behind->upper == first->upper) ++behind;
        if (behind - first == 1)
          visit.single(v, *first);
        else if (behind - first == 2)
          visit.pair(first[0], first[1]);
        else
          visit.cycle(v, std::span<const EdgeSide>(first, behind));
      }
    }
    for (; first < last; ++first) {
      const Index upper = first->upper;
      const auto after = [&](EdgeSide* s) {
        do ++s;
        while (s < last && s->upper != upper);
        return s;
      };
      EdgeSide* const second = after(first);
      if (second >= last) {
        visit.single(v, *first);
        continue;
      }
      if (after(second) >= last) {
        visit.pair(*first, *second);
        *second = *--last;
        continue;
      }
      run.clear();
      for (EdgeSide* s = first; s < last;) {
        if (s->upper != upper) {
          ++s;
          continue;
        }
        run.push_back(*s);
        *s = s == first ? *s : *--last;
        if (s == first) ++s;
      }
      std::sort(run.begin(), run.end(), before);
      visit.cycle(v, std::span<const EdgeSide>(run));
    }
    first = next;
  }
}

/// Which halfedges run between the same two vertices, which are not one. Calls, for each edge,
///   visit.single(lower, side)         of one triangle,
///   visit.pair(side, side)            of two,
///   visit.cycle(lower, sides)         of more, in the order of `before(side, side)`.
///
/// Each block of vertices has a copy of `visit`, and visit.take(copy) has what it counted; any
/// number of threads, where vertices are numbered by their first use (tell_vertices).
///
/// Halfedges lie in buckets by their lower vertex, some six each: those are scanned. Only where
/// many meet are they sorted. Cost: linear but for that, 40 instructions a halfedge.
template <class Before, class Visit>
void match_edges(std::size_t vertices, std::span<const std::array<Index, 3>> faces,
                 std::span<const Index> first_use, int threads, Before before, Visit& visit) {
  std::vector<Index> end(vertices + 1, 0);  // of each bucket, once they are full
  tell_vertices<char>(
      first_use, faces.size(), threads,
      [&](std::size_t first, std::size_t last, const auto& tell) {
        for (std::size_t f = first; f < last; ++f) {
          const auto& [a, b, c] = faces[f];
          tell(std::min(a, b), 0);
          tell(std::min(b, c), 0);
          tell(std::min(c, a), 0);
        }
      },
      [&](Index v, char) { ++end[v + 1]; });
  for (std::size_t v = 0; v < vertices; ++v) end[v + 1] += end[v];
  Unfilled<EdgeSide> sides(3 * faces.size());
  tell_vertices<EdgeSide>(
      first_use, faces.size(), threads,
      [&](std::size_t first, std::size_t last, const auto& tell) {
        for (std::size_t f = first; f < last; ++f) {
          const auto add = [&](Index a, Index b, Index edge) {
            const bool down = b < a;
            tell(down ? b : a, EdgeSide{down ? a : b, static_cast<Index>(f) << Across::face_shift |
                                                          edge | (down ? Across::flip : 0)});
          };
          add(faces[f][0], faces[f][1], 0);
          add(faces[f][1], faces[f][2], 1);
          add(faces[f][2], faces[f][0], 2);
        }
      },
      [&](Index v, const EdgeSide& side) { sides[end[v]++] = side; });
  const Visit fresh = visit;
  gather_blocks<std::optional<Visit>>(
      vertices, threads,
      [&](std::size_t first, std::size_t last, std::optional<Visit>& own) {
        own.emplace(fresh);
        match_in_buckets(sides.data(), std::span<const Index>(end), first, last, before, *own);
      },
      [&](const std::optional<Visit>& own) { visit.take(*own); });
}

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

/// Decides at which vertices shortest paths may bend, and sets the sign bits of their sines.
///
/// `excess`, one number a vertex: the angle around it beyond 2 pi, or on a boundary beyond pi.
/// `hints` has the thresholds and whether the vertices are samples; `first_use` is FaceLayout's.
/// `vertices`: so many has the whole surface that this is a part of; 0: it is the whole. Sines must
/// be >= 0. Cost: linear, two passes, by as many threads as `hints` say.
template <class Real>
void mark_saddles(std::span<TriangleRecord<Real>> triangles, const VertexFans& fans,
                  std::span<const Index> first_use, std::vector<double> excess,
                  const SurfaceHints& hints, std::size_t vertices = 0);

}  // namespace plexway::detail
