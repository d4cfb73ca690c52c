#pragma once

namespace plexway::cli {

/// The whole tool: parses, runs, reports errors as one line on stderr. Returns the exit code; no
/// exception leaves it.
int run(int argc, const char* const* argv) noexcept;

}  // namespace plexway::cli
