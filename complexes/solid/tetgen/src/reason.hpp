#pragma once

#include "isolated_run.hpp"

namespace plexway::tetgen {

/// Throws what went wrong with `run` in plain words: InputError where the input is to blame, which
/// names the first facets that cross if `diagnosis` (a run with TetGen's switch -d) found any, and
/// Error or std::bad_alloc where it is not. `facet` is what a facet is called.
[[noreturn]] void give_reason(const Run& run, const Run& diagnosis, const std::string& facet);

}  // namespace plexway::tetgen
