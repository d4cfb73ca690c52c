#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <string_view>

#include <plexway/solve/options.hpp>

#include "shape/stopwatch.hpp"

namespace plexway::cli {

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

}  // namespace plexway::cli
