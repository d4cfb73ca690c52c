#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <plexway/common/ids.hpp>
#include <plexway/solid/tet_mesh.hpp>
#include <plexway/surface/triangle_mesh.hpp>
#include <plexway/wireframe/wireframe.hpp>

namespace plexway::boost_graph {

/// Which vertices a path joins. A vertex in no simplex is a component of its own (other than in the
/// complexes' summaries, which count components of simplices).
struct Components {
  /// How many components.
  std::size_t count = 0;
  std::vector<Index> of_vertex;  ///< one a vertex; numbered as their first vertices are
};

/// Of n vertices joined by edges, triangles or tetrahedra, by Boost's disjoint sets. Throws
/// InputError naming the simplex for an index >= n. Cost: about linear.
[[nodiscard]] Components connected_components(std::size_t vertices,
                                              std::span<const std::array<Index, 2>> edges);
/// The same by triangles.
[[nodiscard]] Components connected_components(std::size_t vertices,
                                              std::span<const std::array<Index, 3>> triangles);
/// The same by tetrahedra.
[[nodiscard]] Components connected_components(std::size_t vertices,
                                              std::span<const std::array<Index, 4>> tets);

/// Of a complex, in the caller's order. Simplices that only touch in a vertex are joined by it, as
/// paths may pass there.
/// Cost: about linear.
template <class Real>
[[nodiscard]] Components connected_components(const Wireframe<Real>& wireframe);
/// The same of a surface.
template <class Real>
[[nodiscard]] Components connected_components(const TriangleMesh<Real>& mesh);
/// The same of a solid.
template <class Real>
[[nodiscard]] Components connected_components(const TetMesh<Real>& mesh);

}  // namespace plexway::boost_graph
