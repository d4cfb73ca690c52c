#pragma once

#include <cstddef>
#include <random>

#include <plexway/solid/tet_mesh.hpp>

#include "complexes/test_meshes.hpp"
#include "labels/solid/solid_label.hpp"

/// What tests of lines through a solid need besides the rule.
namespace plexway::testing {

/// Takes labels, and has none.
template <class Real>
struct NoFront {
  void put(Index, const SolidLabel<Real>&) {}
};

/// A random point of tetrahedron t, a little off its faces, where the mesh has its points.
template <class Real>
Vector3<Real> point_in(const TetMesh<Real>& mesh, Index t, std::mt19937& random) {
  Real weight[4], sum = 0;
  for (Real& w : weight) sum += w = static_cast<Real>(0.05 + uniform(random));
  Vector3<Real> p = {0, 0, 0};
  for (std::size_t i = 0; i < 4; ++i)
    p = p + weight[i] / sum * mesh.points()[mesh.tets()[t].corner[i]];
  return p;
}

}  // namespace plexway::testing
