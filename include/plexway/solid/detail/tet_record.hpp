#pragma once

#include <cmath>
#include <cstddef>

#include <plexway/common/ids.hpp>

namespace plexway {

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

/// All that propagation reads of every tetrahedron. Face i lies opposite corner i. Lengths are in
/// units of the mean edge; corners are in positive order.
template <class Real>
struct TetRecord {
  Index across[4];       ///< TetAcross of each face; the sentinel's index on the boundary
  Index corner[4];       ///< vertices, numbers inside
  Vector3<Real> centre;  ///< centroid; 0 where lengths are all that is known
  Index reflex;          ///< its first entry in TetMesh::reflex_list, or none
};

/// An edge of the boundary at which a path can bend: more than pi of solid around it. Where several
/// fans of tetrahedra touch in one edge, each fan that is reflex has an entry of its own.
template <class Real>
struct ReflexEdge {
  // First what says that a point is not in its shadow.
  Vector3<Real> solid;      ///< away from it: sum of the normals, or out of a crack
  Vector3<Real> direction;  ///< from the first end to the second, unit; 0 without length
  Vector3<Real> end[2];
  Real extent;              ///< its length; named so that shaders can have it
  Vector3<Real> normal[2];  ///< of the two boundary faces, unit, into the solid
  Index vertex[2];          ///< numbers inside
};

/// Do both faces at it lie on each other, so that the solid goes all around?
template <class Real>
bool is_crack(const ReflexEdge<Real>& edge) {
  return dot(edge.normal[0], edge.normal[1]) < Real(-1 + 1e-6);
}

/// An entry of TetMesh::reflex_list, packed.
struct ReflexEntry {
  static constexpr Index last = 1;  ///< the tetrahedron's list ends here
  static constexpr int slot_shift = 1;
  static constexpr Index slot_mask = 7;  ///< number of the edge in the tetrahedron
  static constexpr int edge_shift = 4;
};

}  // namespace plexway
