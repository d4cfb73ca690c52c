#pragma once

#include <cstddef>

#include "executors/gl/context.hpp"

namespace plexway::gl {

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

}  // namespace plexway::gl
