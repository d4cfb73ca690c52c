#include "closest_point.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plexway::cli {
namespace {

using Vector = std::array<double, 3>;

Vector minus(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

struct Candidate {
  double squared_distance = std::numeric_limits<double>::infinity();
  Vector barycentric = {1, 0, 0};
};

// The point of the edge from corner i to corner j that is closest to the origin.
Candidate closest_on_edge(const std::array<Vector, 3>& corners, std::size_t i, std::size_t j) {
  const Vector along = minus(corners[j], corners[i]);
  const double length2 = dot(along, along);
  const double t = length2 > 0 ? std::clamp(-dot(corners[i], along) / length2, 0.0, 1.0) : 0.0;
  Candidate found;
  found.barycentric = {0, 0, 0};
  found.barycentric[i] = 1 - t;
  found.barycentric[j] = t;
  Vector at = corners[i];
  for (std::size_t k = 0; k < 3; ++k) at[k] += t * along[k];
  if (t == 1) at = corners[j];
  found.squared_distance = dot(at, at);
  return found;
}

// The point of the triangle that is closest to the origin: the foot of the perpendicular where it
// lies inside, else the best of the three edges. A triangle without area has only edges.
Candidate closest_on_triangle(const std::array<Vector, 3>& corners) {
  const Vector normal = cross(minus(corners[1], corners[0]), minus(corners[2], corners[0]));
  const double normal2 = dot(normal, normal);
  if (normal2 > 0) {
    Vector weight;
    for (std::size_t i = 0; i < 3; ++i)
      weight[i] = dot(cross(corners[(i + 1) % 3], corners[(i + 2) % 3]), normal);
    const double sum = weight[0] + weight[1] + weight[2];
    const bool inside = weight[0] >= 0 && weight[1] >= 0 && weight[2] >= 0 && sum > 0;
    if (inside) {
      const double height = dot(corners[0], normal);
      return {height * height / normal2, {weight[0] / sum, weight[1] / sum, weight[2] / sum}};
    }
  }
  Candidate best = closest_on_edge(corners, 0, 1);
  for (std::size_t i = 1; i < 3; ++i) {
    const Candidate other = closest_on_edge(corners, i, (i + 1) % 3);
    if (other.squared_distance < best.squared_distance) best = other;
  }
  return best;
}

// Makes the numbers above neither overflow nor underflow, whatever the unit.
double largest_offset(const io::Triangles& surface, const Vector& point) {
  double largest = 0;
  for (const Vector& position : surface.positions) {
    for (std::size_t k = 0; k < 3; ++k)
      largest = std::max(largest, std::abs(position[k] / 2 - point[k] / 2));
  }
  return largest > 0 ? largest : 1;
}

}  // namespace

TrianglePoint closest_point(const io::Triangles& surface, const Vector& point) {
  const double scale = largest_offset(surface, point);
  TrianglePoint best;
  double best_distance = std::numeric_limits<double>::infinity();
  for (std::size_t triangle = 0; triangle < surface.triangles.size(); ++triangle) {
    std::array<Vector, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector& position = surface.positions[surface.triangles[triangle][i]];
      for (std::size_t k = 0; k < 3; ++k) corners[i][k] = (position[k] / 2 - point[k] / 2) / scale;
    }
    const Candidate found = closest_on_triangle(corners);
    if (found.squared_distance < best_distance) {
      best_distance = found.squared_distance;
      best = {triangle, found.barycentric};
    }
  }
  return best;
}

}  // namespace plexway::cli
