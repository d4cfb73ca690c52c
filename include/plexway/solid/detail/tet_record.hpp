#pragma once

#include <cmath>

#include <plexway/common/ids.hpp>

namespace plexway::detail {

/// The tetrahedron on the other side of a face, packed with the number that the face has there.
struct TetAcross {
  static constexpr Index face_mask = 3;
  static constexpr int tet_shift = 2;
  static constexpr Index limit = Index{1} << 30;  ///< so many tetrahedra at most
};

/// Ends of the six edges of a tetrahedron by their number; edge (i < j) is j (j - 1) / 2 + i.
inline constexpr Index tet_edge_ends[6][2] = {{0, 1}, {0, 2}, {1, 2}, {0, 3}, {1, 3}, {2, 3}};
/// Number of the edge between two corners.
constexpr Index tet_edge(Index i, Index j) {
  return i < j ? j * (j - 1) / 2 + i : i * (i - 1) / 2 + j;
}

/// Corners of the face opposite to corner i, anticlockwise as seen from outside.
inline constexpr Index tet_faces[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
/// The same as seen from inside, from corner i.
inline constexpr Index tet_faces_inside[4][3] = {{1, 3, 2}, {0, 2, 3}, {0, 3, 1}, {0, 1, 2}};

/// A point or a direction in space.
template <class Real>
struct Vector3 {
  Real x, y, z;

  friend Vector3 operator+(const Vector3& a, const Vector3& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  friend Vector3 operator-(const Vector3& a, const Vector3& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  friend Vector3 operator*(Real s, const Vector3& a) { return {s * a.x, s * a.y, s * a.z}; }
  friend Real dot(const Vector3& a, const Vector3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
  friend Vector3 cross(const Vector3& a, const Vector3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  }
  friend Real norm(const Vector3& a) { return std::sqrt(dot(a, a)); }
};

/// What lies where in a solid. Face i lies opposite corner i; corners are in positive order.
struct TetRecord {
  Index across[4];  ///< TetAcross of each face; the sentinel's index on the boundary
  Index corner[4];  ///< vertices, numbers inside
};

}  // namespace plexway::detail
