#include "picking.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <variant>

#include <plexway/error.hpp>

#include "complexes/common/geometry.hpp"

namespace plexway::web {
using namespace detail;
namespace {

using Vector = Point3;

Vector along(const Vector& a, const Vector& d, double t) {
  return {a[0] + t * d[0], a[1] + t * d[1], a[2] + t * d[2]};
}
double norm(const Vector& a) { return std::sqrt(dot(a, a)); }

class Ray {
 public:
  Ray(const Drawing& drawing, const Vector& from, const Vector& direction)
      : drawing_(drawing), from_(from), direction_(direction) {}

  [[nodiscard]] Vector place(Index v) const {
    const float* p = drawing_.positions().data() + 3 * std::size_t{v};
    return {p[0], p[1], p[2]};
  }

  // Möller and Trumbore 1997: how far the ray goes to the triangle, and the shares of b and c.
  bool meets(const std::array<Index, 3>& corners, double& t, double& u, double& v) const {
    const Vector a = place(corners[0]), ab = minus(place(corners[1]), a),
                 ac = minus(place(corners[2]), a);
    const Vector p = cross(direction_, ac);
    const double det = dot(ab, p);
    if (det == 0) return false;
    const Vector s = minus(from_, a);
    u = dot(s, p) / det;
    if (!(u >= 0 && u <= 1)) return false;
    const Vector q = cross(s, ab);
    v = dot(direction_, q) / det;
    if (!(v >= 0 && u + v <= 1)) return false;
    t = dot(ac, q) / det;
    return t > 0;
  }

  // How close it passes to a segment: where on the segment, where on the ray.
  double passes(const Vector& a, const Vector& b, double& share, double& t) const {
    const Vector e = minus(b, a), s = minus(from_, a);
    const double ee = dot(e, e), ed = dot(e, direction_), se = dot(s, e), sd = dot(s, direction_);
    const double det = ee - ed * ed;  // the direction has length 1
    share = det > 1e-12 * ee ? (se - ed * sd) / det : 0;
    share = ee > 0 ? std::clamp(share, 0.0, 1.0) : 0;
    const Vector on = along(a, e, share);
    t = dot(minus(on, from_), direction_);
    return norm(minus(on, along(from_, direction_, t)));
  }

 private:
  const Drawing& drawing_;
  Vector from_, direction_;
};

Index nearest_of(const Hit& hit) {
  const auto most = std::max_element(hit.share.begin(), hit.share.end()) - hit.share.begin();
  return hit.vertices[static_cast<std::size_t>(most)];
}

// A point of a simplex by shares of some of its vertices.
PointSource in_simplex(const AnyShape& shape, Index simplex, const Hit& hit) {
  PointSource source{.simplex = simplex};
  const std::span<const Index> corners = shape.corners(simplex);
  for (std::size_t i = 0; i < corners.size() && i < 4; ++i)
    for (std::size_t k = 0; k < 3; ++k)
      if (hit.vertices[k] == corners[i]) source.barycentric[i] += hit.share[k];
  return source;
}

}  // namespace

Hit pick(const AnyShape& shape, const Drawing& drawing, const Vector& from, const Vector& direction,
         double slack) {
  Hit hit;
  const double length = norm(direction);
  if (!(length > 0)) return hit;
  const Vector unit = {direction[0] / length, direction[1] / length, direction[2] / length};
  const Ray ray(drawing, from, unit);
  double nearest = std::numeric_limits<double>::infinity();
  std::size_t triangle = drawing.triangles().size(), edge = drawing.edges().size();
  double t = 0, u = 0, v = 0;
  for (std::size_t k = 0; k < drawing.triangles().size(); ++k)
    if (ray.meets(drawing.triangles()[k], t, u, v) && t < nearest) {
      nearest = t;
      triangle = k;
      hit.vertices = drawing.triangles()[k];
      hit.share = {1 - u - v, u, v};
    }
  for (std::size_t k = 0; k < drawing.edges().size(); ++k) {
    const auto [a, b] = drawing.edges()[k];
    const double away = ray.passes(ray.place(a), ray.place(b), u, t);
    if (!(t > 0 && t < nearest && away <= slack * t)) continue;
    nearest = t;
    edge = k;
    hit.vertices = {a, b, none};
    hit.share = {1 - u, u, 0};
  }
  const bool points = shape.kind() == DomainKind::cloud;
  if (points) {
    // Of the points near the ray the foremost; whoever lies half as far from it again wins.
    double best = std::numeric_limits<double>::infinity();
    for (Index i = 0; i < shape.vertices(); ++i) {
      const Vector p = ray.place(i);
      const double away = ray.passes(p, p, u, t);
      if (!(t > 0 && away <= slack * t)) continue;
      const double cost = t * (1 + slack) + 2 * away;
      if (cost >= best) continue;
      best = cost;
      nearest = t;
      hit.vertices = {i, none, none};
      hit.share = {1, 0, 0};
    }
  }
  if (!(nearest < std::numeric_limits<double>::infinity())) return hit;
  hit.found = true;
  hit.at = along(from, unit, nearest);
  hit.nearest_vertex = nearest_of(hit);
  if (points)
    hit.source = PointSource::at(hit.nearest_vertex);
  else if (edge < drawing.edges().size())
    hit.source = in_simplex(shape, drawing.simplex_of_edge(edge), hit);
  else
    hit.source = in_simplex(shape, drawing.simplex_of_triangle(triangle), hit);
  return hit;
}

double interpolated(const Hit& hit, std::span<const float> values) {
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k)
    if (hit.vertices[k] != none && hit.share[k] > 0)
      sum += hit.share[k] * static_cast<double>(values[hit.vertices[k]]);
  return sum;
}

