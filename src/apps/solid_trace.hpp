#pragma once

#include <plexway/apps/path.hpp>
#include <plexway/complex/tet_mesh.hpp>
#include <plexway/source/point_source.hpp>

#include "apps/solved.hpp"

namespace plexway {

/// The way from a point of a solved solid back to its source. Empty where none leads.
template <class Real>
Path trace_solid(const TetMesh<Real>& mesh, const Solved<Real>& solved, const PointSource& point);

}  // namespace plexway
