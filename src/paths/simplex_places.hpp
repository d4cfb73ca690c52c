#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include <plexway/solid/tet_mesh.hpp>
#include <plexway/surface/triangle_mesh.hpp>

#include "complexes/common/box_tree.hpp"

namespace plexway::detail {

/// The corners of a simplex, numbers inside.
template <class Real>
std::span<const Index> corners_in(const TriangleMesh<Real>& mesh, Index s) {
  return mesh.triangles()[s].corner;
}
template <class Real>
std::span<const Index> corners_in(const TetMesh<Real>& mesh, Index s) {
  return mesh.tets()[s].corner;
}

/// Are simplices straight in space, their corners where `place_of` says?
template <class Real>
bool has_places(const TriangleMesh<Real>& mesh) {
  return mesh.faces_are_in_space();
}
template <class Real>
bool has_places(const TetMesh<Real>&) {
  return true;
}

/// Where a vertex (inside) lies, in the unit inside.
template <class Real>
std::array<double, 3> place_of(const TriangleMesh<Real>& mesh, Index v) {
  return mesh.positions()[v];
}
template <class Real>
std::array<double, 3> place_of(const TetMesh<Real>& mesh, Index v) {
  const auto& [x, y, z] = mesh.points()[v];
  return {x, y, z};
}

/// What a simplex lies in.
template <class Complex>
Box<3> box_around(const Complex& complex, Index s) {
  Box<3> box = Box<3>::empty();
  for (const Index v : corners_in(complex, s)) box.add(place_of(complex, v));
  return box;
}

/// Area, or volume, of a simplex that has places.
template <class Real>
double content_in_space(const TriangleMesh<Real>& mesh, Index s) {
  const Index* v = mesh.triangles()[s].corner;
  const std::array<double, 3> o = place_of(mesh, v[0]), a = place_of(mesh, v[1]),
                              b = place_of(mesh, v[2]);
  std::array<double, 3> normal{};
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t l = (k + 1) % 3, m = (k + 2) % 3;
    normal[k] = (a[l] - o[l]) * (b[m] - o[m]) - (a[m] - o[m]) * (b[l] - o[l]);
  }
  return std::hypot(normal[0], normal[1], normal[2]) / 2;
}
template <class Real>
double content_in_space(const TetMesh<Real>& solid, Index s) {
  const Index* v = solid.tets()[s].corner;
  const auto p = solid.points();
  return dot(p[v[1]] - p[v[0]], cross(p[v[2]] - p[v[0]], p[v[3]] - p[v[0]])) / 6;
}

}  // namespace plexway::detail
