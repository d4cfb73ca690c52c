#pragma once

#include <array>
#include <span>

#include <plexway/render/picture.hpp>

#include "render/draw_list.hpp"

namespace plexway::render {

/// The camera's axes in space, unit vectors.
struct Axes {
  Point right, up, toward;  ///< toward: from what is seen to the camera
};

Axes axes_of(const View& view, char up);

/// From above where the scene is flat, else from the front, a little right and above.
View default_view(const Point& size, char up);

/// A part of the picture in pixels, from its upper left corner.
struct Window {
  double left = 0, top = 0, width = 1, height = 1;
};

/// How the scene's frame is seen: clip coordinates of the device, and what shading needs.
struct Camera {
  Axes axes;
  bool orthographic = false;
  std::array<float, 16> to_clip{};  ///< column by column
  std::array<float, 4> eye{};       ///< the camera, fourth 1; or the direction to it, fourth 0
  double distance = 0;              ///< from the origin along `toward`; perspective only
  double near = 0, far = 1;         ///< along the line of sight
  double pixel = 1;                 ///< its size in the frame where the distance is 1 (or anywhere)

  /// How far from the camera a depth between 0 and 1 is.
  [[nodiscard]] double depth_to_distance(double depth) const;
};

/// The camera from which all corners just fit into `window` of a picture of this size.
Camera fit(const Axes& axes, bool orthographic, std::span<const Batch> batches,
           const Window& window, double width, double height);

}  // namespace plexway::render
