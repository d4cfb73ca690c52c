#pragma once

/// @file
/// Surfaces: all for triangles, but for pictures and other kinds of domains. Link plexway::apps and plexway::io.
#include <plexway/apps/isolines.hpp>
#include <plexway/apps/path_field.hpp>
#include <plexway/apps/path_search.hpp>
#include <plexway/apps/shorten.hpp>
#include <plexway/complex/closest.hpp>
#include <plexway/complex/intrinsic_delaunay.hpp>
#include <plexway/complex/triangle_mesh.hpp>
#include <plexway/io/field.hpp>
#include <plexway/io/triangles.hpp>
#include <plexway/metric/edge_lengths.hpp>
#include <plexway/solve.hpp>
