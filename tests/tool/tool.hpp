#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace cli_testing {

/// What a run of the tool left behind.
struct Outcome {
  int code = -1;    ///< exit code; 128 + N where signal N ended it
  std::string out;  ///< standard output
  std::string err;  ///< standard error

  [[nodiscard]] nlohmann::json json() const { return nlohmann::json::parse(out); }
  /// Lines on standard error.
  [[nodiscard]] std::size_t complaints() const;
};

using Words = std::vector<std::string>;

/// Runs the tool as a process of its own, without a shell and without a terminal.
Outcome run_tool(const Words& arguments);

/// The same, which must succeed.
Outcome ran(const Words& arguments);

/// The distances that `distance` with these arguments writes.
std::vector<double> distances(const Words& arguments);

/// The tool must end with this exit code and one line that has `part`, and write nothing else.
void check_refused(const Words& arguments, int code, const std::string& part = "");
void check_refused(const Outcome& run, int code, const std::string& part = "");

/// One after the other.
Words joined(Words first, const Words& then);

/// The same, with standard output connected to what a shell would write as `> FILE`.
Outcome run_tool_into(const std::string& file, const Words& arguments);

/// The same, with a standard output whose reader is gone.
Outcome run_tool_into_closed_pipe(const Words& arguments);

/// The same, with a terminal as standard error.
Outcome run_tool_on_terminal(const Words& arguments);

/// The same, killed (SIGKILL) after so many milliseconds if it still runs then.
Outcome run_tool_and_kill(const Words& arguments, int milliseconds);

/// The same, where no file may be longer than so many bytes: a disk that gets full.
Outcome run_tool_with_small_files(const Words& arguments, std::size_t bytes);

/// The path of a sample in data/.
std::string sample(const std::string& name);

/// The values of the column named `column` in a CSV text with a header.
std::vector<double> csv_column(const std::string& csv, const std::string& column);

/// An OFF file of the square [0, 1]^2 in the plane z = 0: n x n vertices, row by row.
std::string square_off(int n);

}  // namespace cli_testing
