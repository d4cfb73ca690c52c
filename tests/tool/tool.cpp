#include "tool/tool.hpp"
#include "tool/program.hpp"

#include <fcntl.h>
#include <poll.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <chrono>
#include <csignal>
#include <sstream>
#include <thread>
#include <utility>

namespace cli_testing {
namespace {

// Both ends of something to read from a child, closed at the end.
struct Channel {
  int read = -1;
  int write = -1;
  Channel() = default;
  Channel(int r, int w) : read(r), write(w) {}
  Channel(const Channel&) = delete;
  Channel& operator=(const Channel&) = delete;
  ~Channel() {
    close_end(read);
    close_end(write);
  }
  static void close_end(int& end) {
    if (end >= 0) ::close(end);
    end = -1;
  }
  void make_pipe() {
    std::array<int, 2> ends = {-1, -1};
    REQUIRE(::pipe2(ends.data(), O_CLOEXEC) == 0);
    read = ends[0];
    write = ends[1];
  }
  void make_terminal() {
    read = ::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
    REQUIRE(read >= 0);
    REQUIRE(::grantpt(read) == 0);
    REQUIRE(::unlockpt(read) == 0);
    write = ::open(::ptsname(read), O_RDWR | O_NOCTTY | O_CLOEXEC);
    REQUIRE(write >= 0);
  }
};

// Reads both to their ends, whichever has something, so that neither can fill up and block.
void drain(Channel& out, Channel& err, Outcome& outcome) {
  std::array<std::pair<Channel*, std::string*>, 2> open = {
      {{&out, &outcome.out}, {&err, &outcome.err}}};
  while (out.read >= 0 || err.read >= 0) {
    std::array<pollfd, 2> wait = {{{out.read, POLLIN, 0}, {err.read, POLLIN, 0}}};
    if (::poll(wait.data(), wait.size(), -1) < 0) continue;
    for (std::size_t i = 0; i < 2; ++i) {
      if (wait[i].fd < 0 || wait[i].revents == 0) continue;
      std::array<char, 4096> bytes;
      const ssize_t got = ::read(wait[i].fd, bytes.data(), bytes.size());
      if (got > 0)
        open[i].second->append(bytes.data(), static_cast<std::size_t>(got));
      else
        Channel::close_end(open[i].first->read);
    }
  }
}

// What may cut a run short; 0 is nothing.
struct Limits {
  int milliseconds = 0;
  std::size_t file_bytes = 0;
};

Outcome run_words(std::vector<std::string> words, Channel& out, Channel& err,
                  const Limits& limits = {}) {
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);

  const pid_t child = ::fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    const int nothing = ::open("/dev/null", O_RDONLY);
    ::dup2(nothing, STDIN_FILENO);
    ::dup2(out.write, STDOUT_FILENO);
    ::dup2(err.write, STDERR_FILENO);
    std::signal(SIGPIPE, SIG_DFL);
    if (limits.file_bytes > 0) {
      const rlimit most = {limits.file_bytes, limits.file_bytes};
      ::setrlimit(RLIMIT_FSIZE, &most);
    }
    ::execvp(argv[0], argv.data());
    ::_exit(127);
  }
  Channel::close_end(out.write);
  Channel::close_end(err.write);
  std::thread killer;
  if (limits.milliseconds > 0)
    killer = std::thread([child, &limits] {
      std::this_thread::sleep_for(std::chrono::milliseconds(limits.milliseconds));
      ::kill(child, SIGKILL);  // at worst a child that ended and still waits to be asked for
    });
  Outcome outcome;
  drain(out, err, outcome);
  if (killer.joinable()) killer.join();
  int status = 0;
  REQUIRE(::waitpid(child, &status, 0) == child);
  outcome.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return outcome;
}

Outcome run(const std::vector<std::string>& arguments, Channel& out, Channel& err,
            const Limits& limits = {}) {
  std::vector<std::string> words = {PLEXWAY_TEST_TOOL};
  words.insert(words.end(), arguments.begin(), arguments.end());
  return run_words(std::move(words), out, err, limits);
}

}  // namespace

std::size_t Outcome::complaints() const {
  return static_cast<std::size_t>(std::count(err.begin(), err.end(), '\n'));
}

