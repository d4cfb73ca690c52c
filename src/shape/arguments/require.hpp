#pragma once

#include <string>

#include <plexway/error.hpp>
#include <plexway/support.hpp>

namespace plexway {

/// Throws UsageError "NAME: sentence" unless it is yes; the name is an option's, or a file's.
inline void require(const std::string& name, Support support) {
  if (!support) throw UsageError(name + ": " + support.sentence());
}

/// The same where a file is to blame: InputError.
inline void require_input(const std::string& name, Support support) {
  if (!support) throw InputError(name + ": " + support.sentence());
}

}  // namespace plexway
