#pragma once

#include <plexway/paths/path.hpp>
#include <plexway/source/point_source.hpp>
#include <plexway/wireframe/wireframe.hpp>

#include "paths/solved.hpp"

namespace plexway {

/// The way from a point of a solved wireframe back to its source, over falling distances. Empty
/// where none leads.
template <class Real>
Path trace_wire(const Wireframe<Real>& wireframe, const Solved<Real>& solved,
                const PointSource& point);

}  // namespace plexway
