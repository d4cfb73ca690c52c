#include "drawing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

#include <plexway/shape/support.hpp>

namespace plexway::web {

Drawing::Drawing(const AnyShape& shape) {
  const auto positions = shape.positions();
  support(Purpose::pictures, shape).require();
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::array<double, 3> low = {infinity, infinity, infinity},
                        high = {-infinity, -infinity, -infinity};
  for (const auto& p : positions)
    for (std::size_t i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], p[i]);
      high[i] = std::max(high[i], p[i]);
    }
  for (std::size_t i = 0; i < 3; ++i) centre_[i] = (low[i] + high[i]) / 2;
  size_ = std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
  positions_.reserve(3 * positions.size());
  for (const auto& p : positions)
    for (const double c : placed(p)) positions_.push_back(static_cast<float>(c));

  const auto take = [](auto& list, auto& owner, const auto& from, Index& simplex) {
    for (const auto& corners : from) {
      list.push_back(corners);
      owner.push_back(simplex++);
    }
  };
  Index simplex = 0;
  if (const auto* surface = std::get_if<io::Triangles>(&shape.data())) {
    take(triangles_, triangle_simplex_, surface->triangles, simplex);
  } else if (const auto* solid = std::get_if<io::Tets>(&shape.data())) {
    add_boundary(solid->tets, 0);
  } else if (const auto* wires = std::get_if<io::Edges>(&shape.data())) {
    take(edges_, edge_simplex_, wires->edges, simplex);
  } else if (const auto* mixed = std::get_if<MixedShape>(&shape.data())) {
    for (const MixedShape::Part& part : mixed->parts) {
      take(edges_, edge_simplex_, part.edges, simplex);
      take(triangles_, triangle_simplex_, part.triangles, simplex);
      add_boundary(part.tets, simplex);
      simplex += static_cast<Index>(part.tets.size());
    }
  }
}

std::pair<const void*, std::size_t> Drawing::array(int which) const {
  switch (which) {
    case 0:
      return {positions_.data(), positions_.size()};
    case 1:
      return {triangles_.data(), 3 * triangles_.size()};
    case 2:
      return {edges_.data(), 2 * edges_.size()};
    default:
      return {nullptr, 0};
  }
}

void Drawing::add_boundary(const std::vector<std::array<Index, 4>>& tets, Index first_simplex) {
  struct Face {
    std::array<Index, 3> key;
    Index tet;
    std::uint8_t opposite;
    bool operator<(const Face& other) const { return key < other.key; }
  };
  std::vector<Face> faces;
  faces.reserve(4 * tets.size());
  for (std::size_t t = 0; t < tets.size(); ++t)
    for (std::uint8_t i = 0; i < 4; ++i) {
      std::array<Index, 3> key = {tets[t][(i + 1) % 4], tets[t][(i + 2) % 4], tets[t][(i + 3) % 4]};
      std::sort(key.begin(), key.end());
      faces.push_back({key, static_cast<Index>(t), i});
    }
  std::sort(faces.begin(), faces.end());
  for (std::size_t f = 0; f < faces.size();) {
    std::size_t end = f + 1;
    while (end < faces.size() && faces[end].key == faces[f].key) ++end;
    if (end == f + 1) {
      triangles_.push_back(faces[f].key);
      triangle_simplex_.push_back(first_simplex + faces[f].tet);
    }
    f = end;
  }
}

}  // namespace plexway::web
