#pragma once

#include <cstddef>

#include <plexway/error.hpp>
#include <plexway/solve/options.hpp>

namespace plexway {

/// Tells the caller, who must want to know. Throws Cancelled where that is the answer.
inline void tell_progress(const PropagateOptions& options, const Progress& progress) {
  if (!options.progress(progress)) throw Cancelled("cancelled by the progress callback");
}

/// Tells the caller how far a solve is, if wanted, once in so many expansions.
class ProgressCounter {
 public:
  ProgressCounter(const PropagateOptions& options, std::size_t often)
      : options_(options), often_(often) {}

  /// Counts from 0 again.
  void restart() { reported_ = 0; }
  /// After so many expansions since then; `progress()` is asked for only when it is told.
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

}  // namespace plexway
