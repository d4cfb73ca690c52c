#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include <plexway/common/ids.hpp>
#include <plexway/surface/detail/triangle_record.hpp>

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

}  // namespace plexway::detail
