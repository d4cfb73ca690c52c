#pragma once

#include <array>
#include <span>
#include <vector>

#include <plexway/solid/tet_mesh.hpp>

#include "complexes/common/point3.hpp"

namespace plexway {

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

}  // namespace plexway
