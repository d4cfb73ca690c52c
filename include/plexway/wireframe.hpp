#pragma once

/// @file
/// Wireframes: all for edges. Link plexway::apps and plexway::io.
#include <plexway/common/closest.hpp>
#include <plexway/io/edges.hpp>
#include <plexway/io/field.hpp>
#include <plexway/metric/edge_lengths.hpp>
#include <plexway/paths/path_field.hpp>
#include <plexway/solve.hpp>
#include <plexway/wireframe/wireframe.hpp>
