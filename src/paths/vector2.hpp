#pragma once

#include <cmath>

namespace plexway::detail {

/// A point in the plane that a strip of triangles is unfolded into.
struct Vector2 {
  double x = 0, y = 0;

  friend Vector2 operator+(const Vector2& a, const Vector2& b) { return {a.x + b.x, a.y + b.y}; }
  friend Vector2 operator-(const Vector2& a, const Vector2& b) { return {a.x - b.x, a.y - b.y}; }
  friend Vector2 operator*(double s, const Vector2& a) { return {s * a.x, s * a.y}; }
  friend double dot(const Vector2& a, const Vector2& b) { return a.x * b.x + a.y * b.y; }
  friend double cross(const Vector2& a, const Vector2& b) { return a.x * b.y - a.y * b.x; }
  friend double norm(const Vector2& a) { return std::sqrt(dot(a, a)); }
};

}  // namespace plexway::detail
