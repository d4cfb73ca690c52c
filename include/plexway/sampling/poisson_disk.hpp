#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <plexway/cloud/point_cloud.hpp>
#include <plexway/solid/tet_mesh.hpp>
#include <plexway/solve.hpp>
#include <plexway/solve/distance_field.hpp>
#include <plexway/solve/workspace.hpp>
#include <plexway/source/point_source.hpp>
#include <plexway/surface/triangle_mesh.hpp>

namespace plexway {

/// Where the next dart is thrown.
enum class DartOrder {
  uniform,   ///< anywhere, all parts of the domain alike
  simplices  ///< into one simplex after the other, in random order: denser where they are smaller
};

/// How darts are thrown.
struct PoissonOptions {
  /// No two darts are nearer than this (domain's unit), and no point is farther from all of them.
  double radius = 0;
  /// Or so many darts: the radius is then searched for. Give one of the two.
  std::size_t count = 0;
  std::uint64_t seed = 1;  ///< the same seed gives the same darts, on any machine
  /// Where the next one goes.
  DartOrder order = DartOrder::uniform;
  /// Only at vertices: then no vertex is farther than the radius. So it is on clouds, always.
  bool at_vertices = false;
  /// One a vertex, > 0, or empty: the radius about a dart is `radius` times this, linear between
  /// vertices. For a density of darts, give its power -1/2 on surfaces and -1/3 in solids. It
  /// should grow more slowly than the distance.
  std::span<const double> spacing = {};
  /// A solid, or a surface by coordinates, that would be cut into more simplices than this, of 200
  /// to 400 bytes each, is done box by box, so that memory does not grow with the number of darts
  /// but for themselves.
  std::size_t at_once = std::size_t{1} << 21;
  /// Called now and then with the share of the domain that is covered; false stops with Cancelled.
  std::function<bool(double share)> progress = {};
};

/// A Poisson-disk sample. Where there is a spacing, a dart keeps those thrown later out of its own
/// radius.
struct PoissonDisks {
  std::vector<PointSource> darts;  ///< in the order in which they were thrown
  double radius = 0;               ///< that of the options, or what was found for the count
  /// No room is left for another. False only where `count` darts did it before that.
  bool maximal = true;
  std::size_t thrown = 0;      ///< darts tried
  std::size_t taken_back = 0;  ///< of these, found too near a neighbour when they spread
  /// Of all propagations.
  PropagateStatistics statistics;
};

/// Throws darts at a surface until every point of it lies within the radius of one (maximal
/// Poisson-disk sampling), by propagation that stops at the radius and keeps what earlier darts
/// found: each dart is propagated only where it is the nearest.
///
/// What is uncovered is known down to parts of triangles. Triangles with edges longer than 0.4
/// of the radius are cut first, on a copy. Two darts are at least (1 - 1e-3) radius apart, as far
/// as the field is exact: where the fronts of a new dart and an earlier one meet, the length of the
/// path between is measured again.
///
/// Throws UsageError for options out of range and for a radius so small that the parts would not
/// fit, PrecisionError for radii too different for the domain's numbers.
/// UsageError for a surface with refracting edges, too.
/// Cost: 2.2 to 2.5 propagations from a single source, and more where edges must be cut; with
/// `count`, three to ten times that.
/// Source: Trettner, Bommes, Kobbelt: Geodesic Distance Computation via Virtual Source Propagation,
/// SGP 2021, section 6; the choice among uncovered parts is that of White, Cline, Egbert: Poisson
/// Disk Point Sets by Hierarchical Dart Throwing, RT 2007.
template <class Real>
[[nodiscard]] PoissonDisks poisson_disks(Serial, const TriangleMesh<Real>& mesh,
                                         const PoissonOptions& options, Workspace<Real>& workspace);

/// The same in a solid, which must have coordinates (UsageError).
template <class Real>
[[nodiscard]] PoissonDisks poisson_disks(Serial, const TetMesh<Real>& mesh,
                                         const PoissonOptions& options, Workspace<Real>& workspace);

/// The same among the points of a cloud: darts are points, and no point is farther than the radius
/// from all of them. A spacing has one value a point. Throws UsageError for the order `simplices`.
template <class Real>
[[nodiscard]] PoissonDisks poisson_disks(Serial, const PointCloud<Real>& cloud,
                                         const PoissonOptions& options, Workspace<Real>& workspace);

/// With a workspace of its own.
template <class Real>
[[nodiscard]] PoissonDisks poisson_disks(Serial executor, const TriangleMesh<Real>& mesh,
                                         const PoissonOptions& options) {
  Workspace<Real> workspace;
  return poisson_disks(executor, mesh, options, workspace);
}
/// With a workspace of its own.
template <class Real>
[[nodiscard]] PoissonDisks poisson_disks(Serial executor, const TetMesh<Real>& mesh,
                                         const PoissonOptions& options) {
  Workspace<Real> workspace;
  return poisson_disks(executor, mesh, options, workspace);
}
/// With a workspace of its own.
template <class Real>
[[nodiscard]] PoissonDisks poisson_disks(Serial executor, const PointCloud<Real>& cloud,
                                         const PoissonOptions& options) {
  Workspace<Real> workspace;
  return poisson_disks(executor, cloud, options, workspace);
}

}  // namespace plexway
