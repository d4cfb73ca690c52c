#pragma once

#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

#include "tool/program.hpp"

/// The tool among ranks, by mpirun. Where mpirun does not run a case says so and is through.
namespace mpi_testing {

using namespace cli_testing;
namespace fs = std::filesystem;
using Words = std::vector<std::string>;

inline Words operator+(Words a, const Words& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

inline std::string content(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// mpirun with what lets it run here, or nothing.
inline const std::optional<Words>& mpirun() {
  static const std::optional<Words> found = []() -> std::optional<Words> {
    Words words = {PLEXWAY_TEST_MPIRUN};
    const Outcome version = run_program(words + Words{"--version"});
    if (version.out.find("Open MPI") != std::string::npos ||
        version.out.find("OpenRTE") != std::string::npos) {
      words.push_back("--oversubscribe");
      if (::geteuid() == 0) words.push_back("--allow-run-as-root");
    }
    if (run_program(words + Words{"-n", "2", "true"}).code == 0) return words;
    return std::nullopt;
  }();
  if (!found) WARN("not tested: " << PLEXWAY_TEST_MPIRUN << " runs nothing here");
  return found;
}

inline Outcome run_ranks(int count, const Words& arguments, std::size_t file_bytes = 0) {
  return run_program(
      *mpirun() + Words{"-n", std::to_string(count), PLEXWAY_TEST_MPI_TOOL} + arguments,
      file_bytes);
}

// Lines that are ours: mpirun adds some of its own where ranks fail.
inline std::vector<std::string> complaints(const Outcome& run) {
  std::vector<std::string> ours;
  for (std::size_t at = 0; (at = run.err.find("plexway: ", at)) != run.err.npos; at += 9)
    if (at == 0 || run.err[at - 1] == '\n')
      ours.push_back(run.err.substr(at, run.err.find('\n', at) - at));
  return ours;
}

// A run ended with the code, and one complaint that says why.
inline void check_complaint(const Outcome& run, int code, const std::string& why) {
  CAPTURE(run.err, why);
  CHECK(run.code == code);
  const auto lines = complaints(run);
  REQUIRE(lines.size() == 1);
  CHECK(lines[0].find(why) != std::string::npos);
}
// So does mpirun with these words.
inline void check_complaint(const Words& words, int code, const std::string& why) {
  check_complaint(run_program(*mpirun() + words), code, why);
}

// Two ranks of the tool, of which one is killed after a while, given to sleep or the like.
inline Outcome run_with_one_killed(const Words& tool, const std::string& a_while) {
  const std::string script =
      "\"$@\" & rank=$!\n" + a_while + "\nkill -9 $rank 2>/dev/null\nwait $rank";
  const Outcome killed = run_program(*mpirun() + Words{"-n", "1"} + tool +
                                     Words{":", "-n", "1", "sh", "-c", script, "sh"} + tool);
  if (killed.code != 0) CHECK(killed.err.find("mpi") != std::string::npos);  // it says that one did
  return killed;
}

}  // namespace mpi_testing
