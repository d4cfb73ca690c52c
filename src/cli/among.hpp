#pragma once

#include <functional>

#include <plexway/apps/row_ranks.hpp>

namespace plexway::cli {

/// Where this process is one of several that run the same command.
struct Among {
  RowRanks& ranks;
  int threads;  ///< of this one, unless the command says how many
  /// The command is through, or failed with a message. Says it, if it is for this process to say,
  /// and returns the exit code.
  std::function<int(int code, const char* message)> ended;
};

}  // namespace plexway::cli
