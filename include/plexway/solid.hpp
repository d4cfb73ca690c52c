#pragma once

/// @file
/// Solids: all for tetrahedra. Link plexway::apps and plexway::io.
#include <plexway/apps/isosurfaces.hpp>
#include <plexway/apps/path_field.hpp>
#include <plexway/complex/closest.hpp>
#include <plexway/complex/tet_mesh.hpp>
#include <plexway/io/field.hpp>
#include <plexway/io/tets.hpp>
#include <plexway/metric/edge_lengths.hpp>
#include <plexway/solve.hpp>
