#pragma once

#include <plexway/apps/path.hpp>
#include <plexway/complex/wireframe.hpp>
#include <plexway/source/point_source.hpp>

#include "apps/solved.hpp"

namespace plexway {

/// The way from a point of a solved wireframe back to its source, over falling distances. Empty
/// where none leads.
template <class Real>
Path trace_wire(const Wireframe<Real>& wireframe, const Solved<Real>& solved,
                const PointSource& point);

}  // namespace plexway
