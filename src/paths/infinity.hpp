#pragma once

#include <limits>

namespace plexway::detail {

/// The distance of what cannot be reached.
inline constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace plexway::detail
