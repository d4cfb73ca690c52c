#pragma once

#include <algorithm>
#include <vector>

#include <plexway/render/picture.hpp>

#include "render/canvas.hpp"
#include "render/legend.hpp"
#include "render/skins.hpp"

namespace plexway::render {

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
