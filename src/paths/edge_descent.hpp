#pragma once

#include <algorithm>
#include <queue>
#include <unordered_map>
#include <utility>
#include <vector>

#include <plexway/common/ids.hpp>

#include "paths/infinity.hpp"

namespace plexway::detail {

/// A way along edges from a vertex to a source, over falling distances.
///
///   distance(v)         the field's, +inf where unreached
///   end(v)              what is left to walk where a source is in a simplex at v, else +inf
///   edges(v, visit)     calls visit(w, length)
///
/// Distances fall along it, so it ends. Where they should not fall any more before a source
/// (distances of an approximate field may have a dent), Dijkstra's algorithm on edges takes over;
/// each vertex is settled once. Empty if no source can be reached by edges. Cost: the path's edges;
/// at worst those of the whole domain.
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

}  // namespace plexway::detail
