#pragma once

#include <array>
#include <span>
#include <vector>

#include <plexway/apps/path.hpp>
#include <plexway/complex/ids.hpp>

namespace plexway {

/// The lines on a surface where a field has given values, each as long as it goes on; a closed one
/// ends where it begins. Between vertices the field is linear, so a line is straight in a triangle;
/// triangles with a corner that is not reached have none.
///
/// Shapes: n positions and distances, m faces of vertices < n. The lines come value by value;
/// Path::source is the place of the value in the list, and Path::length that of the line. Write
/// them with io::write_paths. Throws UsageError for other counts, a face of a vertex that is not
/// there, or a value that is not finite. Cost: linear in m for each value.
[[nodiscard]] std::vector<Path> isolines(std::span<const std::array<double, 3>> positions,
                                         std::span<const std::array<Index, 3>> faces,
                                         std::span<const double> distance,
                                         std::span<const double> values);

}  // namespace plexway
