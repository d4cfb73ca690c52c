#include "shape/solid_boundary.hpp"

#include <array>
#include <cstddef>
#include <limits>
#include <vector>

#include "complexes/solid/shared_faces.hpp"

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
  return outer_faces(
      tets.size(), [&](std::size_t t, std::size_t i) { return tets[t][i]; },
      [&](std::size_t t) { return inside_out(positions, tets[t]); });
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
