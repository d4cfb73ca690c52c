#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <plexway/render/picture.hpp>

namespace plexway::render {

/// An image of few colours.
struct Indexed {
  std::vector<std::array<std::uint8_t, 4>> palette;  ///< 1 to 256
  std::vector<std::uint8_t> index;                   ///< one a pixel
};

/// The image with at most `colours` (1 to 256) of its colours' means: the box of colours that
/// spreads most is cut at its mean until there are enough, then each pixel moves to the nearest and
/// each colour to the mean of its pixels, a few times. Always the same for the same image.
/// Cost: different colours times `colours`.
Indexed with_few_colours(const Image& image, std::size_t colours);

/// A PNG as write_png writes it. Throws as that, but for the system's errors.
std::string png_bytes(const Image& image, std::size_t colours = 0);

}  // namespace plexway::render
