// Signals at random moments. PLEXWAY_KILLS asks for more of them than a run of all tests makes.

#include <dirent.h>
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <catch2/catch.hpp>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "data/shapes.hpp"
#include "io/io_testing.hpp"
#include "tool/tool.hpp"

namespace signals_test {

using namespace cli_testing;
using io_testing::bytes_of;
using io_testing::Folder;
namespace fs = std::filesystem;

namespace {

using Clock = std::chrono::steady_clock;

pid_t start(const std::vector<std::string>& arguments) {
  std::vector<std::string> words = {PLEXWAY_TEST_TOOL};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  const pid_t child = ::fork();
  REQUIRE(child >= 0);
  if (child > 0) return child;
  const int nothing = ::open("/dev/null", O_RDWR);
  for (const int standard : {0, 1, 2}) ::dup2(nothing, standard);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, SIG_DFL);
#ifdef PLEXWAY_SANITIZED  // a signal amid its search for leaks, at the end, is an error to it
  ::setenv("ASAN_OPTIONS", "detect_leaks=0", 1);
#endif
  ::execv(argv[0], argv.data());
  ::_exit(127);
}

int wait_for(pid_t child) {
  int status = 0;
  REQUIRE(::waitpid(child, &status, 0) == child);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

// Whether a helper of that process is there; it may take a moment to go.
bool helper_left(pid_t of) {
  for (int tries = 0; tries < 100; ++tries) {
    bool any = false;
    for (const auto& entry : fs::directory_iterator("/proc")) {
      const std::string words = bytes_of(entry.path() / "cmdline");
      any = any || (words.find("/plexway-") != words.npos &&
                    words.ends_with('\0' + std::to_string(of) + '\0'));
    }
    if (!any) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return true;
}

std::string off_of(const samples::Shape& shape) {
  std::string text = "OFF\n" + std::to_string(shape.points.size()) + ' ' +
                     std::to_string(shape.faces.size()) + " 0\n";
  for (const auto& p : shape.points)
    text += std::to_string(p[0]) + ' ' + std::to_string(p[1]) + ' ' + std::to_string(p[2]) + '\n';
  for (const auto& [a, b, c] : shape.faces)
    text += "3 " + std::to_string(a) + ' ' + std::to_string(b) + ' ' + std::to_string(c) + '\n';
  return text;
}

// A .vdb has a number of its own in its head, 36 characters, that no other file has.
std::string without_own_number(std::string bytes) {
  constexpr std::size_t at = 8 + 4 + 4 + 4 + 1, length = 36;
  if (bytes.starts_with(std::string(" BDV", 4)) && bytes.size() > at + length)
    bytes.erase(at, length);
  return bytes;
}

// What kills of one kind of output left behind.
struct Tally {
  std::string out;
  int ended = 0, finished = 0, helpers = 0, half = 0, others = 0;
};

struct Case {
  std::string out;
  std::vector<std::string> arguments;  // in front of `out`
};

}  // namespace

TEST_CASE("kills at random moments leave the old file or the new one, and no other", "[kills]") {
  const char* const wanted = std::getenv("PLEXWAY_KILLS");
  const int kills = wanted == nullptr ? 4 : std::atoi(wanted);
  const Folder in;
  const std::string grid = in.write("grid.off", square_off(150)).string();
  const std::string ball = in.write("ball.off", off_of(samples::geodesic_sphere(8))).string();
  const std::vector<Case> cases = {
      {"d.csv", {"distance", grid, "--source", "vertex:0", "--out"}},
      {"d.vtu", {"distance", grid, "--source", "vertex:0", "--out"}},
      {"p.png", {"distance", grid, "--source", "vertex:0", "--picture"}},
      {"s.vtu", {"tetrahedralize", ball, "--max-volume", "0.001", "--out"}},
      {"r.ply", {"convert", ball, "--repair", "--voxel", "0.03"}},
      {"d.vdb",
       {"distance", ball, "--as", "solid", "--source", "vertex:0", "--voxel", "0.02", "--out"}},
  };
  std::mt19937 random(5);
  std::vector<Tally> tallies;
  for (const Case& it : cases) {
    const Folder folder;
    const std::string out = folder.at(it.out).string();
    std::vector<std::string> arguments = it.arguments;
    arguments.push_back(out);
    const auto began = Clock::now();
    const int code = wait_for(start(arguments));
    if (code == 4) continue;  // not in this build
    INFO(it.out);
    REQUIRE(code == 0);
    const auto whole_time = Clock::now() - began;
    const std::string whole = without_own_number(bytes_of(out));
    Tally& tally = tallies.emplace_back(Tally{it.arguments[0] + ' ' + it.out});
    for (int n = 0; n < kills; ++n) {
      const bool replaces = n % 2 == 0;
      if (replaces)
        folder.write(it.out, "old");
      else
        fs::remove(out);
      const int signal = std::array{SIGINT, SIGTERM, SIGHUP}[static_cast<std::size_t>(n % 3)];
      const pid_t child = start(arguments);
      const double share = std::uniform_real_distribution(0., 1.05)(random);
      std::this_thread::sleep_for(share * whole_time);
      ::kill(child, signal);
      const int got = wait_for(child);
      INFO("signal " << signal << " at " << share << " of the time, code " << got);
      CHECK((got == 128 + signal || got == 0));
      ++(got == 0 ? tally.finished : tally.ended);
      const bool helper = helper_left(child);
      CHECK_FALSE(helper);
      tally.helpers += helper;
      const std::string left = fs::exists(out) ? without_own_number(bytes_of(out)) : "";
      const bool sound = left == whole || (got != 0 && left == (replaces ? "old" : ""));
      CHECK(sound);
      tally.half += !sound;
      std::vector<std::string> others;
      for (const auto& entry : fs::directory_iterator(folder.path()))
        if (entry.path() != out) others.push_back(entry.path().filename());
      CHECK(others.empty());
      tally.others += !others.empty();
    }
  }
  int ended = 0, finished = 0;
  for (const Tally& tally : tallies) {
    ended += tally.ended;
    finished += tally.finished;
    if (wanted != nullptr)
      std::cout << "kills of " << tally.out << ": " << tally.ended << " ended it, "
                << tally.finished << " too late; temporary files " << tally.others
                << ", half files " << tally.half << ", helpers " << tally.helpers << '\n';
  }
  CHECK(ended > finished);
}

TEST_CASE("signals that the caller ignores stay ignored") {
  const pid_t child = ::fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    std::signal(SIGHUP, SIG_IGN);
    const std::string tool = PLEXWAY_TEST_TOOL, mesh = sample("torus.obj");
    const int nothing = ::open("/dev/null", O_RDWR);
    for (const int standard : {0, 1, 2}) ::dup2(nothing, standard);
    ::execl(tool.c_str(), tool.c_str(), "bench", mesh.c_str(), "--source", "vertex:0", "--repeats",
            "1000000", nullptr);
    ::_exit(127);
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  ::kill(child, SIGHUP);
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  int status = 0;
  CHECK(::waitpid(child, &status, WNOHANG) == 0);  // still at work
  ::kill(child, SIGTERM);
  CHECK(wait_for(child) == 128 + SIGTERM);
}

}  // namespace signals_test
