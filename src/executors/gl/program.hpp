#pragma once

#include <cstddef>
#include <string>

#include "executors/gl/functions.hpp"

namespace plexway::detail::gl {

/// A shader as it was embedded when this was built.
struct ShaderText {
  const char* name;   ///< its file in shaders/
  const char* files;  ///< the files it was put together from, in the order of `#line`, by `;`
  const char* text;
};

extern const ShaderText shader_texts[];
extern const std::size_t shader_text_count;

/// A compute program from an embedded shader, with `defines` (whole lines) after its #version.
/// Throws Error with the compiler's message, where files have their names: `saddle_step.inl:12:
/// ...`.
GLuint compile(const Functions& gl, const std::string& shader, const std::string& defines);

/// The same from any text put together from `files` (see ShaderText::files), for tests.
GLuint compile_text(const Functions& gl, const std::string& text, const std::string& files,
                    const std::string& defines);

}  // namespace plexway::detail::gl
