#pragma once

#include <plexway/complex/ids.hpp>
#include <plexway/complex/tet_record.hpp>

namespace plexway {

/// What a tetrahedron in space remembers: the virtual source S of the best path to its centre, and
/// the reflex edges that the line of sight passes most closely.
///
/// A ring source: if `ring` is an edge, the path bends there, and where depends on the point it is
/// for; S is then the point before that bend.
template <class Real>
struct SolidLabel {
  Vector3<Real> source;  ///< S, in the frame of TetMesh::points
  Real sigma;            ///< walked from the source to S
  Real centre;           ///< distance of the tetrahedron's centre
  Index ring;            ///< reflex edge at which the path from S bends, or none
  static constexpr int limits = 6;
  Index limit[limits];  ///< reflex edges that may hide S, the most pressing first, or none
  Index path;           ///< says which source and which bends led here (see SolidPath)
};

/// Names for sequences of bends: labels with equal names look at the same scene.
struct SolidPath {
  static constexpr Index factor = 0x9E3779B1u, inverse = 0x0E8B2F51u;
  static constexpr Index bent(Index path, Index edge) { return path * factor + (edge + 1); }
  static constexpr Index before(Index path, Index edge) { return (path - (edge + 1)) * inverse; }
};

}  // namespace plexway
