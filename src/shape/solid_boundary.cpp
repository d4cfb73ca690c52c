#include "shape/solid_boundary.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace plexway {
namespace {

using Point = std::array<double, 3>;
using Row = std::array<std::uint32_t, 3>;

bool inside_out(std::span<const Point> positions, const std::array<std::uint32_t, 4>& tet) {
  std::array<Point, 3> e;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) e[i][k] = positions[tet[i + 1]][k] - positions[tet[0]][k];
  return e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) +
             e[0][1] * (e[1][2] * e[2][0] - e[1][0] * e[2][2]) +
             e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]) <
         0;
}

}  // namespace

std::vector<Row> boundary_faces(std::span<const Point> positions,
                                std::span<const std::array<std::uint32_t, 4>> tets) {
  std::vector<std::pair<Row, Row>> faces;  // sorted, as it is
  faces.reserve(4 * tets.size());
  constexpr std::array<std::array<std::size_t, 3>, 4> outward = {
      {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
  for (const auto& tet : tets) {
    const bool turned = inside_out(positions, tet);
    for (const auto& [i, j, k] : outward) {
      const Row row = {tet[i], tet[turned ? k : j], tet[turned ? j : k]};
      Row sorted = row;
      std::sort(sorted.begin(), sorted.end());
      faces.emplace_back(sorted, row);
    }
  }
  std::sort(faces.begin(), faces.end());
  std::vector<Row> outer;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    if (f + 1 < faces.size() && faces[f].first == faces[f + 1].first) {
      ++f;
      continue;
    }
    outer.push_back(faces[f].second);
  }
  return outer;
}

io::Triangles boundary_of(const io::Tets& solid) {
  io::Triangles surface;
  surface.triangles = boundary_faces(solid.positions, solid.tets);
  std::vector<char> used(solid.positions.size(), 0);
  for (const Row& face : surface.triangles)
    for (const std::uint32_t v : face) used[v] = 1;
  std::vector<std::uint32_t> number(solid.positions.size());
  for (std::size_t v = 0; v < used.size(); ++v) {
    if (used[v] == 0) continue;
    number[v] = static_cast<std::uint32_t>(surface.positions.size());
    surface.positions.push_back(solid.positions[v]);
  }
  for (Row& t : surface.triangles)
    for (std::uint32_t& v : t) v = number[v];
  return surface;
}

}  // namespace plexway
