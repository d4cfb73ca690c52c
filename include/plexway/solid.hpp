#pragma once

/// @file
/// Solids: all for tetrahedra. Link plexway::apps and plexway::io.
#include <plexway/common/closest.hpp>
#include <plexway/fields/isosurfaces.hpp>
#include <plexway/io/field.hpp>
#include <plexway/io/tets.hpp>
#include <plexway/metric/edge_lengths.hpp>
#include <plexway/paths/path_field.hpp>
#include <plexway/solid/tet_mesh.hpp>
#include <plexway/solve.hpp>
