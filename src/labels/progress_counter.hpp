#pragma once

#include <cstddef>
#include <string>

#include <plexway/error.hpp>
#include <plexway/solve/options.hpp>

namespace plexway::detail {

/// Tells the caller, who must want to know. Throws Cancelled where that is the answer.
inline void tell_progress(const PropagateOptions& options, const Progress& progress) {
  if (!options.progress(progress)) throw Cancelled("cancelled by the progress callback");
}

/// Tells the caller how far a solve is, if wanted, once in so many expansions.
class ProgressCounter {
 public:
  ProgressCounter(const PropagateOptions& options, std::size_t often)
      : options_(options), often_(often) {}

  /// After so many expansions; `progress()` is asked for only when it is told.
  template <class Now>
  void count(std::size_t expansions, const Now& progress) {
    if (!options_.progress || expansions - reported_ < often_) return;
    reported_ = expansions;
    tell_progress(options_, progress());
  }

 private:
  const PropagateOptions& options_;
  std::size_t often_, reported_ = 0;
};

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

}  // namespace plexway::detail
