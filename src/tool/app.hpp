#pragma once

namespace plexway::cli {

struct Among;

/// The whole tool: parses, runs, reports errors as one line on stderr. Returns the exit code; no
/// exception leaves it.
int run(int argc, const char* const* argv, const Among* among = nullptr) noexcept;

}  // namespace plexway::cli
