#pragma once

#include <cstddef>

#include <plexway/any_domain.hpp>

namespace plexway {

/// So many simplices and so many sources are worth several threads.
inline constexpr std::size_t auto_simplices = 100'000, auto_sources = 64;
/// In pieces so many simplices are, from one source (bench executors: 1.4 to 1.7 times as fast).
inline constexpr std::size_t auto_in_pieces = 400'000;

/// Serial or `team`, whichever solves ONE field of so many sources sooner.
[[nodiscard]] AnyExecutor fastest_executor(const AnyDomain& domain, std::size_t sources,
                                           const PropagateOptions& options, const OpenMP& team);

}  // namespace plexway
