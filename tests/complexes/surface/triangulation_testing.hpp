#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <plexway/surface/triangle_mesh.hpp>

#include "complexes/test_meshes.hpp"

/// What a mesh is, read from its records: for tests of what changes triangulations.
namespace plexway::testing {
using namespace detail;

struct Plain {
  std::vector<Face> faces;                    // caller's vertices and corners
  std::vector<std::array<double, 3>> length;  // input's unit
  std::vector<std::array<double, 3>> angle;   // rad, at the corners
};

template <class Real>
Plain plain(const TriangleMesh<Real>& mesh) {
  std::vector<Index> outer(mesh.vertex_count());
  for (Index v = 0; v < outer.size(); ++v) outer[mesh.inside_vertex(v)] = v;
  Plain result;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto [inside, turned] = mesh.inside_face(f);
    const TriangleRecord<Real>& t = mesh.triangles()[inside];
    Face face{};
    std::array<double, 3> length{}, angle{};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t c = turned ? (3 - i) % 3 : i, e = turned ? 2 - i : i;
      face[i] = outer[t.corner[c]];
      length[i] = static_cast<double>(t.length[e]) * mesh.unit();
      angle[i] = std::atan2(static_cast<double>(t.sine(c)), static_cast<double>(t.cosine[c]));
    }
    result.faces.push_back(face);
    result.length.push_back(length);
    result.angle.push_back(angle);
  }
  return result;
}

inline std::vector<double> cone_angles(const Plain& p, std::size_t vertices) {
  std::vector<double> sum(vertices, 0);
  for (std::size_t f = 0; f < p.faces.size(); ++f)
    for (std::size_t i = 0; i < 3; ++i) sum[p.faces[f][i]] += p.angle[f][i];
  return sum;
}

inline double total_area(const Plain& p) {
  double sum = 0;
  for (std::size_t f = 0; f < p.faces.size(); ++f) {
    // From the two longest edges: the angle between them is the best known.
    std::size_t i = 0;  // opposite to the shortest
    for (std::size_t k = 0; k < 3; ++k)
      if (p.length[f][(k + 1) % 3] < p.length[f][(i + 1) % 3]) i = k;
    sum += p.length[f][i] * p.length[f][(i + 2) % 3] * std::sin(p.angle[f][i]) / 2;
  }
  return sum;
}

/// The largest sum of opposite angles over inner edges, less pi. Glued to itself does not count.
template <class Real>
double worst_excess(const TriangleMesh<Real>& mesh) {
  double worst = -std::numbers::pi;
  const auto t = mesh.triangles();
  for (Index f = 0; f < mesh.face_count(); ++f)
    for (std::size_t i = 0; i < 3; ++i) {
      const Index o = t[f].across[i], g = o >> Across::face_shift, j = o & Across::edge_mask;
      if (g == mesh.face_count() || g == f || (o & Across::fan) != 0) continue;
      const auto angle = [&](Index face, std::size_t c) {
        return std::atan2(static_cast<double>(t[face].sine(c)),
                          static_cast<double>(t[face].cosine[c]));
      };
      worst =
          std::max(worst, angle(f, edge_before(i)) + angle(g, edge_before(j)) - std::numbers::pi);
    }
  return worst;
}

/// Edges that have other than two triangles: their vertices, how many triangles, their length.
template <class Real>
std::vector<std::array<double, 4>> fixed_edges(const TriangleMesh<Real>& mesh) {
  std::vector<std::array<double, 4>> found;
  std::vector<Index> outer(mesh.vertex_count());
  for (Index v = 0; v < outer.size(); ++v) outer[mesh.inside_vertex(v)] = v;
  const auto t = mesh.triangles();
  for (Index f = 0; f < mesh.face_count(); ++f)
    for (std::size_t i = 0; i < 3; ++i) {
      const Index o = t[f].across[i];
      const bool boundary = o >> Across::face_shift == mesh.face_count();
      if (!boundary && (o & Across::fan) == 0) continue;
      const auto [a, b] = std::minmax(outer[t[f].corner[i]], outer[t[f].corner[edge_after(i)]]);
      found.push_back({static_cast<double>(a), static_cast<double>(b), boundary ? 1.0 : 3.0,
                       static_cast<double>(t[f].length[i]) * mesh.unit()});
    }
  std::sort(found.begin(), found.end());
  return found;
}

/// Triangles as sets of vertices, in order.
inline std::vector<Face> vertex_sets(const Plain& p) {
  std::vector<Face> sets = p.faces;
  for (Face& f : sets) std::sort(f.begin(), f.end());
  std::sort(sets.begin(), sets.end());
  return sets;
}

/// The same triangles, vertices moved at random.
inline Surface noisy(Surface s, double by, unsigned seed) {
  std::mt19937 random(seed);
  for (Position& p : s.positions)
    for (double& x : p) x += by * (uniform(random) - 0.5);
  return s;
}

/// A closed surface of two copies of one triangle, glued along all three edges.
inline TriangleMesh<double> double_cover(double a, double b, double c) {
  const std::vector<Face> faces = {{0, 1, 2}, {0, 2, 1}};
  const std::vector<std::array<double, 3>> lengths = {{a, b, c}, {c, b, a}};
  const std::vector<std::array<Index, 3>> across = {{5, 4, 3}, {2, 1, 0}};
  return TriangleMesh<double>(3, faces, lengths, across);
}

}  // namespace plexway::testing
