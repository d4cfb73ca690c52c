#include "tool/report/console.hpp"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <system_error>

#include <plexway/error.hpp>

#include "shape/modules/module.hpp"

namespace plexway::cli {
namespace {

[[noreturn]] void refused(int code) {
  if (code == EPIPE) throw OutputClosed{};
  throw Error("cannot write standard output: " + std::generic_category().message(code));
}

// Held back until this returns, and then what it is by default.
void end_by(int signal) {
  remove_unfinished_files();
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

}  // namespace

void write_output(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size()) refused(errno);
}

void flush_output() {
  if (std::fflush(stdout) != 0) refused(errno);
}

void write_diagnostics(std::string_view text) noexcept {
  std::fwrite(text.data(), 1, text.size(), stderr);
}

void say(std::string_view kind, std::string_view message) noexcept {
  std::fprintf(stderr, "plexway: %.*s: ", static_cast<int>(kind.size()), kind.data());
  for (const char c : message) {
    // File names may hold anything; a line stays a line, and a terminal gets no commands.
    const auto byte = static_cast<unsigned char>(c);
    std::fputc(byte < 0x20 || byte == 0x7F ? '?' : c, stderr);
  }
  std::fputc('\n', stderr);
}

void ignore_signals_of_writing() {
#ifdef SIGPIPE
  std::signal(SIGPIPE, SIG_IGN);
#endif
#ifdef SIGXFSZ
  std::signal(SIGXFSZ, SIG_IGN);
#endif
}

void leave_nothing_behind() {
  for (const int signal : {SIGINT, SIGTERM
#ifdef SIGHUP
                           ,
                           SIGHUP
#endif
       })
    if (std::signal(signal, end_by) == SIG_IGN) std::signal(signal, SIG_IGN);
}

}  // namespace plexway::cli
