#pragma once

/// @file
/// Surfaces: all for triangles, but for pictures and other kinds of domains. Link plexway::apps and
/// plexway::io.
#include <plexway/common/closest.hpp>
#include <plexway/fields/isolines.hpp>
#include <plexway/io/field.hpp>
#include <plexway/io/triangles.hpp>
#include <plexway/metric/edge_lengths.hpp>
#include <plexway/paths/path_field.hpp>
#include <plexway/paths/path_search.hpp>
#include <plexway/paths/shorten.hpp>
#include <plexway/solve.hpp>
#include <plexway/surface/intrinsic_delaunay.hpp>
#include <plexway/surface/triangle_mesh.hpp>
