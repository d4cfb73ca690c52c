#pragma once

#include <plexway/error.hpp>

namespace plexway::cli {

/// What the process returns.
enum ExitCode : int {
  exit_ok = 0,
  exit_failure = 1,          ///< could not write, out of memory, a fault of ours
  exit_usage = 2,            ///< UsageError: the command line makes no sense
  exit_bad_input = 3,        ///< InputError: a file or a source in it is not what it must be
  exit_not_built = 4,        ///< NotBuiltError: exists, but not in this build
  exit_nothing_reached = 5,  ///< NothingReached
  exit_endless = 6,          ///< EndlessError: a solve that would not end
};

/// No vertex but the sources themselves has a finite distance.
class NothingReached : public Error {
 public:
  using Error::Error;
};

}  // namespace plexway::cli
