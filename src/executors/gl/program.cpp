#include "executors/gl/program.hpp"

#include <cctype>
#include <sstream>
#include <vector>

#include <plexway/error.hpp>

namespace plexway::detail::gl {
namespace {

// Compilers name a place as FILE:LINE or FILE(LINE), FILE being a number that #line has given.
std::string with_names(const std::string& log, const std::vector<std::string>& files) {
  std::istringstream lines(log);
  std::string named;
  for (std::string line; std::getline(lines, line);) {
    std::size_t begin = line.rfind("ERROR: ", 0) == 0 ? 7 : 0;
    std::size_t end = begin;
    while (end < line.size() && std::isdigit(static_cast<unsigned char>(line[end])) != 0) ++end;
    if (end > begin && end - begin < 4 && end < line.size() &&
        (line[end] == ':' || line[end] == '(')) {
      const auto file = static_cast<std::size_t>(std::stoul(line.substr(begin, end - begin)));
      if (file < files.size()) line = files[file] + line.substr(end);
    }
    if (!line.empty()) named += (named.empty() ? "" : "\n") + line;
  }
  return named;
}

template <class Length, class Text>
std::string log_of(GLuint object, Length length_of, Text text_of) {
  GLint length = 0;
  length_of(object, GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<std::size_t>(length > 0 ? length : 1), '\0');
  GLsizei written = 0;
  text_of(object, length, &written, log.data());
  log.resize(static_cast<std::size_t>(written));
  return log;
}

}  // namespace

GLuint compile_text(const Functions& gl, const std::string& text, const std::string& files,
                    const std::string& defines) {
  const std::size_t first = text.find('\n') + 1;  // after #version
  const std::string source = text.substr(0, first) + defines + "#line 2 0\n" + text.substr(first);
  std::vector<std::string> names;
  std::istringstream list(files);
  for (std::string name; std::getline(list, name, ';');) names.push_back(name);

  const GLuint shader = gl.CreateShader(GL_COMPUTE_SHADER);
  const char* const lines = source.c_str();
  gl.ShaderSource(shader, 1, &lines, nullptr);
  gl.CompileShader(shader);
  GLint good = GL_FALSE;
  gl.GetShaderiv(shader, GL_COMPILE_STATUS, &good);
  if (good != GL_TRUE) {
    const std::string log = log_of(shader, gl.GetShaderiv, gl.GetShaderInfoLog);
    gl.DeleteShader(shader);
    throw Error("the OpenGL driver cannot compile a shader: " + with_names(log, names));
  }
  const GLuint program = gl.CreateProgram();
  gl.AttachShader(program, shader);
  gl.LinkProgram(program);
  gl.DeleteShader(shader);
  gl.GetProgramiv(program, GL_LINK_STATUS, &good);
  if (good != GL_TRUE) {
    const std::string log = log_of(program, gl.GetProgramiv, gl.GetProgramInfoLog);
    gl.DeleteProgram(program);
    throw Error("the OpenGL driver cannot link " + names.front() + ": " + with_names(log, names));
  }
  return program;
}

GLuint compile(const Functions& gl, const std::string& shader, const std::string& defines) {
  for (std::size_t n = 0; n < shader_text_count; ++n)
    if (shader == shader_texts[n].name)
      return compile_text(gl, shader_texts[n].text, shader_texts[n].files, defines);
  throw Error("no shader " + shader + " was embedded");
}

}  // namespace plexway::detail::gl
