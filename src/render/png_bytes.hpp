#pragma once

#include <cstddef>
#include <string>

#include <plexway/render/image.hpp>

namespace plexway::render {

/// A PNG as write_png writes it. Throws as that, but for the system's errors.
std::string png_bytes(const Image& image, std::size_t colours = 0);

}  // namespace plexway::render
