#pragma once

#include "executors/gl/program.hpp"

namespace plexway::render {

using detail::gl::ShaderText;
extern const ShaderText shader_texts[];
extern const std::size_t shader_text_count;

}  // namespace plexway::render
