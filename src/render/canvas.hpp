#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <plexway/render/picture.hpp>

#include "render/camera.hpp"
#include "render/draw_list.hpp"

namespace plexway::render {

/// What the device draws with.
struct Style {
  Camera camera;
  std::array<Colour, 256> map{};
  double low = 0, high = 1;                         ///< values at the ends of the map
  double first_line = 0, line_step = 1, lines = 0;  ///< isolines
  double pen = 1;                                   ///< pixels: lines are wider on large pictures
  bool transparent = false;
  int device = -1;
};

/// Colours and depths as drawn, several pixels for one of the picture; rows from the bottom.
struct Drawn {
  std::size_t width = 0, height = 0, scale = 1;     ///< scale: pixels along a side of the picture's
  std::vector<std::array<std::uint8_t, 4>> colour;  ///< alpha multiplied in
  std::vector<float> depth;                         ///< of one sample a pixel, 1 where empty
};

/// Draws the batches, 4 samples a pixel drawn: overlays last. Throws NotBuiltError where EGL, a
/// driver or what is needed of it is missing.
Drawn draw(std::span<const Batch> batches, std::size_t width, std::size_t height,
           const Style& style);

/// Darkens places behind nearby edges and in hollows, by comparing depths: the picture gains depth
/// where shading alone leaves it flat. Only what is drawn changes, not the background.
/// Cost: some 50 look-ups for each pixel drawn.
void shade_hollows(Drawn& drawn, const Camera& camera);

/// The mean over the pixels drawn for each of the picture's, turned upright.
Image reduced(const Drawn& drawn);

/// Where points of the frame are in a picture that was drawn, and whether something is in front.
class Sight {
 public:
  Sight(const Drawn& drawn, const Camera& camera);

  struct Seen {
    Place place;      ///< in pixels of the picture
    double distance;  ///< from the camera
  };
  [[nodiscard]] Seen operator()(const Point& point) const;
  /// Nothing drawn is nearer by more than `slack` and about two pixels.
  [[nodiscard]] bool open(const Seen& seen, double slack) const;
  /// How many pixels a length of the frame is at a distance.
  [[nodiscard]] double pixels(double length, double distance) const;

  /// Parts of a tube around a polyline (radius 0: of the polyline) that are open, and those that
  /// are not, in pixels. A tube in a surface stands out a little: behind a rim it is open where one
  /// of its sides is.
  struct Parts {
    std::vector<std::vector<Place>> open, hidden;
  };
  [[nodiscard]] Parts parts(std::span<const Point> line, double radius) const;

 private:
  const Drawn& drawn_;
  const Camera& camera_;
};

}  // namespace plexway::render
