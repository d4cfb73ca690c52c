#pragma once

/// @file
/// Clouds of points. Link plexway::apps and plexway::io.
#include <plexway/cloud/neighbours.hpp>
#include <plexway/cloud/point_cloud.hpp>
#include <plexway/common/distinct_points.hpp>
#include <plexway/io/field.hpp>
#include <plexway/io/points.hpp>
#include <plexway/paths/cloud_path_field.hpp>
#include <plexway/solve.hpp>
#include <plexway/surface/normals.hpp>
