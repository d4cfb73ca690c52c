#pragma once

#include <string>

#include <plexway/error.hpp>
#include <plexway/support.hpp>

namespace plexway {

/// Throws UsageError "OPTION: sentence" unless it is yes.
inline void require(const char* option, Support support) {
  if (!support) throw UsageError(std::string(option) + ": " + support.sentence());
}

}  // namespace plexway
