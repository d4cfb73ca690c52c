#pragma once

#include <filesystem>
#include <functional>

#include <plexway/executors/piece_ranks.hpp>
#include <plexway/pairs/row_ranks.hpp>

namespace plexway::cli {

struct Among;

/// The whole tool: parses, runs, reports errors as one line on stderr. Returns the exit code; no
/// exception leaves it.
int run(int argc, const char* const* argv, const Among* among = nullptr) noexcept;

/// Where this process is one of several that run the same command.
struct Among {
  RowRanks& ranks;
  PieceRanks& pieces;
  int threads;  ///< of this one, unless the command says how many
  /// As mpi::Ranks::all_come.
  std::function<void()> all_come;
  /// As mpi::Ranks::once_a_node; empty where no two of them share memory.
  using WithFile = std::function<void(const std::filesystem::path&)>;
  std::function<void(const WithFile& make, const WithFile& take)> once_a_node;
  /// The command is through, or failed with a message. Says it, if it is for this process to say,
  /// and returns the exit code.
  std::function<int(int code, const char* message)> ended;
};

}  // namespace plexway::cli
