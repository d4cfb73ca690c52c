#include <algorithm>
#include <map>
#include <utility>

#include <plexway/sampling/centroidal_voronoi.hpp>

namespace plexway {

DualTriangulation dual_triangulation(std::span<const std::array<Index, 3>> faces,
                                     std::span<const Index> vertex_label, std::size_t seeds) {
  DualTriangulation dual;
  std::map<std::pair<Index, Index>, int> sides;  // mesh edges between two cells: faces there
  std::map<std::pair<Index, Index>, bool> ends;  // pairs of cells: does their border reach the rim?
  const auto ordered = [](Index a, Index b) { return std::pair(std::min(a, b), std::max(a, b)); };
  for (const auto& face : faces) {
    std::array<Index, 3> l;
    for (std::size_t i = 0; i < 3; ++i) l[i] = vertex_label[face[i]];
    for (std::size_t i = 0; i < 3; ++i)
      if (l[i] != l[(i + 1) % 3]) ++sides[ordered(face[i], face[(i + 1) % 3])];
    if (l[0] != none && l[1] != none && l[2] != none && l[0] != l[1] && l[1] != l[2] &&
        l[2] != l[0])
      dual.triangles.push_back(l);
  }
  for (const auto& [edge, count] : sides)
    if (count == 1) ends[ordered(vertex_label[edge.first], vertex_label[edge.second])] = true;

  std::vector<bool> irregular(seeds, false);
  std::map<std::pair<Index, Index>, int> edges;
  std::vector<std::vector<std::pair<Index, Index>>> link(seeds);  // edges opposite a seed
  for (const auto& t : dual.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      ++edges[ordered(t[i], t[(i + 1) % 3])];
      link[t[i]].emplace_back(t[(i + 1) % 3], t[(i + 2) % 3]);
    }
  for (const auto& [edge, count] : edges)
    if (count != (ends.count(edge) ? 1 : 2)) irregular[edge.first] = irregular[edge.second] = true;
  for (Index s = 0; s < seeds; ++s) {
    // One fan: from edge to edge around the seed, all are met.
    auto& open = link[s];
    if (open.empty()) {
      irregular[s] = true;
      continue;
    }
    std::map<Index, std::vector<Index>> next;
    for (const auto& [a, b] : open) next[a].push_back(b), next[b].push_back(a);
    std::vector<Index> todo = {open[0].first};
    std::map<Index, bool> seen = {{todo[0], true}};
    while (!todo.empty()) {
      const Index at = todo.back();
      todo.pop_back();
      for (const Index to : next[at])
        if (!std::exchange(seen[to], true)) todo.push_back(to);
    }
    if (seen.size() != next.size()) irregular[s] = true;
  }
  for (Index s = 0; s < seeds; ++s)
    if (irregular[s]) dual.irregular.push_back(s);
  dual.manifold = dual.irregular.empty();
  return dual;
}

}  // namespace plexway
