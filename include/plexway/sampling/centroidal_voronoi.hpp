#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include <plexway/cloud/point_cloud.hpp>
#include <plexway/solid/tet_mesh.hpp>
#include <plexway/solve.hpp>
#include <plexway/solve/distance_field.hpp>
#include <plexway/source/point_source.hpp>
#include <plexway/surface/triangle_mesh.hpp>

namespace plexway {

/// Where a seed moves in its cell.
enum class CellCentre {
  centroid,  ///< to the mean of the cell as seen from the seed: lowers the energy
  /// To the simplex farthest from the border of the cell and of the domain, as published: a second
  /// propagation an iteration, and the energy need not fall.
  farthest_from_border
};

/// One iteration.
struct VoronoiStep {
  double energy = 0;    ///< integral of the squared distance from the nearest seed, before the move
  double movement = 0;  ///< of the seeds after that, root mean square
};

/// How seeds move, and how long.
struct VoronoiOptions {
  /// Where to.
  CellCentre centre = CellCentre::centroid;
  /// Done after so many, converged or not.
  std::size_t max_iterations = 100;
  /// Done when the movement is below this share of a cell's size (content / seeds)^(1 / dimension).
  double tolerance = 1e-3;
  /// Called after each iteration; false stops with Cancelled.
  std::function<bool(const VoronoiStep&)> progress = {};
};

/// Seeds in the middle of their cells.
struct CentroidalVoronoi {
  /// As many as there were, in their order.
  std::vector<PointSource> seeds;
  /// Nearest seed of each simplex's centre, on clouds of each point; none if unreached.
  std::vector<Index> label;
  /// Area or volume of each seed's cell, its border running through simplices: they add up to what
  /// is reached.
  std::vector<double> cell_content;
  /// One an iteration.
  std::vector<VoronoiStep> steps;
  double energy = 0;               ///< at the end
  bool converged = false;          ///< the movement fell below the tolerance
  PropagateStatistics statistics;  ///< of all iterations
};

/// Moves seeds until each lies in the middle of its Voronoi cell (Lloyd's algorithm), by geodesic
/// distance. Start from `poisson_disks` of the wanted count.
///
/// Labels give the cells and, for each simplex, direction and distance from its seed; their mean
/// over the cell is the way that the seed walks, straight ahead. Offsets of seeds are not asked
/// for.
///
/// Throws UsageError for no seeds, a seed that is not in the domain, options out of range.
/// UsageError for a surface with refracting edges, too.
/// Cost: about 1.6 propagations from a single source an iteration, 3.1 with farthest_from_border.
/// Source: Trettner, Bommes, Kobbelt: Geodesic Distance Computation via Virtual Source Propagation,
/// SGP 2021, section 6, for farthest_from_border; Lloyd: Least Squares Quantization in PCM, 1982.
template <class Real>
[[nodiscard]] CentroidalVoronoi centroidal_voronoi(Serial, const TriangleMesh<Real>& mesh,
                                                   std::span<const PointSource> seeds,
                                                   const VoronoiOptions& options = {});
/// In a solid, which must have coordinates (UsageError).
template <class Real>
[[nodiscard]] CentroidalVoronoi centroidal_voronoi(Serial, const TetMesh<Real>& mesh,
                                                   std::span<const PointSource> seeds,
                                                   const VoronoiOptions& options = {});

/// On a cloud, with seeds that are its points: they move over the sheet between the points, and go
/// to the nearest point at last, each to another one. `energy` and `cell_content` are those after
/// that, so that the energy may end above that of the last step, by less the denser the points.
/// Throws UsageError as above, and for more seeds than there are places. The start is points by
/// number.
template <class Real>
[[nodiscard]] CentroidalVoronoi centroidal_voronoi(Serial, const PointCloud<Real>& cloud,
                                                   std::span<const PointSource> seeds,
                                                   const VoronoiOptions& options = {});

/// What is dual to a Voronoi diagram on a surface: a triangle of seeds wherever three cells meet.
struct DualTriangulation {
  std::vector<std::array<Index, 3>> triangles;  ///< of seeds, turned as the surface
  /// Every edge has two triangles, or one on a boundary of the surface, and those around each seed
  /// form one fan. Else cells are too few: some are no disks, or two touch in two places.
  bool manifold = true;
  std::vector<Index> irregular;  ///< seeds where it is not, ascending
};

/// From the nearest seed of each vertex, as `solve` from several sources gives it.
///
/// Shapes: m faces of vertices < n, n labels, each < `seeds` or none; not checked. Cost: linear,
/// but for sorting the edges between cells.
[[nodiscard]] DualTriangulation dual_triangulation(std::span<const std::array<Index, 3>> faces,
                                                   std::span<const Index> vertex_label,
                                                   std::size_t seeds);

}  // namespace plexway
