#pragma once

#include <plexway/common/ids.hpp>
#include <plexway/solid/detail/tet_record.hpp>

namespace plexway {

/// What a tetrahedron in space remembers: the path to its centre, a string from the virtual source
/// S around reflex edges. Where it bends at them depends on the point it is for.
template <class Real>
struct SolidLabel {
  Vector3<Real> source;  ///< S, in the frame of TetMesh::points
  Real sigma;            ///< walked from the source to S
  Real centre;           ///< distance of the tetrahedron's centre
  static constexpr int bends = 2;
  Index bend[bends];  ///< reflex edges on the way from S, in this order, or none
  Index door;         ///< how the way begins: none, if S is a point of the solid, or SolidDoor's
};

/// Do both have the same S?
template <class Real>
[[nodiscard]] bool same_source(const SolidLabel<Real>& a, const SolidLabel<Real>& b) {
  return a.sigma == b.sigma && a.source.x == b.source.x && a.source.y == b.source.y &&
         a.source.z == b.source.z;
}
/// Do both have the same S and bends? Then they look at the same scene.
template <class Real>
[[nodiscard]] bool same_way(const SolidLabel<Real>& a, const SolidLabel<Real>& b) {
  return same_source(a, b) && a.bend[0] == b.bend[0] && a.bend[1] == b.bend[1];
}

/// Where S is not a point that strings can be walked to.
struct SolidDoor {
  /// S is outside: the path comes in over a face of a tetrahedron.
  static constexpr Index face(Index tet, Index face) { return 4 * tet + face; }
  /// S was turned about a reflex edge, which is parallel to bend[0]: `unfolded` + edge. More than
  /// 4 x 2^29 faces would take 30 GB at least.
  static constexpr Index unfolded = Index{1} << 31;
  /// S is a place of several vertices, as on a crack, which does not tell the sides: strings begin
  /// beside it, inside of that tetrahedron. `beside` + tet.
  static constexpr Index beside = Index{3} << 30;
};

}  // namespace plexway
