#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include <plexway/error.hpp>
#include <plexway/executors/piece_ranks.hpp>
#include <plexway/pairs/row_ranks.hpp>

namespace CLI {
class App;
}

namespace plexway::detail::cli {

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

/// What the command line asks for; set while it is parsed, run afterwards.
using Action = std::function<void()>;

void add_distance_command(CLI::App& tool, Action& action, const Among* among);
void add_info_command(CLI::App& tool, Action& action);
void add_bench_command(CLI::App& tool, Action& action);
void add_path_command(CLI::App& tool, Action& action);
void add_tetrahedralize_command(CLI::App& tool, Action& action);
void add_convert_command(CLI::App& tool, Action& action);
void add_prepare_command(CLI::App& tool, Action& action);
void add_poisson_command(CLI::App& tool, Action& action);
void add_cvt_command(CLI::App& tool, Action& action);
void add_farthest_command(CLI::App& tool, Action& action);
void add_pairs_command(CLI::App& tool, Action& action, const Among* among);
void add_tune_command(CLI::App& tool, Action& action);

/// A manual page ("man") or completions for a shell ("bash", "zsh", "fish"), made from the options
/// that the tool has. Throws UsageError for another kind.
std::string help_page(const CLI::App& tool, std::string_view kind);

/// What `-h` prints of a command: its usage, the options that most need and three examples, in at
/// most 25 lines of 80 columns. Of the tool itself its commands. `--help` has everything.
std::string short_help(const CLI::App& app);

}  // namespace plexway::detail::cli
