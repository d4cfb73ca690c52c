#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <string_view>

#include <plexway/solve/options.hpp>

#include "file/new_file.hpp"

namespace plexway::detail::cli {

using file::OutputClosed;

/// Writes data to standard output. Throws OutputClosed, or Error when the system refuses.
void write_output(std::string_view text);

/// Pushes out what `write_output` holds back. Throws as above.
void flush_output();

/// Writes text for people to standard error.
void write_diagnostics(std::string_view text) noexcept;

/// "plexway: KIND: MESSAGE" as one line on stderr, whatever the message holds.
void say(std::string_view kind, std::string_view message) noexcept;

/// A line about something the user should know; suppressed by --quiet at the caller.
inline void say_note(std::string_view message) noexcept { say("note", message); }
inline void say_error(std::string_view message) noexcept { say("error", message); }

/// Makes a write into a closed pipe, and one beyond the limit of file sizes, errors that we can
/// handle, instead of signals.
void ignore_signals_of_writing();

/// Has SIGINT, SIGTERM and SIGHUP, where they are not ignored, remove temporary files before they
/// end the process as usual.
void leave_nothing_behind();

/// One line on stderr that is overwritten as work goes on, and wiped at the end.
///
/// Shown only where stderr is a terminal; elsewhere, or when `quiet`, it does nothing.
class ProgressLine {
 public:
  explicit ProgressLine(bool quiet);
  ~ProgressLine() { clear(); }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// A new piece of work: "reading knot.ply".
  void phase(std::string_view what);
  /// How much of it is done, 0 to 1, and what else there is to say. Draws at most ten times a
  /// second.
  void done(double share, std::string_view more = {});
  /// How long it has taken, where nobody knows how much is done. Draws as above.
  void seconds_passed(double seconds);
  void clear();
  /// A line that stays, for people; nothing when quiet.
  void note(std::string_view message);

  /// For PropagateOptions::progress; empty where nothing would be shown.
  [[nodiscard]] std::function<bool(const Progress&)> callback();
  /// The same for work that tells its share.
  [[nodiscard]] std::function<bool(double)> share_callback() {
    return [this](double share) {
      done(share);
      return true;
    };
  }

 private:
  using Clock = std::chrono::steady_clock;

  void draw(std::string_view text);

  bool quiet_;
  bool shown_;
  std::string phase_;
  Clock::time_point drawn_;
};

}  // namespace plexway::detail::cli