AnyShape edges_of(const AnyShape& shape) {
  std::vector<std::array<Index, 2>> edges;
  if (const CloudShape* cloud = shape.cloud()) {
    for (Index i = 0; i < shape.vertices(); ++i)
      for (const Index j : cloud->neighbours.around(i))
        edges.push_back({std::min(i, j), std::max(i, j)});
  } else {
    for (std::size_t s = 0; s < shape.simplices(); ++s) {
      const auto corners = shape.corners(s);
      for (std::size_t i = 0; i < corners.size(); ++i)
        for (std::size_t j = i + 1; j < corners.size(); ++j)
          edges.push_back({std::min(corners[i], corners[j]), std::max(corners[i], corners[j])});
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return AnyShape::wireframe({shape.positions().begin(), shape.positions().end()},
                             std::move(edges));
}

std::vector<PointSource> corners_of(const AnyShape& shape, std::span<const PointSource> sources) {
  std::vector<PointSource> starts;
  for (const PointSource& source : sources) {
    if (source.vertex != none) {
      starts.push_back(source);
      continue;
    }
    const Vector at = shape.position(source);
    for (const Index corner : shape.corners(source.simplex)) {
      PointSource start = PointSource::at(corner);
      start.offset = source.offset + norm(minus(shape.positions()[corner], at));
      starts.push_back(start);
    }
  }
  return starts;
}

std::string argument_of(const AnyShape& shape, const PointSource& source) {
  if (source.vertex != none) return "vertex:" + std::to_string(source.vertex);
  const Vector at = shape.position(source);
  char text[120];
  std::snprintf(text, sizeof text, "point:%.9g,%.9g,%.9g", at[0], at[1], at[2]);
  return text;
}

Section section_of(const AnyShape& shape, const Drawing& drawing, const Vector& normal,
                   double offset, std::span<const float> distance) {
  Section section;
  if (shape.dimension() != 3 || shape.positions().empty()) return section;
  const std::vector<float>& positions = drawing.positions();
  const auto height = [&](Index v) {
    const float* p = positions.data() + 3 * std::size_t{v};
    return normal[0] * p[0] + normal[1] * p[1] + normal[2] * p[2] - offset;
  };
  std::array<std::array<float, 4>, 4> corner;
  for (std::size_t s = 0; s < shape.simplices(); ++s) {
    const auto tet = shape.corners(s);
    if (tet.size() != 4) continue;
    std::array<Index, 4> order;
    std::size_t above = 0, below = 0;
    for (const Index v : tet) {
      if (height(v) > 0)
        order[above++] = v;
      else
        order[3 - below++] = v;
    }
    if (above == 0 || below == 0) continue;
    // Three or four edges lead across; with two above they are taken in the order of a loop.
    std::size_t count = 0;
    const auto cross_edge = [&](Index a, Index b) {
      const double ha = height(a), hb = height(b);
      const double share = ha / (ha - hb);
      for (std::size_t i = 0; i < 3; ++i)
        corner[count][i] = static_cast<float>((1 - share) * positions[3 * std::size_t{a} + i] +
                                              share * positions[3 * std::size_t{b} + i]);
      const double d = distance.empty() ? 0
                                        : (1 - share) * static_cast<double>(distance[a]) +
                                              share * static_cast<double>(distance[b]);
      corner[count++][3] =
          std::isnan(d) ? std::numeric_limits<float>::infinity() : static_cast<float>(d);
    };
    if (above == 2) {
      cross_edge(order[0], order[2]);
      cross_edge(order[0], order[3]);
      cross_edge(order[1], order[3]);
      cross_edge(order[1], order[2]);
    } else {
      for (std::size_t a = 0; a < above; ++a)
        for (std::size_t b = above; b < 4; ++b) cross_edge(order[a], order[b]);
    }
    for (std::size_t k = 2; k < count; ++k)
      for (const std::size_t i : {std::size_t{0}, k - 1, k})
        section.numbers.insert(section.numbers.end(), corner[i].begin(), corner[i].end());
  }
  return section;
}

}  // namespace plexway::web
