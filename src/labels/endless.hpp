#pragma once

#include <cstddef>
#include <string>

#include <plexway/error.hpp>

namespace plexway {

/// No solve of so many simplices takes more expansions than this: one to two a simplex are usual,
/// thirty the most seen (first in first out, on a scan). Labels that still gain by then do so
/// because lengths are no metric, or because rounding is as large as the gain.
constexpr std::size_t endless_after(std::size_t simplices) {
  return 512 * simplices + (std::size_t{1} << 20);
}

/// Throws EndlessError if so many expansions are too many.
inline void check_end(std::size_t expansions, std::size_t simplices) {
  if (expansions <= endless_after(simplices)) return;
  throw EndlessError("stopped after " + std::to_string(expansions) + " expansions of " +
                     std::to_string(simplices) +
                     " simplices: labels keep improving without end; look for lengths that are no "
                     "metric, or take double precision");
}

}  // namespace plexway
