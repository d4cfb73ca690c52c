#pragma once

#include <string>
#include <vector>

#include "executors/gl/functions.hpp"

namespace plexway::detail::gl {

/// A place where EGL can make a context without a window. EGL's types are pointers: no header here.
struct Display {
  void* display = nullptr;  ///< initialised
  bool software = false;    ///< Mesa's software device, or the surfaceless platform
  std::string problem;      ///< why it cannot be used, or empty
};

/// EGL's devices in its order or, where it cannot list any, Mesa's surfaceless platform. Found once
/// a process. Displays stay initialised: another part of the program may use the same ones.
/// Throws NotBuiltError if there is none.
const std::vector<Display>& displays();

/// An OpenGL context of 4.3 or later, core profile, with no surface. Movable, owns its context.
class NativeContext {
 public:
  /// Throws NotBuiltError saying what is missing.
  explicit NativeContext(const Display& display);
  ~NativeContext();
  NativeContext(const NativeContext&) = delete;
  NativeContext& operator=(const NativeContext&) = delete;

  [[nodiscard]] const Functions& functions() const { return functions_; }

 private:
  friend class MakeCurrent;
  void load();

  void* display_;
  void* context_;
  Functions functions_;
};

/// Current in this thread while it lives; what was current before comes back afterwards.
class MakeCurrent {
 public:
  /// Throws NotBuiltError if EGL refuses.
  explicit MakeCurrent(const NativeContext& context);
  ~MakeCurrent();
  MakeCurrent(const MakeCurrent&) = delete;
  MakeCurrent& operator=(const MakeCurrent&) = delete;

 private:
  void *display_, *before_display_, *before_draw_, *before_read_, *before_context_;
  unsigned before_api_;
};

}  // namespace plexway::detail::gl
