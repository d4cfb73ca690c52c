#pragma once

/// @file
/// Simplices of dimension 1 to 4. Link plexway::apps and plexway::io.
#include <plexway/io/simplices.hpp>
#include <plexway/simplicial/kuhn_grid.hpp>
#include <plexway/simplicial/simplicial_complex.hpp>
#include <plexway/solve.hpp>
