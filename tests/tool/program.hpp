#pragma once

#include "tool/tool.hpp"

namespace cli_testing {

/// Runs any program, looked for on the PATH, without a shell; where `file_bytes` is not 0 no file
/// may be longer.
Outcome run_program(const std::vector<std::string>& words, std::size_t file_bytes = 0);

}  // namespace cli_testing
