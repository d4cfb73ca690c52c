#include "shape/simplex_edges.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>

#include <plexway/error.hpp>

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

// With any number of coordinates, or lengths of their own; where two simplices differ, the lesser.
io::Edges edges_of_simplices(const SimplexShape& shape) {
  const auto corners = static_cast<std::size_t>(shape.dimension) + 1;
  std::map<std::array<std::uint32_t, 2>, double> length;
  for (std::size_t s = 0, next = 0; s < shape.corners.size() / corners; ++s)
    for (std::size_t j = 1; j < corners; ++j)
      for (std::size_t i = 0; i < j; ++i, ++next) {
        const std::uint32_t a = shape.corners[s * corners + i], b = shape.corners[s * corners + j];
        double squared = 0;
        for (std::size_t k = 0; k < shape.axes; ++k) {
          const double d =
              shape.positions[a * shape.axes + k] - shape.positions[b * shape.axes + k];
          squared += d * d;
        }
        const double given = shape.axes > 0 ? std::sqrt(squared) : shape.lengths[next];
        const auto [known, is_new] = length.try_emplace({std::min(a, b), std::max(a, b)}, given);
        if (!is_new) known->second = std::min(known->second, given);
      }
  io::Edges made;
  made.vertices = shape.vertices;
  for (const auto& [ends, of] : length) {
    made.edges.push_back(ends);
    made.lengths.push_back(of);
  }
  return made;
}

io::Edges edges_of_cloud(const CloudShape& cloud) {
  io::Edges made;
  made.positions = cloud.measured();
  made.vertices = made.positions.size();
  for (Index i = 0; i < cloud.neighbours.point_count(); ++i)
    for (const Index j : cloud.neighbours.around(i))
      made.edges.push_back({std::min(i, j), std::max(i, j)});
  sort_out(made.edges);
  return made;
}

}  // namespace

io::Edges edges_of(const AnyShape& shape) {
  if (shape.cloud() != nullptr) return edges_of_cloud(*shape.cloud());
  if (const auto* wireframe = std::get_if<io::Edges>(&shape.data())) return *wireframe;
  if (const auto* simplices = std::get_if<SimplexShape>(&shape.data()))
    return edges_of_simplices(*simplices);
  io::Edges made;
  made.positions.assign(shape.positions().begin(), shape.positions().end());
  made.vertices = shape.vertices();
  for (std::size_t s = 0; s < shape.simplices(); ++s) add_edges(shape.corners(s), made.edges);
  sort_out(made.edges);
  return made;
}

std::vector<double> lengths_of(const io::Edges& wireframe) {
  if (!wireframe.lengths.empty()) return wireframe.lengths;
  if (wireframe.positions.size() != wireframe.vertices)
    throw UsageError("the edges have neither lengths nor positions");
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
