#pragma once

#include <stdexcept>
#include <string>

namespace plexway {

/// Base of everything plexway throws on purpose. `what()` is one line that says what to do next.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A file or an array handed in is not what it must be (the tool exits with 3).
class InputError : public Error {
 public:
  using Error::Error;
};

/// Sizes that the numbers of a domain cannot hold beside each other. In single precision: build it
/// in double. The place is in the message.
class PrecisionError : public InputError {
 public:
  using InputError::InputError;
};

/// A propagation that went on improving labels long past any use, and was stopped (the tool exits
/// with 6): its lengths are no metric, or rounding is as large as what it would gain.
class EndlessError : public Error {
 public:
  using Error::Error;
};

/// A call or a command line asks for something that makes no sense (the tool exits with 2).
class UsageError : public Error {
 public:
  using Error::Error;
};

/// The feature exists but this build or this machine lacks it (the tool exits with 4).
class NotBuiltError : public Error {
 public:
  using Error::Error;
};

/// A progress callback asked to stop.
class Cancelled : public Error {
 public:
  using Error::Error;
};

}  // namespace plexway
