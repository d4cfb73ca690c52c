#pragma once

#include <span>
#include <string>
#include <vector>

#include <plexway/source/point_source.hpp>

#include <plexway/shape/shape.hpp>

namespace plexway {

/// Points of a domain out of FILE: a vertex (0-based) a line, or the .csv that `farthest`,
/// `poisson` and `cvt` write. `role` is the option it came by. Throws InputError "FILE:LINE:
/// cause".
[[nodiscard]] std::vector<PointSource> read_point_list(const std::string& file,
                                                       const AnyShape& domain);

/// The same where only vertices will do. Throws InputError for another point.
[[nodiscard]] std::vector<Index> read_vertex_list(const std::string& file, const AnyShape& domain,
                                                  const std::string& role);

}  // namespace plexway
