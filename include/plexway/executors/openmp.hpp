#pragma once

#include <concepts>
#include <cstddef>
#include <span>

#include <plexway/complex/mixed_complex.hpp>
#include <plexway/complex/point_cloud.hpp>
#include <plexway/complex/simplicial_complex.hpp>
#include <plexway/complex/tet_mesh.hpp>
#include <plexway/complex/triangle_mesh.hpp>
#include <plexway/complex/wireframe.hpp>
#include <plexway/executors/domain_traits.hpp>
#include <plexway/executors/serial_mixed.hpp>
#include <plexway/propagate/distance_field.hpp>
#include <plexway/propagate/options.hpp>
#include <plexway/propagate/workspace.hpp>
#include <plexway/source/point_source.hpp>

namespace plexway {

/// Several threads of one process.
///
/// The step is that of Serial. Threads take the front in chunks; what they offer waits with its
/// label in a queue; the least offer to a simplex becomes its label between two rounds. So the
/// result does not depend on the number of threads or on their timing: it is the same to the last
/// bit, as far as a propagation is not cut short by max_expansions. It differs from Serial's where
/// the order of updates decides which of two paths a simplex hears of first.
struct OpenMP {
  int threads = 0;  ///< 0: as many as OpenMP would take (OMP_NUM_THREADS, or one a core)
  /// Simplices that a thread takes at a time. Fronts up to this size are one thread's work.
  std::size_t chunk = 128;
};

/// Is this executor in the build? If not, all below throw NotBuiltError.
[[nodiscard]] bool openmp_built();

/// As with Serial: the distance of every vertex from the nearest of `sources`. The workspace
/// belongs to one complex and one call at a time, and is the one that Serial takes.
///
/// Cost: on one thread 1.1 (many sources) to 1.35 (one) times that of Serial. Threads wait for each
/// other several times for each step of the front, so it takes large domains with long fronts, and
/// cores that nobody else wants; else Serial is faster. Many fields of one complex are best had by
/// `fields` (executors/field.hpp).
///
/// Throws as with Serial; UsageError for a schedule that needs order (no unordered executor has a
/// nearest label), for less than one thread or an empty chunk; NotBuiltError in a build without
/// OpenMP. The progress callback is called by the calling thread.
/// Memory in float, beyond Serial's: 8 bytes a simplex, and 48 (surfaces) to 64 (solids) for each
/// label that waits; in double 16, and about twice that.
template <class Real>
void propagate(const OpenMP& executor, const TriangleMesh<Real>& mesh,
               std::span<const PointSource> sources, const PropagateOptions& options,
               Workspace<Real>& workspace, DistanceField<Real>& field);
template <class Real>
void propagate(const OpenMP& executor, const TetMesh<Real>& mesh,
               std::span<const PointSource> sources, const PropagateOptions& options,
               Workspace<Real>& workspace, DistanceField<Real>& field);
template <class Real>
void propagate(const OpenMP& executor, const Wireframe<Real>& wireframe,
               std::span<const PointSource> sources, const PropagateOptions& options,
               Workspace<Real>& workspace, DistanceField<Real>& field);
template <class Real, int N>
void propagate(const OpenMP& executor, const SimplicialComplex<Real, N>& domain,
               std::span<const PointSource> sources, const PropagateOptions& options,
               Workspace<Real>& workspace, DistanceField<Real>& field);

/// On the sheet of a cloud; sources are points by number, as with Serial.
template <class Real>
void propagate(const OpenMP& executor, const PointCloud<Real>& cloud,
               std::span<const PointSource> sources, const PropagateOptions& options,
               Workspace<Real>& workspace, DistanceField<Real>& field);

/// Mixed domains: not done; throws UsageError. (`fields` works: it takes one thread a source.)
template <class Real>
void propagate(const OpenMP& executor, const MixedComplex<Real>& domain,
               std::span<const PointSource> sources, const PropagateOptions& options,
               MixedWorkspace<Real>& workspace, DistanceField<Real>& field);

/// The same with a workspace of its own; from a single source.
template <class Domain>
[[nodiscard]] DistanceField<RealOf<Domain>> propagate(const OpenMP& executor, const Domain& domain,
                                                      std::span<const PointSource> sources,
                                                      const PropagateOptions& options = {}) {
  WorkspaceOf<Domain> workspace;
  DistanceField<RealOf<Domain>> field;
  propagate(executor, domain, sources, options, workspace, field);
  return field;
}
template <class Domain>
[[nodiscard]] DistanceField<RealOf<Domain>> propagate(const OpenMP& executor, const Domain& domain,
                                                      const PointSource& source,
                                                      const PropagateOptions& options = {}) {
  return propagate(executor, domain, std::span<const PointSource>(&source, 1), options);
}

/// What needs order needs one thread: a type that says so is refused by the compiler.
template <class Domain, class Sources, std::derived_from<NearestFirst> Options, class... Rest>
void propagate(const OpenMP&, const Domain&, const Sources&, const Options&, Rest&&...) = delete;

}  // namespace plexway
