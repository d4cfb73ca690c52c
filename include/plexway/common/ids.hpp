#pragma once

#include <cstdint>

namespace plexway {

/// Index of a vertex or a simplex, 0-based.
using Index = std::uint32_t;

/// No vertex, no simplex, no label.
inline constexpr Index none = ~Index{0};

}  // namespace plexway
