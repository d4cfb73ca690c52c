#pragma once

/// @file
/// Clouds of points. Link plexway::apps and plexway::io.
#include <plexway/apps/cloud_path_field.hpp>
#include <plexway/complex/distinct_points.hpp>
#include <plexway/complex/neighbours.hpp>
#include <plexway/complex/normals.hpp>
#include <plexway/complex/point_cloud.hpp>
#include <plexway/io/field.hpp>
#include <plexway/io/points.hpp>
#include <plexway/solve.hpp>
