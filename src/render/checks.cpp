#include "checks.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include <plexway/error.hpp>

namespace plexway::render {
namespace {

constexpr std::size_t largest_side = 16384;

void check_finite(const Point& p, const char* what) {
  for (const double c : p)
    if (!std::isfinite(c))
      throw UsageError(std::string("picture: ") + what + " has a coordinate that is not finite");
}

template <std::size_t Corners>
void check_indices(std::span<const std::array<std::uint32_t, Corners>> simplices,
                   std::size_t vertices) {
  for (const auto& simplex : simplices)
    for (const std::uint32_t v : simplex)
      if (v >= vertices)
        throw UsageError("picture: vertex " + std::to_string(v) + " of a part with " +
                         std::to_string(vertices));
}

void check_length(std::size_t length, std::size_t vertices, const char* what) {
  if (length != 0 && length != vertices)
    throw UsageError("picture: " + std::to_string(length) + " " + what + " for " +
                     std::to_string(vertices) + " vertices");
}

}  // namespace

void check(const Scene& scene, const PictureOptions& options) {
  if (std::min(options.width, options.height) == 0 ||
      std::max(options.width, options.height) > largest_side)
    throw UsageError("a picture is 1 to " + std::to_string(largest_side) +
                     " pixels wide and high, not " + std::to_string(options.width) + " x " +
                     std::to_string(options.height));
  if (options.up != 'x' && options.up != 'y' && options.up != 'z')
    throw UsageError("picture: up must be x, y or z");
  if (options.view &&
      !(std::isfinite(options.view->azimuth) && std::abs(options.view->elevation) <= 90))
    throw UsageError("picture: the elevation must be between -90 and 90 degrees");
  if (options.range && !((*options.range)[0] < (*options.range)[1] &&
                         std::isfinite((*options.range)[0]) && std::isfinite((*options.range)[1])))
    throw UsageError("picture: the range must be two numbers, the lower one first");
  if (options.clip) {
    check_finite(options.clip->normal, "the clip plane");
    if (options.clip->normal == Point{} || !std::isfinite(options.clip->offset.value_or(0)))
      throw UsageError("picture: the clip plane needs a direction");
  }
  for (const double iso : options.isosurfaces)
    if (!std::isfinite(iso)) throw UsageError("picture: the value of an isosurface must be finite");
  for (const Part& part : scene.parts) {
    const std::size_t n = part.positions.size();
    for (const Point& p : part.positions) check_finite(p, "a part");
    check_indices(part.edges, n);
    check_indices(part.triangles, n);
    check_indices(part.tets, n);
    check_length(part.normals.size(), n, "normals");
    check_length(part.value.size(), n, "values");
    check_length(part.slope.size(), n, "slopes");
    check_length(part.label.size(), n, "labels");
  }
  for (const auto& path : scene.paths)
    for (const Point& p : path) check_finite(p, "a path");
  for (const auto* points : {&scene.sources, &scene.targets})
    for (const Point& p : *points) check_finite(p, "a source or target");
  for (const Dots& dots : scene.dots) {
    for (const Point& p : dots.positions) check_finite(p, "a dot");
    check_length(dots.value.size(), dots.positions.size(), "values of dots");
  }
}

}  // namespace plexway::render
