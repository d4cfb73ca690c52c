#pragma once

#include <array>
#include <cstddef>

#include "executors/gl/context.hpp"

namespace plexway::gl {

/// Reads a small buffer again and again while the device works on: each time it is copied aside
/// behind what has been launched so far, and what arrives is the copy made the time before. Without
/// persistent mapping (OpenGL 4.4) it waits for the device instead.
class Readback {
 public:
  Readback(const Session& session, GLuint buffer, std::size_t bytes);
  ~Readback();
  Readback(const Readback&) = delete;
  Readback& operator=(const Readback&) = delete;

  /// Starts a copy. True, with `values`, if an earlier one has arrived.
  bool next(const Session& session, void* values);
  /// Waits for all copies and forgets them.
  void finish(const Session& session);

 private:
  const Functions& gl_;
  GLuint buffer_, copies_ = 0;
  std::size_t bytes_;
  const unsigned char* mapped_ = nullptr;
  std::array<GLsync, 2> fences_{};
  std::size_t started_ = 0;
};

}  // namespace plexway::gl
