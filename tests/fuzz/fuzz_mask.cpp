// Masks: what is open is what was not closed, and rows of the wrong size are refused. A byte for
// the number of vertices and one for that of edges, two bytes an edge, then two for each part that
// is closed.

#include <algorithm>
#include <array>
#include <vector>

#include <plexway/common/mask.hpp>

#include "fuzz_reader.hpp"

PLEXWAY_FUZZER(mask)(const std::uint8_t* data, std::size_t size) {
  using plexway::Index;
  if (size < 2) return 0;
  const std::size_t vertices = data[0], count = std::min<std::size_t>(data[1], (size - 2) / 2);
  std::vector<std::array<Index, 2>> edges;
  std::size_t at = 2;
  for (; edges.size() < count; at += 2) edges.push_back({Index{data[at]}, Index{data[at + 1]}});
  plexway::Mask mask(vertices, edges.size());
  std::vector<char> vertex(vertices, 0), edge(edges.size(), 0);
  for (; at + 1 < size; at += 2) {
    const Index number = data[at + 1];
    const bool of_vertex = data[at] % 2 == 0;
    try {
      of_vertex ? mask.close_vertex(number) : mask.close_simplex(number);
      fuzz::require(number < (of_vertex ? vertices : edges.size()), "a number in range");
      (of_vertex ? vertex : edge)[number] = 1;
    } catch (const plexway::UsageError&) {
      fuzz::require(number >= (of_vertex ? vertices : edges.size()), "a number out of range");
    }
  }
  const auto beyond = [&](Index v) { return v >= vertices; };
  const bool sound = std::none_of(edges.begin(), edges.end(), [&](const auto& ends) {
    return beyond(ends[0]) || beyond(ends[1]);
  });
  const std::span<const std::array<Index, 2>> all(edges);
  std::vector<std::size_t> places(edges.size());
  for (std::size_t e = 0; e < edges.size(); ++e) places[e] = e;
  try {
    const auto open = mask.open(all);
    const auto kept = mask.open_rows(all, places);
    const auto numbers = mask.number(all);
    fuzz::require(sound, "ends in range");
    fuzz::require(open.size() == kept.size(), "a row an open edge");
    std::size_t next = 0;
    for (std::size_t e = 0; e < edges.size(); ++e) {
      const bool closed = edge[e] != 0 || vertex[edges[e][0]] != 0 || vertex[edges[e][1]] != 0;
      fuzz::require((numbers[e] == plexway::none) == closed, "closed ones have no number");
      if (closed) continue;
      fuzz::require(numbers[e] == next && kept[next] == e && open[next] == edges[e],
                    "open ones keep their order");
      ++next;
    }
    fuzz::require(next == open.size(), "no others are open");
  } catch (const plexway::UsageError&) {
    fuzz::require(!sound, "edges that the mask should take");
  }
  return 0;
}
