#pragma once

/// @file
/// Wireframes: all for edges. Link plexway::apps and plexway::io.
#include <plexway/apps/path_field.hpp>
#include <plexway/complex/closest.hpp>
#include <plexway/complex/wireframe.hpp>
#include <plexway/io/edges.hpp>
#include <plexway/io/field.hpp>
#include <plexway/metric/edge_lengths.hpp>
#include <plexway/solve.hpp>
