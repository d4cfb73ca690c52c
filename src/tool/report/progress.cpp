#include "tool/report/progress.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "tool/report/console.hpp"

namespace plexway::cli {

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

}  // namespace plexway::cli
