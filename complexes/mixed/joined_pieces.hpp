#pragma once

#include <algorithm>
#include <array>
#include <iterator>
#include <memory>
#include <span>
#include <vector>

#include <plexway/mixed/mixed_complex.hpp>
#include <plexway/solid/tet_mesh.hpp>
#include <plexway/surface/triangle_mesh.hpp>

#include "complexes/common/geometry.hpp"
#include "complexes/solid/shared_faces.hpp"

namespace plexway::detail {

/// A mixed domain as executors work on it: fewer pieces, and where each of the caller's vertices
/// and simplices is in them. A corner that exists only once pieces are welded is then one of a
/// complex, whose rule knows what to do about it.
template <class Real>
struct JoinedPieces {
  MixedComplex<Real> domain;
  std::vector<Index> vertex, simplex;

  /// Null if nothing is to be joined. Cost: that of building the complexes anew.
  static std::shared_ptr<const JoinedPieces> of(const MixedComplex<Real>& given);

  [[nodiscard]] std::size_t bytes() const {
    return domain.bytes() + (vertex.capacity() + simplex.capacity()) * sizeof(Index);
  }
};

extern template struct JoinedPieces<float>;
extern template struct JoinedPieces<double>;

/// The piece that has a vertex of the whole or, by its first one, a simplex.
template <class Domain, class Piece = typename Domain::Piece>
const Piece& piece_of(const Domain& domain, Index number,
                      Index Piece::*first = &Piece::first_vertex) {
  const auto pieces = domain.pieces();
  return *std::prev(
      std::upper_bound(pieces.begin(), pieces.end(), number,
                       [first](Index n, const Piece& piece) { return n < piece.*first; }));
}

/// Where a solid lies in the frame of another one: turned, moved, and perhaps mirrored, for what
/// counts is lengths.
struct Placing {
  std::array<Point3, 3> turn = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  Point3 move = {0, 0, 0};
  [[nodiscard]] Point3 operator()(const Point3& p) const {
    return {dot(turn[0], p) + move[0], dot(turn[1], p) + move[1], dot(turn[2], p) + move[2]};
  }
};

/// So that the triangle `at` comes to lie on `onto`, with `inside` and `onto_inside`, points off
/// their planes, on either side of it. Moves nothing if all is so already, within `tolerance`.
Placing place_onto(const std::array<Point3, 3>& at, const Point3& inside,
                   const std::array<Point3, 3>& onto, const Point3& onto_inside, double tolerance);

/// A solid's vertices in the caller's order and unit: the positions it was given with, if they are
/// those that it has.
template <class Real>
std::vector<Point3> places_of(const TetMesh<Real>& mesh, std::span<const Point3> given);

/// Its tetrahedra, in the caller's order.
template <class Real>
std::vector<std::array<Index, 4>> tets_of(const TetMesh<Real>& mesh);

/// Surfaces to become one: their vertices' numbers in it, in the caller's order of each.
template <class Real>
struct JoinedPart {
  const TriangleMesh<Real>* mesh;
  std::span<const Index> vertex;
};

/// Edges that two of them have.
struct SurfaceSeam {
  Index part[2];
  std::vector<SharedFace> shared;
};

/// One surface of `vertices` vertices, glued along what its parts share. Triangles keep their
/// lengths and angles, faces the order of parts. Where lengths of an edge differ by more than 1e-6
/// paths are refracted.
template <class Real>
TriangleMesh<Real> join_surfaces(std::size_t vertices, std::span<const JoinedPart<Real>> parts,
                                 std::span<const SurfaceSeam> seams);

}  // namespace plexway::detail
