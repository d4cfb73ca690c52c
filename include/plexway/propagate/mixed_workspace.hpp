#pragma once

#include <vector>

#include <plexway/propagate/workspace.hpp>

namespace plexway {

/// All that a propagation over a mixed domain changes. Belongs to one domain and one thread at a
/// time.
template <class Real>
struct MixedWorkspace {
  /// One a piece that is propagated on.
  std::vector<Workspace<Real>> pieces;
  std::vector<Real> offered;   ///< what a member of a hinge has offered already
  std::vector<Real> distance;  ///< read-out of one piece
  /// Its nearest sources.
  std::vector<Index> label;
};

}  // namespace plexway
