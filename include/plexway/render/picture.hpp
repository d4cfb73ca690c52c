#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace plexway::render {

/// A point or a direction in space.
using Point = std::array<double, 3>;
using Colour = std::array<std::uint8_t, 3>;  ///< sRGB

/// A part of a domain and what is known at its vertices. Any number of kinds of simplices at once;
/// positions without any are a cloud. Everything is referred to and must outlive the picture's
/// call.
struct Part {
  std::span<const Point> positions;  ///< finite
  /// Simplices of each kind, of vertices < positions.size(); empty where there are none.
  std::span<const std::array<std::uint32_t, 2>> edges = {};
  /// Likewise.
  std::span<const std::array<std::uint32_t, 3>> triangles = {};
  /// Likewise.
  std::span<const std::array<std::uint32_t, 4>> tets = {};
  /// One a vertex, of any length, or none: the side that the discs of a cloud face.
  std::span<const Point> normals = {};
  /// One a vertex, or none: then the part has one colour. What is not finite was not reached.
  std::span<const double> value = {};
  /// Of a cloud, one a vertex, or none: how `value` grows, by length. With it discs are coloured
  /// linearly and have isolines. What is not finite counts as 0.
  std::span<const Point> slope = {};
  /// One a vertex, or none: which cell it is in, negative where in none. Each cell has a colour of
  /// its own, and `value`, the distance from the cell's source, says where borders run inside of
  /// triangles.
  std::span<const std::int32_t> label = {};
  std::optional<Colour> colour = {};  ///< of a part without values
  bool ghost = false;                 ///< only a veil: one sees what lies inside
  bool whole = false;                 ///< the clip plane does not cut it
};

/// Balls at points, with a colour or with values.
struct Dots {
  /// Finite, in the scene's unit.
  std::vector<Point> positions;
  std::vector<double> value = {};  ///< one a point, or none
  /// Of points without values.
  Colour colour = {213, 70, 46};
  double size = 1;  ///< 1 is as thick as looks right for a sample
};

/// Everything in one picture. The lengths of all parts are in one unit.
struct Scene {
  /// The domain, in as many parts as are shown differently.
  std::vector<Part> parts;
  std::vector<std::vector<Point>> paths;  ///< polylines, drawn as tubes
  std::vector<Point> sources;             ///< red balls
  std::vector<Point> targets;             ///< white balls
  /// Balls besides.
  std::vector<Dots> dots;
};

/// Pixels in sRGB, rows from the top, each from the left; alpha is straight, not multiplied in.
struct Image {
  ///@{
  /// In pixels.
  std::size_t width = 0, height = 0;
  ///@}
  std::vector<std::array<std::uint8_t, 4>> pixels;  ///< width * height

  /// The pixel of column x < width and row y < height (not checked).
  [[nodiscard]] const std::array<std::uint8_t, 4>& at(std::size_t x, std::size_t y) const {
    return pixels[y * width + x];
  }
  /// To be written to.
  [[nodiscard]] std::array<std::uint8_t, 4>& at(std::size_t x, std::size_t y) {
    return pixels[y * width + x];
  }
};

/// Writes a PNG, without alpha where all is opaque, or with at most `colours` colours (1 to 256): a
/// quarter of the bytes, for pages of many pictures. The file appears whole or not at all. Throws
/// Error "cannot write FILE: reason" when the system refuses, UsageError for an empty image.
void write_png(const std::filesystem::path& file, const Image& image, std::size_t colours = 0);

/// Reads any PNG as 8 bits a channel. Throws InputError when it cannot.
Image read_png(const std::filesystem::path& file);

}  // namespace plexway::render

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
