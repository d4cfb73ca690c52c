#include "apps/solid_trace.hpp"

namespace plexway {
template <class Real>
Path trace_solid(const TetMesh<Real>&, const Solved<Real>&, const PointSource&) { return {}; }
template Path trace_solid(const TetMesh<float>&, const Solved<float>&, const PointSource&);
template Path trace_solid(const TetMesh<double>&, const Solved<double>&, const PointSource&);
}  // namespace plexway
