#pragma once

#include <array>
#include <string>
#include <vector>

#include "camera.hpp"
#include "drawing.hpp"

namespace plexway::render {

/// What stands beside the picture.
struct Legend {
  bool bar = false;
  double low = 0, high = 1;
  std::array<Colour, 256> map{};
  std::string title;
  std::vector<double> isolines;  ///< drawn across the bar
  struct Swatch {
    Colour colour;
    std::string text;
  };
  std::vector<Swatch> swatches;  ///< below the bar
};

/// Of thin lines in a picture of this size: 1 pixel, more on larger ones than 800 x 600.
double line_width(double width, double height);

/// Where the scene goes in a picture of this size.
Window scene_window(const Legend& legend, double width, double height);

/// Whether a line of a value is dark on the map's colour there, or bright.
Ink line_ink(const Legend& legend, double value);

void draw_legend(Sheet& sheet, const Legend& legend);

}  // namespace plexway::render
