#pragma once

/// @file
/// Domains whose parts have different dimensions. Link plexway::apps and plexway::io.
#include <plexway/io/mixed.hpp>
#include <plexway/mixed/mixed_complex.hpp>
#include <plexway/paths/mixed_path_field.hpp>
#include <plexway/solve.hpp>
