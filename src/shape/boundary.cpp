#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <vector>

#include "complexes/common/box_tree.hpp"
#include "complexes/common/closest_point.hpp"
#include "complexes/solid/shared_faces.hpp"
#include "shape/boundary.hpp"
#include "shape/shape_state.hpp"

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

namespace {

// Squared, 0 inside.
double squared_distance(const Box<3>& box, const Point& point) {
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double off = std::max({box.low[k] - point[k], point[k] - box.high[k], 0.});
    sum += off * off;
  }
  return sum;
}

// The boundary's triangles in a unit in which squares neither overflow nor underflow.
class Walls {
 public:
  explicit Walls(const io::Tets& solid) : boundary_(boundary_of(solid)) {
    Box<3> all = Box<3>::empty();
    for (const Point& p : boundary_.positions) all.add(p);
    for (std::size_t k = 0; k < 3; ++k) {
      centre_[k] = all.low[k] / 2 + all.high[k] / 2;
      unit_ = std::max(unit_, all.high[k] / 2 - all.low[k] / 2);
    }
    if (unit_ == 0) unit_ = 1;
    for (Point& p : boundary_.positions) p = placed(p);
    std::vector<Box<3>> boxes;
    boxes.reserve(boundary_.triangles.size());
    for (const auto& triangle : boundary_.triangles) {
      boxes.push_back(Box<3>::empty());
      for (const Index v : triangle) boxes.back().add(boundary_.positions[v]);
    }
    tree_ = BoxTree<3>(boxes);
  }

  [[nodiscard]] bool empty() const { return boundary_.triangles.empty(); }

  // Neighbours in the list mostly have the same nearest triangle: it is looked at first.
  [[nodiscard]] double distance(const Point& from) {
    const Point point = placed(from);
    double best = squared_to(nearest_, point);
    tree_.search([&](const Box<3>& box) { return squared_distance(box, point) < best; },
                 [&](Index triangle) {
                   const double found = squared_to(triangle, point);
                   if (!(found < best)) return;
                   best = found;
                   nearest_ = triangle;
                 });
    return std::sqrt(best) * unit_;
  }

 private:
  [[nodiscard]] Point placed(const Point& p) const {
    Point at;
    for (std::size_t k = 0; k < 3; ++k) at[k] = (p[k] - centre_[k]) / unit_;
    return at;
  }
  [[nodiscard]] double squared_to(Index triangle, const Point& point) const {
    std::array<Point, 3> corners;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 3; ++k)
        corners[i][k] = boundary_.positions[boundary_.triangles[triangle][i]][k] - point[k];
    return plexway::squared_distance(corners);
  }

  io::Triangles boundary_;
  Point centre_{};
  double unit_ = 0;
  BoxTree<3> tree_;
  Index nearest_ = 0;
};

// Which vertices the boundary has, and which the solid.
std::vector<char> kinds_of(const io::Tets& solid) {
  std::vector<char> used(solid.positions.size(), 0);
  for (const auto& tet : solid.tets)
    for (const Index v : tet) used[v] = 1;
  for (const Index v : rim_vertices(io::cells_of(solid.tets))) used[v] = 2;
  return used;
}

}  // namespace

std::vector<Index> rim_vertices(const io::Cells& cells) {
  std::vector<std::array<Index, 3>> faces;  // of fewer corners: filled up
  faces.reserve(cells.connectivity.size());
  for (std::size_t first = 0; first < cells.connectivity.size(); first += cells.corners)
    for (std::size_t skip = 0; skip < cells.corners; ++skip) {
      std::array<Index, 3> face = {none, none, none};
      for (std::size_t i = 0, k = 0; i < cells.corners; ++i)
        if (i != skip) face[k++] = cells.connectivity[first + i];
      std::sort(face.begin(), face.end());
      faces.push_back(face);
    }
  std::sort(faces.begin(), faces.end());
  std::vector<Index> rim;
  for (std::size_t f = 0; f < faces.size();) {
    std::size_t end = f + 1;
    while (end < faces.size() && faces[end] == faces[f]) ++end;
    if (end == f + 1)
      std::copy_if(faces[f].begin(), faces[f].end(), std::back_inserter(rim),
                   [](Index v) { return v != none; });
    f = end;
  }
  std::sort(rim.begin(), rim.end());
  rim.erase(std::unique(rim.begin(), rim.end()), rim.end());
  return rim;
}

VertexSource walls_of(const io::Tets& solid) {
  VertexSource source;
  Walls walls(solid);
  if (walls.empty()) return source;
  const std::vector<char> kind = kinds_of(solid);
  for (Index v = 0; v < kind.size(); ++v) {
    if (kind[v] == 0) continue;
    source.vertices.push_back(v);
    source.offsets.push_back(kind[v] == 2 ? 0 : walls.distance(solid.positions[v]));
  }
  return source;
}

VertexSource rim_of(const VertexSource& walls) {
  VertexSource rim{.vertices = {}, .offset = walls.offset};
  for (std::size_t i = 0; i < walls.vertices.size(); ++i)
    if (walls.offsets.empty() || walls.offsets[i] == 0) rim.vertices.push_back(walls.vertices[i]);
  return rim;
}

}  // namespace plexway
