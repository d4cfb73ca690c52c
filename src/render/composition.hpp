#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include <plexway/render/picture.hpp>

#include "render/camera.hpp"
#include "render/canvas.hpp"
#include "render/draw_list.hpp"
#include "render/skins.hpp"

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

/// Lettering made of strokes. Capitals and digits are 8 units high, y points up from the baseline.
struct StrokeText {
  std::vector<std::vector<std::array<double, 2>>> strokes;  ///< polylines; one point is a dot
  double width = 0;                                         ///< units
};

/// A line of text from (0, 0). Printable ASCII; a frame stands for any other byte, once for all the
/// bytes of a character in UTF-8. Digits are all of one width.
StrokeText stroke_text(std::string_view text);

inline constexpr Colour source_red = {225, 60, 40};
inline constexpr Colour target_white = {250, 250, 250};
inline constexpr Colour path_white = {250, 250, 250};
/// Of a path's tube, for a pixel of this size in the frame.
inline double tube_radius(double pixel) { return std::clamp(1.9 * pixel, 0.0032, 0.012); }
///@{
/// Of balls, in radii of a tube.
inline constexpr double source_radius = 2.6, target_radius = 2.2;
///@}

/// A scene as it is drawn: everything in triangles, the camera fitted to them, and the legend.
struct Composition {
  std::vector<Batch> batches;
  Style style;  ///< with the camera
  Legend legend;
  Frame frame;
  double pixel = 0;  ///< Making::pixel
};

/// Throws as picture().
Composition compose(const Scene& scene, const PictureOptions& options);

}  // namespace plexway::render
