#pragma once

#include "executors/gl/functions.hpp"

namespace plexway::gl {

/// What a source itself offers to a vertex (shaders/claim.comp).
struct VertexOffer {
  GLuint vertex, distance, source, spare;
};

}  // namespace plexway::gl
