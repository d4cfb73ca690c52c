#include <algorithm>
#include <cmath>

#include "complexes/common/arrays.hpp"
#include "complexes/solid/shared_faces.hpp"
#include "render/skins.hpp"

namespace plexway::render {
using namespace detail;
namespace {

/// A plane through a tetrahedron: on which edges its corners are, in cyclic order.
struct Cut {
  struct At {
    std::size_t a, b;
    double t;
  };
  std::array<At, 4> at{};
  std::size_t count = 0;
};

// `over` is linear in the tetrahedron; the cut is where it is 0. Corners with 0 are below.
Cut cut(const std::array<double, 4>& over) {
  std::array<std::size_t, 4> above{}, below{};
  std::size_t many_above = 0, many_below = 0;
  for (std::size_t k = 0; k < 4; ++k) (over[k] > 0 ? above[many_above++] : below[many_below++]) = k;
  Cut result;
  const auto add = [&](std::size_t a, std::size_t b) {
    result.at[result.count++] = {a, b, over[a] / (over[a] - over[b])};
  };
  if (many_above == 1)
    for (std::size_t k = 0; k < 3; ++k) add(above[0], below[k]);
  else if (many_above == 3)
    for (std::size_t k = 0; k < 3; ++k) add(below[0], above[k]);
  else if (many_above == 2)
    add(above[0], below[0]), add(above[0], below[1]), add(above[1], below[1]),
        add(above[1], below[0]);
  return result;
}

// The cut where the side above is taken away. A facet in the plane is one if the tetrahedron is
// below it.
Cut cap_of(const std::array<double, 4>& over) {
  const auto below = std::count_if(over.begin(), over.end(), [](double d) { return d < 0; });
  const auto above = std::count_if(over.begin(), over.end(), [](double d) { return d > 0; });
  if (below > 0 && above > 0) return cut(over);
  Cut facet;
  if (below == 1 && above == 0)
    for (std::size_t k = 0; k < 4; ++k)
      if (over[k] == 0) facet.at[facet.count++] = {k, k, 0};
  return facet;
}

void add_polygon(Batch& batch, const Cut& where, const std::array<Vertex, 4>& corners,
                 const std::optional<Plane>& clip) {
  std::array<Vertex, 4> ends;
  for (std::size_t k = 0; k < where.count; ++k)
    ends[k] = between(corners[where.at[k].a], corners[where.at[k].b], where.at[k].t);
  // Wound so that the front is where the normals point.
  const Point n =
      cross(minus(ends[1].position, ends[0].position), minus(ends[2].position, ends[0].position));
  const bool turned = dot(n, ends[0].normal) < 0;
  for (std::size_t k = 2; k < where.count; ++k)
    add_clipped(batch, clip, ends[0], ends[turned ? k : k - 1], ends[turned ? k - 1 : k]);
}

// Values and paints of the corners of a simplex.
void paint_simplex(const Part& part, const Cells* cells, std::span<const std::uint32_t> corners,
                   std::span<Vertex> vertices) {
  bool reached = true;
  for (std::size_t k = 0; k < corners.size() && !part.value.empty(); ++k) {
    vertices[k].value = part.value[corners[k]];
    reached = reached && std::isfinite(vertices[k].value);
  }
  if (cells != nullptr && reached && cells->paint(corners, vertices)) return;
  for (Vertex& corner : vertices) {
    corner.paint = part.value.empty() && cells == nullptr ? plain(part.colour.value_or(part_grey))
                   : reached && cells == nullptr          ? by_value
                                                          : plain(unreached);
    if (!reached) corner.value = 0;
  }
}

// The gradient at each vertex: the mean over its tetrahedra by volume.
std::vector<Point> gradients(const Part& part) {
  std::vector<Point> sum(part.positions.size(), Point{});
  for (const auto& t : part.tets) {
    const Point& p = part.positions[t[0]];
    const Point a = minus(part.positions[t[1]], p), b = minus(part.positions[t[2]], p),
                c = minus(part.positions[t[3]], p);
    const double six_volumes = dot(a, cross(b, c));
    const double da = part.value[t[1]] - part.value[t[0]], db = part.value[t[2]] - part.value[t[0]],
                 dc = part.value[t[3]] - part.value[t[0]];
    const Point g = plus(plus(times(da, cross(b, c)), times(db, cross(c, a))),
                         times(dc, cross(a, b)));  // times six volumes
    if (!std::isfinite(dot(g, g))) continue;
    for (const std::uint32_t v : t) sum[v] = plus(sum[v], times(six_volumes < 0 ? -1 : 1, g));
  }
  for (Point& g : sum) g = unit_or_zero(g);
  return sum;
}

}  // namespace

std::vector<std::array<std::uint32_t, 3>> boundary(
    std::span<const Point> positions, std::span<const std::array<std::uint32_t, 4>> tets,
    const Making& making) {
  const auto in_plane = [&](const std::array<std::uint32_t, 3>& facet) {
    return making.clip && std::all_of(facet.begin(), facet.end(), [&](std::uint32_t v) {
             return making.clip->over(making.frame(positions[v])) == 0;
           });
  };
  auto outer = outer_faces(
      tets.size(), [&](std::size_t t, std::size_t i) { return tets[t][i]; },
      [&](std::size_t t) {
        const auto [a, b, c, d] = tets[t];
        const Point& p = positions[a];
        return !(
            dot(minus(positions[b], p), cross(minus(positions[c], p), minus(positions[d], p))) > 0);
      });
  std::erase_if(outer, in_plane);
  return outer;
}

void add_cap(Batch& batch, const Part& part, const Cells* cells, const Making& making) {
  if (!making.clip) return;
  for (const auto& t : part.tets) {
    std::array<Vertex, 4> v;
    std::array<double, 4> over{};
    for (std::size_t k = 0; k < 4; ++k) {
      v[k].position = making.frame(part.positions[t[k]]);
      over[k] = making.clip->over(v[k].position);
    }
    const Cut where = cap_of(over);
    if (where.count == 0) continue;
    for (Vertex& corner : v) corner.normal = making.clip->normal;
    paint_simplex(part, cells, t, v);
    add_polygon(batch, where, v, std::nullopt);
  }
}

void add_isosurface(Batch& batch, const Part& part, double iso, const Making& making) {
  const std::vector<Point> gradient = gradients(part);
  for (const auto& t : part.tets) {
    std::array<Vertex, 4> v;
    std::array<double, 4> over{};
    bool reached = true;
    for (std::size_t k = 0; k < 4; ++k) {
      over[k] = part.value[t[k]] - iso;
      reached = reached && std::isfinite(over[k]);
    }
    if (!reached) continue;
    const Cut where = cut(over);
    if (where.count == 0) continue;
    for (std::size_t k = 0; k < 4; ++k) {
      v[k].position = making.frame(part.positions[t[k]]);
      v[k].normal = gradient[t[k]];
      v[k].value = part.value[t[k]];
    }
    add_polygon(batch, where, v, making.clip);
  }
}

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
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    std::array<Vertex, 3> v;
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
    }
    paint_simplex(part, cells, triangles[f], v);
    add_clipped(batch, making.clip, v[0], v[1], v[2]);
  }
}

}  // namespace plexway::render
