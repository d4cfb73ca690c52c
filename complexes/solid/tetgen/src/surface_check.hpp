#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include <plexway/tetgen/piecewise_linear_complex.hpp>

#include "isolated_run.hpp"

namespace plexway::tetgen {

/// Throws InputError naming the vertex whose coordinates are not finite, or the row of `what`.
void require_finite(std::span<const std::array<double, 3>> points, const char* what);

/// The first vertex, in the caller's order, that lies exactly where vertex v does; one a vertex.
/// Cost: O(n log n).
std::vector<Index> weld(std::span<const std::array<double, 3>> positions);

/// Throws InputError naming the triangle or edge unless all indices are in range, no triangle has a
/// vertex twice or is there twice, and every edge has at least two triangles, all after `welded`.
/// Cost: O(n log n).
void require_closed(std::span<const std::array<Index, 3>> triangles,
                    const std::vector<Index>& welded);

/// The same of what a complex can be checked for: indices in range, facets with corners.
void require_sound(const PiecewiseLinearComplex& complex);

/// Throws what went wrong with `run` in plain words: InputError where the input is to blame, which
/// names the first facets that cross if `diagnosis` (a run with TetGen's switch -d) found any, and
/// Error or std::bad_alloc where it is not. `facet` is what a facet is called.
[[noreturn]] void give_reason(const Run& run, const Run& diagnosis, const std::string& facet);

}  // namespace plexway::tetgen
