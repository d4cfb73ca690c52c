#pragma once

#include <plexway/render/image.hpp>

#include "canvas.hpp"

namespace plexway::render {

/// Darkens places behind nearby edges and in hollows, by comparing depths: the picture gains depth
/// where shading alone leaves it flat. Only what is drawn changes, not the background.
/// Cost: some 50 look-ups for each pixel drawn.
void shade_hollows(Drawn& drawn, const Camera& camera);

/// The mean over the pixels drawn for each of the picture's, turned upright.
Image reduced(const Drawn& drawn);

}  // namespace plexway::render
