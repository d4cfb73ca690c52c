#include "any/simplex_edges.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace plexway {
namespace {

void add_edges(std::span<const std::uint32_t> corners,
               std::vector<std::array<std::uint32_t, 2>>& edges) {
  for (std::size_t i = 0; i < corners.size(); ++i)
    for (std::size_t j = i + 1; j < corners.size(); ++j)
      if (corners[i] != corners[j])
        edges.push_back({std::min(corners[i], corners[j]), std::max(corners[i], corners[j])});
}

void sort_out(std::vector<std::array<std::uint32_t, 2>>& edges) {
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
}

template <class Simplices>
io::Edges collect(const std::vector<std::array<double, 3>>& positions, const Simplices& simplices) {
  io::Edges made;
  made.positions = positions;
  made.vertices = positions.size();
  for (const auto& corners : simplices) add_edges(corners, made.edges);
  sort_out(made.edges);
  return made;
}

}  // namespace

io::Edges edges_of(const io::Triangles& surface) {
  return collect(surface.positions, surface.triangles);
}

io::Edges edges_of(const io::Tets& solid) { return collect(solid.positions, solid.tets); }

io::Edges edges_of(const CloudShape& cloud) {
  io::Edges made;
  made.positions = cloud.measured();
  made.vertices = made.positions.size();
  for (Index i = 0; i < cloud.neighbours.point_count(); ++i)
    for (const Index j : cloud.neighbours.around(i))
      made.edges.push_back({std::min(i, j), std::max(i, j)});
  sort_out(made.edges);
  return made;
}

io::Edges edges_of(const AnyShape& shape) {
  if (shape.cloud() != nullptr) return edges_of(*shape.cloud());
  if (const auto* wireframe = std::get_if<io::Edges>(&shape.data())) return *wireframe;
  io::Edges made;
  made.positions.assign(shape.positions().begin(), shape.positions().end());
  made.vertices = shape.vertices();
  for (std::size_t s = 0; s < shape.simplices(); ++s) add_edges(shape.corners(s), made.edges);
  sort_out(made.edges);
  return made;
}

std::vector<double> lengths_of(const io::Edges& wireframe) {
  if (!wireframe.lengths.empty()) return wireframe.lengths;
  std::vector<double> lengths;
  lengths.reserve(wireframe.edges.size());
  for (const auto& [from, to] : wireframe.edges) {
    const auto& a = wireframe.positions[from];
    const auto& b = wireframe.positions[to];
    lengths.push_back(std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]));
  }
  return lengths;
}

}  // namespace plexway
