#pragma once

/// @file
/// Simplices of dimension 1 to 4. Link plexway::apps and plexway::io.
#include <plexway/complex/kuhn_grid.hpp>
#include <plexway/complex/simplicial_complex.hpp>
#include <plexway/io/simplices.hpp>
#include <plexway/solve.hpp>
