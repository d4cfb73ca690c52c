#pragma once

#include <initializer_list>

#include "executors/gl/display.hpp"
#include "gl_functions.hpp"

namespace plexway::render {

/// A context to draw with, current in this thread while it lives. Drawings wait for each other.
class Device {
 public:
  /// `number`: as in PictureOptions::device. Throws NotBuiltError saying what is missing, and
  /// UsageError where there is no such device.
  explicit Device(int number);
  ~Device();
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  DrawFunctions gl;

  /// A program of the embedded shaders; deleted with this.
  GLuint program(std::initializer_list<const char*> shaders);

 private:
  gl::NativeContext native_;
  gl::MakeCurrent current_;
  GLuint program_ = 0;
};

}  // namespace plexway::render
