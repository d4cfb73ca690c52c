#include "complexes/mixed/joined_pieces.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "complexes/common/vertices_outside.hpp"

namespace plexway::detail {
namespace {

// Along the first edge, across it in the plane, and off the plane.
std::array<Point3, 3> axes_of(const std::array<Point3, 3>& t, const Point3& inside, double side) {
  const Point3 u = unit(minus(t[1], t[0]));
  Point3 n = unit(cross(u, minus(t[2], t[0])));
  const Point3 w = cross(n, u);
  if (dot(n, minus(inside, t[0])) * side < 0) n = {-n[0], -n[1], -n[2]};
  return {u, w, n};
}

double gap(const Point3& a, const Point3& b) {
  const Point3 d = minus(a, b);
  return std::sqrt(dot(d, d));
}

}  // namespace

Placing place_onto(const std::array<Point3, 3>& at, const Point3& inside,
                   const std::array<Point3, 3>& onto, const Point3& onto_inside, double tolerance) {
  const auto from = axes_of(at, inside, 1), to = axes_of(onto, onto_inside, -1);
  if (std::max({gap(at[0], onto[0]), gap(at[1], onto[1]), gap(at[2], onto[2])}) <= tolerance &&
      dot(from[2], to[2]) > 0)
    return {};
  Placing placing;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      placing.turn[i][k] = 0;
      for (std::size_t a = 0; a < 3; ++a) placing.turn[i][k] += to[a][i] * from[a][k];
    }
  placing.move = minus(onto[0], placing(at[0]));
  return placing;
}

template <class Real>
std::vector<Point3> places_of(const TetMesh<Real>& mesh, std::span<const Point3> given) {
  std::vector<Point3> own(mesh.vertex_count());
  Point3 shift = {0, 0, 0};
  double size = 0;
  for (Index v = 0; v < own.size(); ++v) {
    const auto& [x, y, z] = mesh.points()[mesh.inside_vertex(v)];
    own[v] = {x * mesh.unit(), y * mesh.unit(), z * mesh.unit()};
    size = std::max({size, std::abs(own[v][0]), std::abs(own[v][1]), std::abs(own[v][2])});
  }
  if (given.empty()) return own;
  shift = minus(given[0], own[0]);
  const double rounding = 1e-9 * (size + std::sqrt(dot(shift, shift)));
  for (Index v = 0; v < own.size(); ++v)
    if (!(gap(minus(given[v], own[v]), shift) <= rounding)) return own;
  return {given.begin(), given.end()};
}

template <class Real>
std::vector<std::array<Index, 4>> tets_of(const TetMesh<Real>& mesh) {
  const std::vector<Index> given = vertices_outside(mesh);
  std::vector<std::array<Index, 4>> tets(mesh.tet_count());
  for (Index t = 0; t < tets.size(); ++t) {
    const auto [inside, turned] = mesh.inside_tet(t);
    for (std::size_t i = 0; i < 4; ++i) tets[t][i] = given[mesh.tets()[inside].corner[i]];
    if (turned) std::swap(tets[t][2], tets[t][3]);
  }
  return tets;
}

template std::vector<Point3> places_of(const TetMesh<float>&, std::span<const Point3>);
template std::vector<Point3> places_of(const TetMesh<double>&, std::span<const Point3>);
template std::vector<std::array<Index, 4>> tets_of(const TetMesh<float>&);
template std::vector<std::array<Index, 4>> tets_of(const TetMesh<double>&);

}  // namespace plexway::detail
