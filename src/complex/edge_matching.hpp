#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <plexway/complex/detail/triangle_record.hpp>
#include <plexway/complex/ids.hpp>

namespace plexway {

/// A triangle's edge from its higher end: packed as Across, with Across::flip where it runs down.
struct EdgeSide {
  Index upper, halfedge;
};

/// Which halfedges run between the same two vertices, which are not one. Calls, for each edge,
///   visit.single(lower, side)         of one triangle,
///   visit.pair(side, side)            of two,
///   visit.cycle(lower, sides)         of more, in the order of `before(side, side)`.
///
/// Halfedges lie in buckets by their lower vertex, some six each: those are scanned. Only where
/// many meet are they sorted. Cost: linear but for that, 40 instructions a halfedge.
template <class Before, class Visit>
void match_edges(std::size_t vertices, std::span<const std::array<Index, 3>> faces, Before before,
                 Visit&& visit) {
  std::vector<Index> end(vertices + 1, 0);  // of each bucket, once they are full
  for (const auto& [a, b, c] : faces) {
    ++end[std::min(a, b) + 1];
    ++end[std::min(b, c) + 1];
    ++end[std::min(c, a) + 1];
  }
  for (std::size_t v = 0; v < vertices; ++v) end[v + 1] += end[v];
  std::vector<EdgeSide> sides(3 * faces.size());
  for (Index f = 0; f < faces.size(); ++f) {
    const auto add = [&](Index a, Index b, Index edge) {
      const bool down = b < a;
      sides[end[down ? b : a]++] = {down ? a : b,
                                    f << Across::face_shift | edge | (down ? Across::flip : 0)};
    };
    add(faces[f][0], faces[f][1], 0);
    add(faces[f][1], faces[f][2], 1);
    add(faces[f][2], faces[f][0], 2);
  }
  constexpr std::ptrdiff_t few = 32;
  std::vector<EdgeSide> run;
  EdgeSide* first = sides.data();
  for (Index v = 0; v < vertices; ++v) {
    EdgeSide* const next = sides.data() + end[v];
    EdgeSide* last = next;
    if (last - first > few) {
      std::sort(first, last, [&](const EdgeSide& a, const EdgeSide& b) {
        return a.upper != b.upper ? a.upper < b.upper : before(a, b);
      });
      for (EdgeSide* stop = first; first != last; first = stop) {
        while (stop != last && stop->upper == first->upper) ++stop;
        if (stop - first == 1)
          visit.single(v, *first);
        else if (stop - first == 2)
          visit.pair(first[0], first[1]);
        else
          visit.cycle(v, std::span<const EdgeSide>(first, stop));
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

}  // namespace plexway
