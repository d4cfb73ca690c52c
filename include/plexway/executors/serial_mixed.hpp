#pragma once

#include <span>
#include <vector>

#include <plexway/complex/mixed_complex.hpp>
#include <plexway/executors/serial.hpp>

namespace plexway {

/// All that a propagation over a mixed domain changes. Belongs to one domain and one thread at a
/// time.
template <class Real>
struct MixedWorkspace {
  std::vector<Workspace<Real>> pieces;
  std::vector<Real> offered;   ///< what a member of a hinge has offered already
  std::vector<Real> distance;  ///< read-out of one piece
  std::vector<Index> label;
};

/// The distance of every vertex of a mixed domain from the nearest of `sources`; sources, vertices
/// and simplices by their numbers in the domain (MixedComplex::Piece gives them).
///
/// Each piece is propagated on by the default rule of its kind. Where pieces are welded, labels
/// cross in both directions until none improves any more: over a vertex the path bends there; over
/// an edge or a face the virtual source is handed on, unfolded about it.
///
/// As for surfaces, with these differences: only Visibility::saddles, and no Schedule::priority
/// (UsageError); max_expansions may be overrun by 65536 a piece; a few allocations a piece.
template <class Real>
void propagate(Serial, const MixedComplex<Real>& domain, std::span<const PointSource> sources,
               const PropagateOptions& options, MixedWorkspace<Real>& workspace,
               DistanceField<Real>& field);

/// The same with a workspace of its own.
template <class Real>
[[nodiscard]] DistanceField<Real> propagate(Serial executor, const MixedComplex<Real>& domain,
                                            std::span<const PointSource> sources,
                                            const PropagateOptions& options = {});

/// From a single source.
template <class Real>
[[nodiscard]] DistanceField<Real> propagate(Serial executor, const MixedComplex<Real>& domain,
                                            const PointSource& source,
                                            const PropagateOptions& options = {}) {
  return propagate(executor, domain, std::span<const PointSource>(&source, 1), options);
}

}  // namespace plexway
