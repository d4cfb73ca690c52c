#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "render/canvas.hpp"
#include "render/draw_list.hpp"

namespace plexway::render {

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
