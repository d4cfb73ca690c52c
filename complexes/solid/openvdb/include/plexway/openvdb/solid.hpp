#pragma once

#include <array>
#include <vector>

#include <plexway/common/ids.hpp>
#include <plexway/openvdb/level_set.hpp>

namespace plexway::openvdb {

/// Tetrahedra, ready for a TetMesh.
struct Solid {
  /// In the level set's unit.
  std::vector<std::array<double, 3>> positions;
  std::vector<std::array<Index, 4>> tets;  ///< positive volume: (b - a) x (c - a) . (d - a) > 0
};

/// Triangles, ready for a TriangleMesh.
struct Surface {
  /// In the level set's unit.
  std::vector<std::array<double, 3>> positions;
  std::vector<std::array<Index, 3>> triangles;  ///< counterclockwise from outside
};

/// Cuts the inside of a level set into tetrahedra whose boundary lies on its zero surface.
///
/// A body-centred cubic lattice of cubes of side `spacing` (in the unit of positions; 0: the
/// voxel's own) is cut where the function changes sign. A lattice point too near to a cut is moved
/// onto it first, so that no sliver arises, whatever the surface: the paper proves dihedral angles
/// of 10.7 to 164.8 degrees; we measured 10.5 to 159 on noise and 18 to 145 on smooth surfaces,
/// where voxels are cubes. Inside they are 60 and 90. What is thinner than `spacing` may be lost.
///
/// Throws UsageError for a spacing out of range and InputError where nothing is inside. Cost:
/// linear in the lattice cells inside, 12 tetrahedra each; about 0.2 us and 24 bytes a tetrahedron.
/// Source: Labelle, Shewchuk, Isosurface Stuffing: Fast Tetrahedral Meshes with Good Dihedral
/// Angles, ACM TOG 26 (2007).
[[nodiscard]] Solid fill(const LevelSet& level_set, double spacing = 0);

/// The boundary of that solid: closed, and crossing itself nowhere; parts may touch in an edge or a
/// vertex. Throws as `fill`.
[[nodiscard]] Surface surface_of(const LevelSet& level_set, double spacing = 0);

}  // namespace plexway::openvdb
