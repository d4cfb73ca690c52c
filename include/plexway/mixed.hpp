#pragma once

/// @file
/// Domains whose parts have different dimensions. Link plexway::apps and plexway::io.
#include <plexway/apps/mixed_path_field.hpp>
#include <plexway/complex/mixed_complex.hpp>
#include <plexway/io/mixed.hpp>
#include <plexway/solve.hpp>
