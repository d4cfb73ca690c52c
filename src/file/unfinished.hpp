#pragma once

#include <cstddef>

namespace plexway::file {

/// A temporary file that whoever ends this process by a signal should see removed. A list for the
/// whole process, of 64 at most; what does not fit is not on it.
class Unfinished {
 public:
  explicit Unfinished(const char* path);
  ~Unfinished();
  Unfinished(const Unfinished&) = delete;
  Unfinished& operator=(const Unfinished&) = delete;

 private:
  std::size_t place_;
};

/// Removes all files of the list. May be called by a handler of signals.
void remove_unfinished() noexcept;

/// Holds signals that end a process back while it lives, in this thread.
class SignalsHeld {
 public:
  SignalsHeld();
  ~SignalsHeld();
  SignalsHeld(const SignalsHeld&) = delete;
  SignalsHeld& operator=(const SignalsHeld&) = delete;

 private:
  unsigned char before_[128];
};

}  // namespace plexway::file
