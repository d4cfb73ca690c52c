#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include <plexway/executors/gl.hpp>

#include "executors/gl/program.hpp"

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

/// What a device's shaders can do at most.
struct Limits {
  std::size_t block = 0;       ///< bytes of a storage block
  std::size_t groups = 0;      ///< work groups in one dimension of a dispatch
  std::size_t group_size = 0;  ///< invocations in a work group
  std::size_t blocks = 0;      ///< storage blocks in a compute shader
};

/// A device's context with the programs compiled so far.
class Context {
 public:
  /// That of device `number` (see GL::device), made at first use and kept until the process ends:
  /// when statics are destroyed a driver may be gone already.
  static std::shared_ptr<Context> of(int number);
  explicit Context(int number);

  [[nodiscard]] const GLDevice& device() const { return device_; }
  [[nodiscard]] const Limits& limits() const { return limits_; }
  /// Invocations in a work group of ours.
  [[nodiscard]] GLuint group() const { return group_; }

 private:
  friend class Session;
  GLuint program(const std::string& shader, const std::string& defines);

  NativeContext native_;
  std::mutex mutex_;
  GLDevice device_;
  Limits limits_;
  GLuint group_ = 64;
  std::map<std::string, GLuint> programs_;
};

/// The right to call OpenGL: the context is locked, and current in this thread.
class Session {
 public:
  explicit Session(Context& context)
      : gl(context.native_.functions()),
        context_(&context),
        lock_(context.mutex_),
        current_(context.native_) {}

  const Functions& gl;

  [[nodiscard]] Context& context() const { return *context_; }
  [[nodiscard]] const Limits& limits() const { return context_->limits_; }
  /// The compute program of a shader with some `#define NAME` lines. Compiled once.
  /// Throws Error with the compiler's message, in the shader's own file and line.
  [[nodiscard]] GLuint program(const std::string& shader, const std::string& defines = {}) const {
    return context_->program(shader, defines);
  }

 private:
  Context* context_;
  std::unique_lock<std::mutex> lock_;
  MakeCurrent current_;
};

/// A program in use, and its uniforms by name; names it does not have are ignored.
class Uniforms {
 public:
  Uniforms(const Session& session, GLuint program) : gl_(session.gl), program_(program) {
    gl_.UseProgram(program_);
  }
  void set(const char* name, std::size_t value) const {
    gl_.ProgramUniform1ui(program_, gl_.GetUniformLocation(program_, name),
                          static_cast<GLuint>(value));
  }
  void set(const char* name, float value) const {
    gl_.ProgramUniform1f(program_, gl_.GetUniformLocation(program_, name), value);
  }

 private:
  const Functions& gl_;
  GLuint program_;
};

}  // namespace plexway::detail::gl
