#include <EGL/egl.h>
#include <string>
#include <string_view>

#include <plexway/error.hpp>

#include "executors/gl/program.hpp"
#include "render/device.hpp"

namespace plexway::render {

namespace {

const detail::gl::Display& choose(int number) {
  const auto& all = detail::gl::displays();
  if (number >= 0) {
    if (static_cast<std::size_t>(number) < all.size()) return all[static_cast<std::size_t>(number)];
    throw UsageError("there is no device " + std::to_string(number) + ", only 0 to " +
                     std::to_string(all.size() - 1));
  }
  std::string problems;
  for (const bool software : {false, true})
    for (const detail::gl::Display& display : all) {
      if (display.software != software) continue;
      try {
        const detail::gl::NativeContext works(display);
        return display;
      } catch (const NotBuiltError& error) {
        problems += std::string("; ") + error.what();
      }
    }
  throw NotBuiltError(
      "no device of this machine can draw pictures: install a driver, such as libgl1-mesa-dri" +
      problems);
}

std::string text_of(std::string_view name) {
  for (std::size_t n = 0; n < shader_text_count; ++n)
    if (name == shader_texts[n].name) return shader_texts[n].text;
  throw Error("no shader " + std::string(name) + " was embedded");
}

}  // namespace

Device::Device(int number) : native_(choose(number)), current_(native_) {
#define PLEXWAY_RENDER_LOAD(upper, name)                                         \
  gl.name = reinterpret_cast<PFNGL##upper##PROC>(eglGetProcAddress("gl" #name)); \
  if (gl.name == nullptr) throw NotBuiltError("the OpenGL driver lacks gl" #name);
  PLEXWAY_RENDER_FUNCTIONS(PLEXWAY_RENDER_LOAD)
#undef PLEXWAY_RENDER_LOAD
}

Device::~Device() {
  if (program_ != 0) gl.DeleteProgram(program_);
}

GLuint Device::program(std::initializer_list<const char*> shaders) {
  program_ = gl.CreateProgram();
  std::string log(4096, '\0');
  GLsizei length = 0;
  GLint good = GL_FALSE;
  for (const std::string_view name : shaders) {
    const std::string text = text_of(name);
    const char* const lines = text.c_str();
    const GLuint shader = gl.CreateShader(
        name.substr(name.size() - 4) == "vert" ? GL_VERTEX_SHADER : GL_FRAGMENT_SHADER);
    gl.ShaderSource(shader, 1, &lines, nullptr);
    gl.CompileShader(shader);
    gl.GetShaderiv(shader, GL_COMPILE_STATUS, &good);
    if (good != GL_TRUE) {
      gl.GetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), &length, log.data());
      gl.DeleteShader(shader);
      throw Error("the OpenGL driver cannot compile " + std::string(name) + ": " +
                  log.substr(0, static_cast<std::size_t>(length)));
    }
    gl.AttachShader(program_, shader);
    gl.DeleteShader(shader);
  }
  gl.LinkProgram(program_);
  gl.GetProgramiv(program_, GL_LINK_STATUS, &good);
  if (good != GL_TRUE) {
    gl.GetProgramInfoLog(program_, static_cast<GLsizei>(log.size()), &length, log.data());
    throw Error("the OpenGL driver cannot link the shaders of pictures: " +
                log.substr(0, static_cast<std::size_t>(length)));
  }
  return program_;
}

}  // namespace plexway::render
