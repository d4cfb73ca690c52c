#pragma once

#include <cstddef>

#include <plexway/any_domain.hpp>

namespace plexway {

/// So many simplices and so many sources are worth several threads. Measured by bench executors on
/// two cores, in rounds: 2M triangles from one source 0.5 times as fast as Serial, from 1000
/// sources 1.9 times.
inline constexpr std::size_t auto_simplices = 100'000, auto_sources = 64;
/// In pieces so many simplices are, from one source. Of bench pieces: by counts 1.7 times as fast
/// on 400k triangles; by the clock 1.25 times on 840k.
inline constexpr std::size_t auto_in_pieces = 400'000;

/// Serial or `team`, whichever solves ONE field of so many sources sooner.
[[nodiscard]] AnyExecutor fastest_executor(const AnyDomain& domain, std::size_t sources,
                                           const PropagateOptions& options, const OpenMP& team);

}  // namespace plexway
