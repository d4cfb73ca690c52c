#pragma once

#include <array>
#include <string_view>

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

/// Each code as help and the manual page have it, and in full as the manual page and
/// docs/reference/exit-codes.md have it.
struct ExitCodeMeaning {
  ExitCode code;
  std::string_view brief, meaning;
};

inline constexpr std::array exit_codes{
    ExitCodeMeaning{exit_ok, "ok", "done"},
    ExitCodeMeaning{exit_failure, "failure",
                    "failure: a file or standard output could not be written, no memory left"},
    ExitCodeMeaning{exit_usage, "usage",
                    "usage: an unknown command, option or value, or an extension of --out that is "
                    "not known"},
    ExitCodeMeaning{
        exit_bad_input, "bad input",
        "bad input: a file that is missing, malformed or of unknown extension, a source "
        "out of range, a surface that cannot be filled, a bad truth file"},
    ExitCodeMeaning{
        exit_not_built, "not built in",
        "not built in: a kind of domain, an executor or a library that this build lacks"},
    ExitCodeMeaning{exit_nothing_reached, "nothing reached",
                    "nothing reached: no vertex but the source itself has a finite distance"},
    ExitCodeMeaning{
        exit_endless, "without end",
        "without end: labels kept improving far beyond what any input is known to need; "
        "distances are not written"},
};

/// No vertex but the sources themselves has a finite distance.
class NothingReached : public Error {
 public:
  using Error::Error;
};

}  // namespace plexway::cli
