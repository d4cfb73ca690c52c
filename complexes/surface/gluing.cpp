#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <plexway/error.hpp>

#include "complexes/common/disjoint_sets.hpp"
#include "complexes/surface/face_layout.hpp"
#include "complexes/surface/gluing.hpp"

namespace plexway::detail {

namespace {

Index next_corner(Index corner) { return corner == 2 ? 0 : corner + 1; }

}  // namespace

Gluing glue_by_vertices(std::size_t vertices, Faces faces) {
  Gluing across(faces.size());
  const auto number = [](const EdgeSide& s) {
    return 3 * (s.halfedge >> Across::face_shift) + (s.halfedge & Across::edge_mask);
  };
  struct Glue {
    Gluing& across;
    const decltype(number)& name;
    void set(const EdgeSide& from, Index to) const {
      across[from.halfedge >> Across::face_shift][from.halfedge & Across::edge_mask] = to;
    }
    void single(Index, const EdgeSide& s) const { set(s, none); }
    void pair(const EdgeSide& a, const EdgeSide& b) const {
      set(a, name(b));
      set(b, name(a));
    }
    void cycle(Index, std::span<const EdgeSide> sides) const {
      for (std::size_t k = 0; k < sides.size(); ++k)
        set(sides[k], name(sides[k + 1 == sides.size() ? 0 : k + 1]));
    }
    void take(const Glue&) const {}
  };
  Glue glue{across, number};
  match_edges(
      vertices, faces, {}, 1,
      [&](const EdgeSide& a, const EdgeSide& b) { return number(a) < number(b); }, glue);
  return across;
}

void check_gluing(Faces faces, std::span<const std::array<Index, 3>> across) {
  const std::size_t halfedges = faces.size() * 3;
  std::vector<char> entered(halfedges, 0);
  for (std::size_t h = 0; h < halfedges; ++h) {
    const Index to = across[h / 3][h % 3];
    if (to == none) continue;
    const std::string where = "face " + std::to_string(h / 3) + ", edge " + std::to_string(h % 3);
    if (to >= halfedges) throw InputError(where + ": glued to a halfedge that does not exist");
    if (to == h) throw InputError(where + ": glued to itself");
    if (entered[to]++) throw InputError(where + ": its other side is glued twice");
    const auto& a = faces[h / 3];
    const auto& b = faces[to / 3];
    const auto p = std::minmax(a[h % 3], a[next_corner(static_cast<Index>(h % 3))]);
    const auto q = std::minmax(b[to % 3], b[next_corner(to % 3)]);
    if (p != q) throw InputError(where + ": glued to an edge with other vertices");
  }
  for (std::size_t h = 0; h < halfedges; ++h)
    if ((across[h / 3][h % 3] != none) != (entered[h] != 0))
      throw InputError("face " + std::to_string(h / 3) + ", edge " + std::to_string(h % 3) +
                       ": glued from one side only");
}

namespace {

// How many corners a walk from one of them meets. Where no sheet turns over it is a loop of four
// lookups a corner.
Index fan_size(const FaceLayout& layout, Index start) {
  Index found = 0;
  if (layout.flips) {
    walk_fan(
        static_cast<Index>(layout.face_count()),
        [&](Index f, Index edge) { return layout.across[f][edge]; }, start,
        [&](Index) { ++found; });
    return found;
  }
  const Index end = static_cast<Index>(layout.face_count()) << Across::face_shift;
  const Index first_face = start / 3, first_edge = start % 3;
  const Index first = first_face << Across::face_shift | first_edge;
  const auto over = [&](Index face, std::size_t edge) { return layout.across[face][edge]; };
  const auto crosses = [&](Index o) { return o < end && (o & Across::fan) == 0; };
  found = 1;
  Index o = over(first_face, first_edge);
  while (crosses(o)) {  // its end is the vertex: on by the edge after
    const std::size_t edge = edge_after(o & Across::edge_mask);
    const Index face = o >> Across::face_shift;
    if ((face << Across::face_shift | edge) == first) return found;
    ++found;
    o = over(face, edge);
  }
  o = over(first_face, edge_before(first_edge));
  while (crosses(o)) {  // its start is the vertex: on by the edge before
    if ((o & ~Across::special) == first) return found;
    ++found;
    o = over(o >> Across::face_shift, edge_before(o & Across::edge_mask));
  }
  return found;
}

}  // namespace

VertexFans find_vertex_fans(const FaceLayout& layout, int threads) {
  const std::size_t faces = layout.face_count(), vertices = layout.vertex_count();
  const Index end = static_cast<Index>(faces) << Across::face_shift;
  VertexFans fans;
  fans.corner.assign(vertices, none);
  fans.on_boundary.assign(vertices, 0);
  std::vector<Index> corners(vertices, 0), lowest(vertices, none);
  struct Corner {
    Index face, lowest;
    unsigned char corner, on_boundary;
  };
  tell_vertices<Corner>(
      layout.first_use, faces, threads,
      [&](std::size_t first, std::size_t last, const auto& tell) {
        for (std::size_t f = first; f < last; ++f) {
          const auto& [a, b, c] = layout.corner[f];
          const Index least = std::min({a, b, c});
          for (std::size_t i = 0; i < 3; ++i)
            tell(layout.corner[f][i],
                 Corner{static_cast<Index>(f), least, static_cast<unsigned char>(i),
                        layout.across[f][i] >= end || layout.across[f][edge_before(i)] >= end});
        }
      },
      [&](Index v, const Corner& c) {
        ++corners[v];
        fans.on_boundary[v] = static_cast<char>(fans.on_boundary[v] | c.on_boundary);
        lowest[v] = std::min(lowest[v], c.lowest);
        // The last one in the first face.
        if (fans.corner[v] >= 3 * c.face) fans.corner[v] = 3 * c.face + c.corner;
      });
  gather_blocks<std::vector<Index>>(
      layout.named, threads,
      [&](std::size_t first, std::size_t last, std::vector<Index>& irregular) {
        for (Index v = static_cast<Index>(first); v < last; ++v)
          if (fan_size(layout, fans.corner[v]) != corners[v]) irregular.push_back(v);
      },
      [&](const std::vector<Index>& irregular) {
        fans.irregular.insert(fans.irregular.end(), irregular.begin(), irregular.end());
      });
  std::sort(fans.irregular.begin(), fans.irregular.end());
  std::vector<Index> row;
  if (!fans.irregular.empty()) row.assign(vertices, none);
  for (std::size_t r = 0; r < fans.irregular.size(); ++r)
    row[fans.irregular[r]] = static_cast<Index>(r);
  fans.components = count_components<3>(layout.corner, lowest, threads);

  fans.irregular_begin.assign(fans.irregular.size() + 1, 0);
  for (std::size_t r = 0; r < fans.irregular.size(); ++r)
    fans.irregular_begin[r + 1] = fans.irregular_begin[r] + corners[fans.irregular[r]];
  if (fans.irregular.empty()) return fans;
  fans.irregular_corners.resize(fans.irregular_begin.back());
  std::vector<Index> cursor(fans.irregular_begin.begin(), fans.irregular_begin.end() - 1);
  for (Index f = 0; f < faces; ++f)
    for (Index i = 0; i < 3; ++i)
      if (const Index r = row[layout.corner[f][i]]; r != none)
        fans.irregular_corners[cursor[r]++] = 3 * f + i;

  // Pinched: the corners fall into several sets when joined over all edges at the vertex, fans too.
  for (std::size_t r = 0; r < fans.irregular.size(); ++r) {
    const auto first = fans.irregular_corners.begin() + fans.irregular_begin[r];
    const auto last = fans.irregular_corners.begin() + fans.irregular_begin[r + 1];
    const auto place = [&](Index corner) {
      return static_cast<Index>(std::lower_bound(first, last, corner) - first);
    };
    DisjointSets sheets(static_cast<std::size_t>(last - first));
    Index count = static_cast<Index>(last - first);
    for (auto c = first; c != last; ++c) {
      const Index f = *c / 3, i = *c % 3;
      for (const bool by_start : {true, false}) {
        const Index across = layout.across[f][by_start ? i : (i == 0 ? 2 : i - 1)];
        const Index g = across >> Across::face_shift, j = across & Across::edge_mask;
        if (g == faces) continue;
        const bool at_start = by_start == ((across & Across::flip) != 0);
        const Index here = place(*c), there = place(3 * g + (at_start ? j : (j == 2 ? 0 : j + 1)));
        count -= sheets.find(here) != sheets.find(there);
        sheets.unite(here, there);
      }
    }
    if (count > 1) fans.pinched.push_back(fans.irregular[r]);
  }
  return fans;
}

template <class Real>
bool is_open_book(std::span<const TriangleRecord<Real>> triangles, std::span<const Index> corners) {
  const Index sentinel = static_cast<Index>(triangles.size() - 1);
  constexpr double rounding = 1e-5;
  std::size_t pages = 0, rims = 0;
  std::vector<Index> spine;  // what lies across the edges on it
  std::vector<char> seen(corners.size(), 0);
  for (std::size_t c = 0; c < corners.size(); ++c) {
    if (seen[c]) continue;
    ++pages;
    double angle = 0;
    std::size_t ends = 0, rim = 0;
    walk_fan(triangles, corners[c], [&](Index corner) {
      seen[static_cast<std::size_t>(std::lower_bound(corners.begin(), corners.end(), corner) -
                                    corners.begin())] = 1;
      const TriangleRecord<Real>& t = triangles[corner / 3];
      const std::size_t i = corner % 3;
      angle += std::atan2(static_cast<double>(t.sine(i)), static_cast<double>(t.cosine[i]));
      for (const std::size_t edge : {i, edge_before(i)}) {
        const Index across = t.across[edge];
        if (across >> Across::face_shift == sentinel)
          ++ends, ++rim;
        else if (across & Across::fan)
          ++ends, spine.push_back(across);
      }
    });
    if (ends != 2 || rim > 1 || angle > std::numbers::pi / (rim == 1 ? 2 : 1) + rounding)
      return false;
    rims += rim;
  }
  if (rims != 0 && rims != pages) return false;
  // Each edge of the spine joins all pages. One walk around an edge is all that its pages need.
  for (Index& across : spine) across &= ~Across::special;
  std::sort(spine.begin(), spine.end());
  std::vector<char> walked(spine.size(), 0);
  for (std::size_t n = 0; n < spine.size(); ++n) {
    if (walked[n]) continue;
    std::size_t joined = 0;
    Index across = spine[n];
    do {
      ++joined;
      const auto at = std::lower_bound(spine.begin(), spine.end(), across);
      if (at != spine.end() && *at == across)
        walked[static_cast<std::size_t>(at - spine.begin())] = 1;
      across = triangles[across >> Across::face_shift].across[across & Across::edge_mask] &
               ~Across::special;
    } while (joined <= pages && across != spine[n]);
    if (joined != pages) return false;
  }
  return !spine.empty();
}

template bool is_open_book(std::span<const TriangleRecord<float>>, std::span<const Index>);
template bool is_open_book(std::span<const TriangleRecord<double>>, std::span<const Index>);

}  // namespace plexway::detail
