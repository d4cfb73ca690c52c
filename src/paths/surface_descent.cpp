#include <algorithm>
#include <functional>
#include <queue>
#include <unordered_map>
#include <utility>
#include <vector>

#include <plexway/common/ids.hpp>

#include "complexes/common/number_range.hpp"
#include "paths/surface_trace.hpp"

namespace plexway::detail {

namespace {

// A way along edges from a vertex to a source, over falling distances.
//
//   distance(v)         the field's, +inf where unreached
//   end(v)              what is left to walk where a source is in a simplex at v, else +inf
//   edges(v, visit)     calls visit(w, length)
//
// Distances fall along it, so it ends. Where they should not fall any more before a source
// (distances of an approximate field may have a dent), Dijkstra's algorithm on edges takes over;
// each vertex is settled once. Empty if no source can be reached by edges. Cost: the path's edges;
// at worst those of the whole domain.
template <class Distance, class End, class Edges>
std::vector<Index> descend_edges(Index from, Distance distance, End end, Edges edges) {
  std::vector<Index> way = {from};
  // Vertices that edges without length join are as good as one: (vertex, where it was seen from).
  std::vector<std::pair<Index, std::size_t>> level;
  for (;;) {
    const double here = distance(way.back());
    level.assign(1, {way.back(), 0});
    double best = infinity;
    std::size_t leaves_at = 0;
    Index next = none;
    for (std::size_t k = 0; k < level.size(); ++k) {
      const Index v = level[k].first;
      if (const double left = end(v); left < best) best = left, next = none, leaves_at = k;
      edges(v, [&](Index w, double length) {
        if (distance(w) < here) {
          if (distance(w) + length < best) best = distance(w) + length, next = w, leaves_at = k;
        } else if (length == 0 && distance(w) == here &&
                   std::none_of(level.begin(), level.end(),
                                [&](const auto& known) { return known.first == w; })) {
          level.emplace_back(w, k);
        }
      });
    }
    if (!(best < infinity)) break;
    std::vector<Index> along;
    for (std::size_t k = leaves_at; k != 0; k = level[k].second) along.push_back(level[k].first);
    way.insert(way.end(), along.rbegin(), along.rend());
    if (next == none) return way;
    way.push_back(next);
  }
  struct Seen {
    double walked;
    Index before;
    bool done;
  };
  const Index begin = way.back();
  std::unordered_map<Index, Seen> seen;
  std::priority_queue<std::pair<double, Index>, std::vector<std::pair<double, Index>>,
                      std::greater<>>
      queue;
  seen[begin] = {0, none, false};
  queue.emplace(0, begin);
  Index found = none;
  while (!queue.empty() && found == none) {
    const double walked = queue.top().first;
    const Index v = queue.top().second;
    queue.pop();
    Seen& at = seen[v];
    if (at.done) continue;
    at.done = true;
    if (end(v) < infinity) {
      found = v;
      break;
    }
    edges(v, [&](Index w, double length) {
      const auto [place, fresh] = seen.try_emplace(w, Seen{infinity, none, false});
      if (place->second.done || !(walked + length < place->second.walked)) return;
      place->second.walked = walked + length;
      place->second.before = v;
      queue.emplace(walked + length, w);
    });
  }
  if (found == none) return {};
  std::vector<Index> rest;
  for (Index v = found; v != begin; v = seen[v].before) rest.push_back(v);
  way.insert(way.end(), rest.rbegin(), rest.rend());
  return way;
}

}  // namespace

/// A triangle with the edge (v, w), and the direction of w at v.
template <class Real>
std::optional<Heading> SurfaceTrace<Real>::side(Index v, Index w) const {
  std::vector<Index> corners;
  mesh_.corners_at(v, corners);
  std::optional<Heading> found;
  double shortest = infinity;
  for (const Index c : corners) {
    const Index f = c / 3;
    const std::size_t i = c % 3;
    for (const bool after : {true, false}) {
      if (mesh_.triangles()[f].corner[after ? edge_after(i) : edge_before(i)] != w) continue;
      const double length = shape_.length(f, after ? i : edge_before(i));
      if (!(length < shortest)) continue;
      shortest = length;
      found = Heading{f, i, after ? 0. : shape_.angle(f, i)};
    }
  }
  return found;
}

/// Along edges: down the distances, or, blindly, the shortest way there is.
template <class Real>
bool SurfaceTrace<Real>::descend(Index f, const std::array<double, 3>& b, bool blindly,
                                 StripWay& way) const {
  const auto triangles = mesh_.triangles();
  // Where sources are: a vertex, or a triangle at a vertex.
  struct End {
    double left = infinity;
    Index number = none, corner = none;  // corner: 3 f + i of its triangle, or none
  };
  std::unordered_map<Index, End> ends;
  for (std::size_t n = 0; n < solved_.sources.size(); ++n) {
    const PointSource& s = solved_.sources[n];
    const auto offer = [&](Index v, const End& end) {
      End& known = ends[v];
      if (end.left < known.left) known = end;
    };
    if (s.vertex != none) {
      offer(mesh_.inside_vertex(s.vertex), {s.offset, static_cast<Index>(n), none});
      continue;
    }
    const auto [face, turned] = mesh_.inside_face(s.simplex);
    const std::array<double, 3> at = inside(s.barycentric, turned);
    for (std::size_t i = 0; i < 3; ++i)
      offer(triangles[face].corner[i], {s.offset + shape_.distance(face, at_corner(i), at),
                                        static_cast<Index>(n), 3 * face + static_cast<Index>(i)});
  }
  const auto falling = [&](Index v) { return distance(v); };
  const auto end = [&](Index v) {
    const auto found = ends.find(v);
    return found == ends.end() ? infinity : found->second.left;
  };
  std::vector<Index> corners;
  const auto edges = [&](Index v, auto visit) {
    mesh_.corners_at(v, corners);
    for (const Index c : corners) {
      const std::size_t i = c % 3;
      visit(triangles[c / 3].corner[edge_after(i)], shape_.length(c / 3, i));
      visit(triangles[c / 3].corner[edge_before(i)], shape_.length(c / 3, edge_before(i)));
    }
  };
  // From the corner with the shortest way.
  std::size_t first = corner_of(b);
  for (std::size_t i = 0; i < 3 && corner_of(b) == 3; ++i) {
    const auto by = [&](std::size_t k) {
      return distance(triangles[f].corner[k]) + shape_.distance(f, at_corner(k), b);
    };
    if (first == 3 || by(i) < by(first)) first = i;
  }
  const std::vector<Index> vertices =
      blindly ? descend_edges(
                    triangles[f].corner[first], [](Index) { return infinity; }, end, edges)
              : descend_edges(triangles[f].corner[first], falling, end, edges);
  if (vertices.empty()) return false;

  Strip leg;
  leg.first = f;
  leg.start = b;
  const bool at_vertex = corner_of(b) < 3;
  Heading at{f, first, at_vertex ? 0 : shape_.angle_to(f, first, b)};
  bool begun = !at_vertex;  // does the leg have a direction to turn from?
  const auto turn_to = [&](const Heading& to) {
    if (begun) {
      strips_.add(way, leg, at, to);
    } else {
      leg.first = to.face;
      leg.start = at_corner(to.corner);
      at = to;
    }
    begun = true;
  };
  for (std::size_t k = 0; k + 1 < vertices.size(); ++k) {
    const auto out = side(vertices[k], vertices[k + 1]);
    if (!out) return false;
    turn_to(*out);
    // Along the edge to its other end, and the direction back.
    const bool after =
        triangles[out->face].corner[edge_after(out->corner)] == vertices[k + 1] && out->angle == 0;
    const std::size_t there = after ? edge_after(out->corner) : edge_before(out->corner);
    at = {out->face, there, after ? shape_.angle(out->face, there) : 0};
  }
  const End& last = ends.at(vertices.back());
  if (last.corner == none) {
    leg.end = at_corner(at.corner);
  } else {
    const Index face = last.corner / 3;
    const bool turned = mesh_.inside_face(solved_.sources[last.number].simplex).second;
    leg.end = inside(solved_.sources[last.number].barycentric, turned);
    const std::array<double, 3> target = leg.end;
    turn_to({face, last.corner % 3, shape_.angle_to(face, last.corner % 3, target)});
    leg.end = target;
  }
  way.legs.push_back(std::move(leg));
  way.source = last.number;
  return true;
}

template bool SurfaceTrace<float>::descend(Index, const std::array<double, 3>&, bool,
                                           StripWay&) const;
template bool SurfaceTrace<double>::descend(Index, const std::array<double, 3>&, bool,
                                            StripWay&) const;

}  // namespace plexway::detail
