#pragma once

#include <cstddef>
#include <iterator>

namespace plexway::render {

/// A shader as it was embedded when this was built.
struct ShaderText {
  const char* name;   ///< its file in shaders/
  const char* files;  ///< the files it was put together from, in the order of `#line`, by `;`
  const char* text;
};

extern const ShaderText shader_texts[];
extern const std::size_t shader_text_count;

}  // namespace plexway::render
