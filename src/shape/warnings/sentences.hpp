#pragma once

#include <cstddef>
#include <string>

#include <plexway/shape/cloud_shape.hpp>
#include <plexway/shape/warnings.hpp>

namespace plexway {

/// How the points kept came from those in the file, for people: "5120 of 20000 points: 3 not
/// finite, 17 outliers"; empty where all were kept.
std::string kept_points(const CloudShape& cloud);

/// Why some points are not reached, and what would help, for people. `components` are those of the
/// complex. Cost: several times that of finding the neighbours.
std::string why_disconnected(const CloudShape& cloud, std::size_t components, Reader reader);

/// For people: paths were to be refracted in a solid, and are not.
[[nodiscard]] std::string smoothed_sentence();
/// For people, where lengths break the triangle inequality; else empty.
[[nodiscard]] std::string violations_sentence(const AnyDomain& domain);

}  // namespace plexway
