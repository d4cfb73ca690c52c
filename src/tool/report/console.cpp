#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <system_error>

#include <plexway/error.hpp>

#include "shape/modules/module.hpp"
#include "tool/report/console.hpp"

namespace plexway::detail::cli {
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

ProgressLine::ProgressLine(bool quiet)
    : quiet_(quiet), shown_(!quiet && isatty(STDERR_FILENO) == 1) {}

void ProgressLine::phase(std::string_view what) {
  phase_ = what;
  if (shown_) draw(phase_ + " ...");
}

void ProgressLine::done(double share, std::string_view more) {
  using namespace std::chrono_literals;
  if (!shown_ || Clock::now() - drawn_ < 100ms) return;
  const int percent = static_cast<int>(100 * std::clamp(share, 0.0, 1.0));
  std::string text = phase_ + " ... " + std::to_string(percent) + " %";
  if (!more.empty()) text.append(", ").append(more);
  draw(text);
}

void ProgressLine::seconds_passed(double seconds) {
  using namespace std::chrono_literals;
  if (!shown_ || Clock::now() - drawn_ < 100ms) return;
  draw(phase_ + " ... " + std::to_string(static_cast<long>(seconds)) + " s");
}

void ProgressLine::note(std::string_view message) {
  if (quiet_) return;
  if (shown_) std::fputs("\r\033[K", stderr);
  say_note(message);
}

void ProgressLine::clear() {
  if (shown_ && !phase_.empty()) std::fputs("\r\033[K", stderr);
  phase_.clear();
}

void ProgressLine::draw(std::string_view text) {
  // Longer than the terminal is wide would wrap, and then not be overwritten.
  constexpr std::size_t widest = 78;
  std::string line(text);
  if (line.size() > widest) line = line.substr(0, 20) + "..." + line.substr(line.size() - 54);
  for (char& c : line) {
    if (static_cast<unsigned char>(c) < 0x20) c = '?';
  }
  std::fprintf(stderr, "\r\033[K%s", line.c_str());
  std::fflush(stderr);
  drawn_ = Clock::now();
}

std::function<bool(const Progress&)> ProgressLine::callback() {
  if (!shown_) return {};
  return [this](const Progress& progress) {
    done(static_cast<double>(progress.reached) /
         static_cast<double>(std::max<std::size_t>(progress.simplices, 1)));
    return true;
  };
}

}  // namespace plexway::detail::cli
