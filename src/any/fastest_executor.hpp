#pragma once

#include <cstddef>

#include <plexway/any_domain.hpp>

namespace plexway {

/// So many simplices are worth several threads; and, where they go in rounds and not in pieces, so
/// many sources. Of bench_pieces: counts alone make two threads 1.5 times as fast as Serial on 86k
/// triangles, 1.7 times on 400k. Of bench_executors, in rounds: one source 0.5 times, 1000 sources
/// 1.9 times.
inline constexpr std::size_t auto_simplices = 100'000, auto_sources = 64;

/// Serial or `team`, whichever solves ONE field of so many sources sooner.
[[nodiscard]] AnyExecutor fastest_executor(const AnyDomain& domain, std::size_t sources,
                                           const PropagateOptions& options, const OpenMP& team);

}  // namespace plexway
