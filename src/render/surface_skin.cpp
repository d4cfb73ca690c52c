#include <algorithm>
#include <cmath>

#include "complexes/common/fill_rows.hpp"
#include "skins.hpp"

namespace plexway::render {
namespace {

constexpr double crease_cosine = 0.574;  // of 55 degrees

// A face's normal, as long as twice its area.
Point area_normal(const Part& part, const std::array<std::uint32_t, 3>& t) {
  const Point& a = part.positions[t[0]];
  return cross(minus(part.positions[t[1]], a), minus(part.positions[t[2]], a));
}

double angle_at(const Part& part, const std::array<std::uint32_t, 3>& t, std::size_t k) {
  const Point& p = part.positions[t[k]];
  const Point a = unit_or_zero(minus(part.positions[t[(k + 1) % 3]], p));
  const Point b = unit_or_zero(minus(part.positions[t[(k + 2) % 3]], p));
  return std::acos(std::clamp(dot(a, b), -1.0, 1.0));
}

// The faces at each vertex, one list after the other.
struct Stars {
  std::vector<std::uint32_t> first, corner;  ///< corner: 3 * face + place

  Stars(std::size_t vertices, std::span<const std::array<std::uint32_t, 3>> triangles) {
    fill_rows(vertices, first, corner, [&](const auto& add) {
      for (std::size_t c = 0; c < 3 * triangles.size(); ++c)
        add(triangles[c / 3][c % 3], static_cast<std::uint32_t>(c));
    });
  }
};

}  // namespace

void add_surface(Batch& batch, const Part& part, const Cells* cells,
                 std::span<const std::array<std::uint32_t, 3>> triangles, const Making& making) {
  const Stars stars(part.positions.size(), triangles);
  std::vector<Point> normals(triangles.size());
  std::vector<std::array<float, 3>> angles(triangles.size());
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    normals[f] = unit_or_zero(area_normal(part, triangles[f]));
    for (std::size_t k = 0; k < 3; ++k)
      angles[f][k] = static_cast<float>(angle_at(part, triangles[f], k));
  }
  batch.corners.reserve(batch.corners.size() + 3 * triangles.size());
  const Paint bare = plain(part.colour.value_or(part_grey));
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    std::array<Vertex, 3> v;
    bool reached = true;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t at = triangles[f][k];
      v[k].position = making.frame(part.positions[at]);
      // Neighbours may wind the other way round: a surface need not be orientable.
      Point sum{};
      for (std::uint32_t s = stars.first[at]; s < stars.first[at + 1]; ++s) {
        const std::uint32_t other = stars.corner[s] / 3;
        const double cosine = dot(normals[f], normals[other]);
        if (std::abs(cosine) < crease_cosine) continue;
        const auto weight = static_cast<double>(angles[other][stars.corner[s] % 3]);
        sum = plus(sum, times(cosine < 0 ? -weight : weight, normals[other]));
      }
      v[k].normal = dot(sum, sum) > 0 ? unit(sum) : normals[f];
      if (part.value.empty()) continue;
      v[k].value = part.value[at];
      reached = reached && std::isfinite(part.value[at]);
    }
    const bool in_cell = cells != nullptr && reached && cells->paint(triangles[f], v);
    if (!in_cell)
      for (Vertex& corner : v) {
        corner.paint = part.value.empty() && cells == nullptr ? bare
                       : reached && cells == nullptr          ? by_value
                                                              : plain(unreached);
        if (!reached) corner.value = 0;
      }
    add_clipped(batch, making.clip, v[0], v[1], v[2]);
  }
}

}  // namespace plexway::render
