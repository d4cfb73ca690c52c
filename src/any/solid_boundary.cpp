#include "any/solid_boundary.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace plexway {
namespace {

using Point = std::array<double, 3>;

bool inside_out(const io::Tets& solid, const std::array<std::uint32_t, 4>& tet) {
  std::array<Point, 3> e;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k)
      e[i][k] = solid.positions[tet[i + 1]][k] - solid.positions[tet[0]][k];
  return e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) +
             e[0][1] * (e[1][2] * e[2][0] - e[1][0] * e[2][2]) +
             e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]) <
         0;
}

}  // namespace

io::Triangles boundary_of(const io::Tets& solid) {
  using Row = std::array<std::uint32_t, 3>;
  std::vector<std::pair<Row, Row>> faces;  // sorted, as it is
  faces.reserve(4 * solid.tets.size());
  constexpr std::array<std::array<std::size_t, 3>, 4> outward = {
      {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
  for (const auto& tet : solid.tets) {
    const bool turned = inside_out(solid, tet);
    for (const auto& [i, j, k] : outward) {
      const Row row = {tet[i], tet[turned ? k : j], tet[turned ? j : k]};
      Row sorted = row;
      std::sort(sorted.begin(), sorted.end());
      faces.emplace_back(sorted, row);
    }
  }
  std::sort(faces.begin(), faces.end());
  io::Triangles surface;
  std::vector<char> used(solid.positions.size(), 0);
  for (std::size_t f = 0; f < faces.size(); ++f) {
    if (f + 1 < faces.size() && faces[f].first == faces[f + 1].first) {
      ++f;
      continue;
    }
    surface.triangles.push_back(faces[f].second);
    for (const std::uint32_t v : faces[f].second) used[v] = 1;
  }
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
