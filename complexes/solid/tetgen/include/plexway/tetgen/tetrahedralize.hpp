#pragma once

#include <array>
#include <functional>
#include <vector>

#include <plexway/common/ids.hpp>
#include <plexway/common/rows_of.hpp>
#include <plexway/tetgen/piecewise_linear_complex.hpp>

/// The component `tetgen`, link plexway::tetgen: solids from closed surfaces, by TetGen (AGPL).
namespace plexway::tetgen {

/// What a tetrahedral mesh shall be like. Lengths in the input's unit.
struct TetrahedralizeOptions {
  /// No tetrahedron is larger; 0 for no bound. Where TetGen does not keep to it at first, it runs
  /// again.
  double max_volume = 0;
  /// Bound on circumradius over shortest edge, above 1 (TetGen may not end below sqrt(2)); 0 for
  /// TetGen's own, 2.
  double max_radius_edge = 0;
  /// Adds points for the sake of the bound above. Off, only the points that the boundary needs are
  /// added, and those of max_volume.
  bool quality = true;
  /// No point is added on the boundary: its triangles stay as they are, added points lie inside.
  bool keep_surface = false;
  /// A run of TetGen is stopped after so many seconds; 0 for no limit.
  double max_seconds = 0;
  /// Asked a few times a second while TetGen runs, with the seconds that a run has taken; false
  /// ends it with Cancelled. TetGen does not tell how far it is. May be empty.
  std::function<bool(double seconds)> go_on = {};
};

/// Tetrahedra, ready for a TetMesh.
struct Solid {
  /// The input's own come first, same number, same bits, in a tetrahedron or not; then those added.
  std::vector<std::array<double, 3>> positions;
  std::vector<std::array<Index, 4>> tets;  ///< positive volume: (b - a) x (c - a) . (d - a) > 0
  /// The attribute of the region each tetrahedron lies in (0: none); empty where none were given.
  std::vector<double> regions;
};

/// Fills a closed triangle surface with tetrahedra by TetGen 1.5 (AGPL).
///
/// `positions` in any unit, `triangles` of indices into them in any orientation. `holes` are
/// points, one in each cavity that stays empty: without them a closed surface inside another one is
/// an inner wall. Vertices that lie exactly on another one count as that one, so a surface cut
/// along seams is closed; the later of them are then in no tetrahedron.
///
/// Throws InputError, in one line, for what cannot be filled: no triangle, a coordinate that is not
/// finite, an index out of range, a triangle that is there twice or has a vertex twice, an open
/// edge, facets that cross (the first ones are named), or what else TetGen gives up on; UsageError
/// for options out of range; Error where TetGen takes too long, as it may for ever on surfaces with
/// needles: keep_surface often helps there.
///
/// It runs in a child process, since TetGen 1.5 prints what it likes, leaks after an error and
/// aborts on some inputs: nothing reaches standard output, and the caller lives on. Cost: about
/// 15 us a tetrahedron.
/// Source: Si, TetGen, a Delaunay-Based Quality Tetrahedral Mesh Generator, ACM TOMS 41 (2015).
[[nodiscard]] Solid tetrahedralize(const GivenPoints& positions, const GivenSimplices<3>& triangles,
                                   const GivenPoints& holes = {},
                                   const TetrahedralizeOptions& options = {});

/// The same for facets with more corners, holes and inner edges, and for regions with attributes
/// and volume bounds of their own. Facets may end inside the solid, so open edges are TetGen's
/// business here.
[[nodiscard]] Solid tetrahedralize(const PiecewiseLinearComplex& complex,
                                   const TetrahedralizeOptions& options = {});

}  // namespace plexway::tetgen
