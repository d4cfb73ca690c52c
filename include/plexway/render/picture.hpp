#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <plexway/render/image.hpp>
#include <plexway/render/scene.hpp>

/// The component `render`, link plexway::render: pictures of domains and fields, without a display.
namespace plexway::render {

/// Where the camera stands. Azimuth 0, elevation 0 is the front: it looks along +y, x to the right,
/// z up. A larger azimuth walks to the right around what is looked at, a larger elevation upwards.
struct View {
  /// Around the axis that points up, and above the horizon.
  double azimuth = 0, elevation = 0;  ///< degrees
};

/// Cuts away all x with normal . x > offset. Without an offset the plane goes through the middle of
/// the scene, and that half is cut away which lies towards the camera.
struct Clip {
  /// Of any length but 0, in the scene's coordinates.
  Point normal = {1, 0, 0};
  /// In the scene's unit times the length of the normal; without: through the middle.
  std::optional<double> offset = {};
};

/// How a picture is drawn.
struct PictureOptions {
  ///@{
  /// In pixels, 1 to 16384.
  std::size_t width = 800, height = 600;
  ///@}
  /// Without one: from above where the scene is flat, else from the front, right and above.
  std::optional<View> view = {};
  char up = 'z';  ///< the axis that points up: x, y or z
  /// Without perspective.
  bool orthographic = false;
  /// Values at the ends of the colour bar; without: the least and the largest that are finite.
  std::optional<std::array<double, 2>> range = {};
  /// So many lines of equal value, evenly spaced between the ends; without: at round numbers.
  std::optional<std::size_t> isolines = {};
  std::string map = "viridis";     ///< or magma, cividis
  bool transparent = false;        ///< the background
  std::string title = "distance";  ///< over the colour bar
  bool legend = true;              ///< the colour bar, and what grey means
  /// The half-space that is cut away; without: none.
  std::optional<Clip> clip = {};
  /// Surfaces of equal value inside solids, at these values; the solids become ghosts.
  std::vector<double> isosurfaces = {};
  int device =
      -1;  ///< the place in EGL's list of devices; -1: a graphics processor if there is one
};

/// Draws the scene by OpenGL, without a display. The same call gives the same bits on the same
/// driver.
///
/// Surfaces are shaded on both sides, and smoothly unless they have a crease of more than 55
/// degrees. Solids show their boundary, and where they are cut the field inside: the tetrahedra's
/// own cross-sections, with values linear in each. Wireframes and paths are tubes, clouds are
/// discs; what of sources and paths is hidden shines through faintly.
///
/// Throws NotBuiltError where EGL, a driver or OpenGL 4.3 is missing, saying what; UsageError for
/// spans of wrong length, indices out of range, positions that are not finite, a scene without any
/// point, a size of 0 or more than 16384, an unknown map or a clip plane without direction.
/// Cost: linear; a million triangles take a few seconds on one core without a graphics processor.
[[nodiscard]] Image picture(const Scene& scene, const PictureOptions& options = {});

/// The same as an SVG of the picture's size: the shaded domain as an image in it, over that as
/// lines the isolines, each with its `data-value`, and the paths, sources and targets, all with
/// what is hidden left out or faint; the legend as text. Lines inside cells (Part::label) stay in
/// the image, which has at most `colours` colours as in write_png. The file appears whole or not at
/// all. Throws as picture() and write_png.
void write_svg(const std::filesystem::path& file, const Scene& scene,
               const PictureOptions& options = {}, std::size_t colours = 0);

}  // namespace plexway::render
