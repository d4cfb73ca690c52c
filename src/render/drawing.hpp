#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include <plexway/render/image.hpp>
#include <plexway/render/scene.hpp>

namespace plexway::render {

/// A colour with an opacity of 0 to 1.
struct Ink {
  Colour colour = {0, 0, 0};
  double opacity = 1;
};

/// Places in an image: pixels from its upper left corner, x to the right and y down.
using Place = std::array<double, 2>;

/// Puts ink with some coverage over a pixel.
void blend(std::array<std::uint8_t, 4>& pixel, const Ink& ink, double coverage);

/// A rectangle; edges may lie within pixels.
void fill_box(Image& image, const Place& from, const Place& to, const Ink& ink);

/// Text with the left end of its baseline at `at`, capitals `height` pixels high.
void draw_text(Image& image, std::string_view text, const Place& at, double height, const Ink& ink);

/// How wide draw_text makes it.
double text_width(std::string_view text, double height);

}  // namespace plexway::render
