#pragma once

#include "kernel/hinge.hpp"

namespace plexway {

/// An edge hands its virtual source on over a vertex: the K = 0 hinge kernel, word for word. The
/// hinge is a point, so no straight line passes through: every path bends there, and the new
/// virtual source is the vertex itself. What all edges at a vertex learn from each other is thus a
/// single number, the sigma of that bend: the label belongs to the hinge.
template <class Real>
struct KernelWireStep {
  /// Sigma at the far end of an edge of this length from sigma at its near end.
  static Real over(Real sigma, Real length) {
    using Kernel = kernel::HingeKernel<Real, 0>;
    const Real none_in_a_point[1] = {0};
    const Real squared[1] = {length * length};
    const auto pose = Kernel::make_pose(none_in_a_point);
    const auto S = Kernel::locate(pose, squared);
    return Kernel::carry(pose, S, sigma, S, false, 0).sigma;
  }
};

/// The same, with what K = 0 leaves of it: walk to the hinge. (That this is the relaxation of
/// Dijkstra, A note on two problems in connexion with graphs, 1959, is how the field knows it.)
template <class Real>
struct WireStep {
  static Real over(Real sigma, Real length) { return sigma + length; }
};

}  // namespace plexway
