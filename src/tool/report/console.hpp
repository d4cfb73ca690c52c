#pragma once

#include <string_view>

#include "file/standard_output.hpp"

namespace plexway::cli {

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

}  // namespace plexway::cli
