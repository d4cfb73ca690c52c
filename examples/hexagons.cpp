// A map of hexagons, a domain that the library does not know (hexagons.hpp): how far is each from a
// camp, if hills cost more? By one thread and by a team, from one hexagon and from several.
#include <cmath>
#include <cstdio>
#include <queue>
#include <utility>

#include "hexagons.hpp"

constexpr plexway::Index width = 300, height = 200;

// Steps uphill take longer.
double height_of(plexway::Index v) {
  return std::sin(.1 * (v % width)) * std::cos(.07 * (v / width));
}
double cost(plexway::Index a, plexway::Index b) {
  return 1 + 4 * std::abs(height_of(a) - height_of(b));
}

// Dijkstra's distances, to compare with.
std::vector<double> by_hand(const examples::HexagonMap<double>& map, plexway::Index source) {
  std::vector<std::vector<std::pair<plexway::Index, double>>> next(map.vertex_count());
  for (const auto& [a, b] : map.steps()) {
    next[a].emplace_back(b, cost(a, b));
    next[b].emplace_back(a, cost(a, b));
  }
  std::vector<double> distance(map.vertex_count(), INFINITY);
  using Entry = std::pair<double, plexway::Index>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  for (queue.emplace(distance[source] = 0, source); !queue.empty();) {
    const auto [d, v] = queue.top();
    queue.pop();
    for (const auto& [w, step] : next[v])
      if (d <= distance[v] && d + step < distance[w]) queue.emplace(distance[w] = d + step, w);
  }
  return distance;
}

int main() {
  const examples::HexagonMap<double> map(width, height, cost);
  const plexway::Index camp = map.at(20, 30), village = map.at(250, 150);
  const auto from_camp = by_hand(map, camp), from_village = by_hand(map, village);
  const auto one = plexway::solve(plexway::Serial{}, map, plexway::PointSource::at(camp));
  const plexway::VertexSource both{.vertices = {camp, village}};
  const auto nearest = plexway::solve(plexway::OpenMP{.threads = 2}, map, both);
  double worst = 0;
  for (plexway::Index v = 0; v < map.vertex_count(); ++v) {
    worst = std::max(worst, std::abs(one.distance[v] - from_camp[v]));
    worst =
        std::max(worst, std::abs(nearest.distance[v] - std::min(from_camp[v], from_village[v])));
  }
  std::printf("%zu hexagons, %zu steps; from the camp to the village %.1f; worst error %.1e\n",
              map.vertex_count(), map.simplex_count(), one.distance[village], worst);
  return worst < 1e-9 ? 0 : 1;
}
