#pragma once

#include <string>

#include <plexway/error.hpp>

namespace plexway::testing {

/// What the error of this kind says that `run` throws; empty where it throws none.
template <class E = InputError, class Run>
std::string message_of(const Run& run) {
  try {
    run();
  } catch (const E& error) {
    return error.what();
  }
  return {};
}

}  // namespace plexway::testing
