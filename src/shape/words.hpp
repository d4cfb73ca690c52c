#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include <plexway/shape/cloud_shape.hpp>
#include <plexway/shape/warnings.hpp>

namespace plexway {

/// "triangle" for "triangles"; knows "vertices" and "tetrahedra" too.
std::string singular(std::string_view plural);
/// "1 triangle", "2 triangles"; the plural is given.
std::string counted(std::size_t count, std::string_view plural);
/// Four significant digits, for people: "0.01234", "1.235e-07", "inf".
std::string short_number(double value);
/// "1.23 s", "4.5 ms".
std::string short_time(double seconds);

/// How the points kept came from those in the file, for people: "5120 of 20000 points: 3 not
/// finite, 17 outliers"; empty where all were kept.
std::string kept_points(const CloudShape& cloud);

/// Why some points are not reached, and what would help, for people. `components` are those of the
/// complex. Cost: several times that of finding the neighbours.
std::string why_disconnected(const CloudShape& cloud, std::size_t components, Reader reader);

}  // namespace plexway
