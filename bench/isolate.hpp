#pragma once

#include <poll.h>
#include <signal.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <exception>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

namespace bench {

/// Runs `work` in a process of its own and hands back the JSON object it returns, or one with the
/// key `note` that says what happened: a message of an exception, a crash, no end after `limit`
/// seconds. So a peer that crashes or hangs costs one row, and each row starts with the same heap.
template <class Work>
nlohmann::ordered_json isolated(double limit, const Work& work) {
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) throw std::runtime_error("cannot make a pipe");
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("cannot start a process");
  if (child == 0) {
    close(ends[0]);
    nlohmann::ordered_json result;
    try {
      result = work();
    } catch (const std::exception& error) {
      std::string message = error.what();
      std::replace(message.begin(), message.end(), '\n', ' ');
      result = {{"note", "refused: " + message}};
    }
    const std::string text = result.dump();
    for (std::size_t sent = 0; sent < text.size();) {
      const ssize_t n = write(ends[1], text.data() + sent, text.size() - sent);
      if (n < 0) _exit(1);
      sent += static_cast<std::size_t>(n);
    }
    _exit(0);
  }

  close(ends[1]);
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                      std::chrono::duration<double>(limit));
  std::string text;
  std::array<char, 4096> buffer{};
  bool late = false;
  for (;;) {
    const auto left =
        std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now()).count();
    late = left <= 0;
    if (late) break;
    pollfd waiting{ends[0], POLLIN, 0};
    const int ready = poll(&waiting, 1, static_cast<int>(std::min<long long>(left, 1000)));
    if (ready < 0 && errno != EINTR) break;
    if (ready <= 0) continue;
    const ssize_t n = read(ends[0], buffer.data(), buffer.size());
    if (n <= 0) break;
    text.append(buffer.data(), static_cast<std::size_t>(n));
  }
  close(ends[0]);
  if (late) kill(child, SIGKILL);
  int status = 0;
  waitpid(child, &status, 0);
  if (late) return {{"note", "stopped after " + std::to_string(static_cast<int>(limit)) + " s"}};
  if (WIFSIGNALED(status))
    return {{"note", std::string("crashed: ") + strsignal(WTERMSIG(status))}};
  auto result = nlohmann::ordered_json::parse(text, nullptr, false);
  if (result.is_discarded()) return {{"note", "ended without an answer"}};
  return result;
}

}  // namespace bench
