#pragma once

#include <plexway/render/picture.hpp>

namespace plexway::render {

/// Throws UsageError for what picture() says.
void check(const Scene& scene, const PictureOptions& options);

}  // namespace plexway::render