Outcome run_tool(const Words& arguments) {
  Channel out, err;
  out.make_pipe();
  err.make_pipe();
  return run(arguments, out, err);
}

Outcome ran(const Words& arguments) {
  const Outcome run = run_tool(arguments);
  CAPTURE(arguments, run.err);
  REQUIRE(run.code == 0);
  return run;
}

std::vector<double> distances(const Words& arguments) {
  const Outcome run = ran(joined(joined({"distance"}, arguments), {"--quiet", "--out", "-"}));
  CHECK(run.err.empty());
  return csv_column(run.out, "distance");
}

void check_refused(const Words& arguments, int code, const std::string& part) {
  CAPTURE(arguments);
  check_refused(run_tool(arguments), code, part);
}

void check_refused(const Outcome& run, int code, const std::string& part) {
  INFO(run.err);
  CHECK(run.code == code);
  CHECK(run.out.empty());
  CHECK(run.complaints() == 1);
  CHECK(run.err.starts_with("plexway: error: "));
  CHECK_THAT(run.err, Catch::Contains(part));
}

Words joined(Words first, const Words& then) {
  first.insert(first.end(), then.begin(), then.end());
  return first;
}

Outcome run_program(const std::vector<std::string>& words, std::size_t file_bytes) {
  Channel out, err;
  out.make_pipe();
  err.make_pipe();
  return run_words(words, out, err, {.file_bytes = file_bytes});
}

Outcome run_tool_into(const std::string& file, const Words& arguments) {
  Channel out(-1, ::open(file.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0644));
  REQUIRE(out.write >= 0);
  Channel err;
  err.make_pipe();
  return run(arguments, out, err);
}

Outcome run_tool_into_closed_pipe(const Words& arguments) {
  Channel out, err;
  out.make_pipe();
  Channel::close_end(out.read);
  err.make_pipe();
  return run(arguments, out, err);
}

Outcome run_tool_and_kill(const Words& arguments, int milliseconds) {
  Channel out, err;
  out.make_pipe();
  err.make_pipe();
  return run(arguments, out, err, {.milliseconds = milliseconds});
}

Outcome run_tool_with_small_files(const Words& arguments, std::size_t bytes) {
  Channel out, err;
  out.make_pipe();
  err.make_pipe();
  return run(arguments, out, err, {.file_bytes = bytes});
}

Outcome run_tool_on_terminal(const Words& arguments) {
  Channel out, err;
  out.make_pipe();
  err.make_terminal();
  return run(arguments, out, err);
}

std::string sample(const std::string& name) {
  return std::string(PLEXWAY_SOURCE_DIR) + "/data/" + name;
}

std::vector<double> csv_column(const std::string& csv, const std::string& column) {
  std::istringstream lines(csv);
  std::string line;
  std::getline(lines, line);
  const auto cells_of = [](const std::string& text) {
    std::vector<std::string> cells;
    std::istringstream in(text);
    for (std::string cell; std::getline(in, cell, ',');) cells.push_back(cell);
    return cells;
  };
  const auto header = cells_of(line);
  const auto at = std::find(header.begin(), header.end(), column) - header.begin();
  INFO(line);
  REQUIRE(static_cast<std::size_t>(at) < header.size());
  std::vector<double> values;
  while (std::getline(lines, line))
    values.push_back(std::stod(cells_of(line).at(static_cast<std::size_t>(at))));
  return values;
}

std::string square_off(int n) {
  std::ostringstream off;
  off.precision(17);
  off << "OFF\n" << n * n << ' ' << 2 * (n - 1) * (n - 1) << " 0\n";
  for (int y = 0; y < n; ++y) {
    for (int x = 0; x < n; ++x)
      off << x / static_cast<double>(n - 1) << ' ' << y / static_cast<double>(n - 1) << " 0\n";
  }
  for (int y = 0; y + 1 < n; ++y) {
    for (int x = 0; x + 1 < n; ++x) {
      const int v = y * n + x;
      off << "3 " << v << ' ' << v + 1 << ' ' << v + n << '\n';
      off << "3 " << v + 1 << ' ' << v + n + 1 << ' ' << v + n << '\n';
    }
  }
  return off.str();
}

}  // namespace cli_testing
