#include "render/composition.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <plexway/error.hpp>
#include <plexway/render/picture.hpp>

#include "complexes/common/box_tree.hpp"
#include "io/field/colours.hpp"
#include "render/camera.hpp"
#include "render/skins.hpp"

namespace plexway::render {
using namespace detail;

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

/// Throws UsageError for what picture() says.
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

constexpr double infinite = std::numeric_limits<double>::infinity();

bool is_cloud(const Part& part) {
  return part.edges.empty() && part.triangles.empty() && part.tets.empty();
}

// Calls `use` with every vertex that is drawn, some more than once. Those in no simplex are not.
template <class Use>
void each_vertex(const Part& part, Use use) {
  const auto all_of = [&](const auto& simplices) {
    for (const auto& simplex : simplices)
      for (const std::uint32_t v : simplex) use(v);
  };
  all_of(part.edges), all_of(part.triangles), all_of(part.tets);
  if (is_cloud(part))
    for (std::uint32_t v = 0; v < part.positions.size(); ++v) use(v);
}

Box<3> extent(const Scene& scene) {
  auto box = Box<3>::empty();
  for (const Part& part : scene.parts) {
    each_vertex(part, [&](std::uint32_t v) { box.add(part.positions[v]); });
  }
  for (const auto& path : scene.paths)
    for (const Point& p : path) box.add(p);
  for (const auto* points : {&scene.sources, &scene.targets})
    for (const Point& p : *points) box.add(p);
  for (const Dots& dots : scene.dots)
    for (const Point& p : dots.positions) box.add(p);
  if (!(box.low[0] <= box.high[0])) throw UsageError("picture: nothing to draw");
  return box;
}

std::array<double, 2> range_of(const Scene& scene, const PictureOptions& options, bool& any) {
  double low = infinite, high = -infinite;
  const auto add = [&](std::span<const double> values) {
    for (const double v : values)
      if (std::isfinite(v)) low = std::min(low, v), high = std::max(high, v);
  };
  for (const Part& part : scene.parts) add(part.value);
  for (const Dots& dots : scene.dots) add(dots.value);
  any = low <= high;
  if (options.range) return *options.range;
  if (!any) return {0, 1};
  if (low > 0 && low < 0.1 * high) low = 0;  // distances begin at 0
  if (!(low < high)) high = low + (low == 0 ? 1 : std::abs(low));
  return {low, high};
}

std::optional<Plane> clip_plane(const PictureOptions& options, const Frame& frame,
                                const Point& toward) {
  if (!options.clip) return std::nullopt;
  Point normal = unit(options.clip->normal);
  if (!options.clip->offset) {
    if (dot(normal, toward) < 0) normal = times(-1, normal);
    return Plane{normal, 0};
  }
  const double length = std::sqrt(dot(options.clip->normal, options.clip->normal));
  return Plane{normal, frame.scale * (*options.clip->offset / length - dot(normal, frame.centre))};
}

void add_part(std::vector<Batch>& batches, const Part& part, const PictureOptions& options,
              const Making& making) {
  const bool isosurfaces =
      !options.isosurfaces.empty() && !part.tets.empty() && !part.value.empty();
  if (is_cloud(part)) {
    Batch discs(Look::lit);
    discs.isolines = !part.slope.empty();
    discs.joined = false;
    if (!part.positions.empty()) add_discs(discs, part, making);
    batches.push_back(std::move(discs));
  }
  if (!part.edges.empty()) {
    Batch wires(Look::lit);
    add_wires(wires, part, making);
    batches.push_back(std::move(wires));
  }
  std::optional<Cells> cells;
  const bool filled = !part.triangles.empty() || !part.tets.empty();
  if (!part.label.empty() && filled) cells.emplace(part);
  const Cells* const cells_at = cells ? &*cells : nullptr;
  Batch skin(part.ghost || isosurfaces ? Look::ghost : Look::lit);
  skin.isolines = true;
  if (!part.triangles.empty()) add_surface(skin, part, cells_at, part.triangles, making);
  if (!part.tets.empty())
    add_surface(skin, part, cells_at, boundary(part.positions, part.tets, making), making);
  batches.push_back(std::move(skin));
  for (const double iso : options.isosurfaces) {
    if (!isosurfaces) break;
    Batch surface(Look::lit);
    add_isosurface(surface, part, iso, making);
    batches.push_back(std::move(surface));
  }
  if (part.tets.empty() || part.ghost || isosurfaces) return;
  Batch cap(Look::cap);
  cap.isolines = true;
  add_cap(cap, part, cells_at, making);
  batches.push_back(std::move(cap));
}

void add_overlays(std::vector<Batch>& batches, const Scene& scene, const Making& making) {
  const auto at = [&](const Point& p, const Paint& paint) {
    Vertex v;
    v.position = making.frame(p);
    v.paint = paint;
    return v;
  };
  for (const Dots& dots : scene.dots) {
    Batch balls(Look::lit);
    const auto count = static_cast<double>(std::max<std::size_t>(dots.positions.size(), 1));
    const double radius =
        dots.size * std::clamp(0.135 / std::sqrt(count), 1.3 * making.pixel, 0.0085);
    for (std::size_t n = 0; n < dots.positions.size(); ++n) {
      const bool known = !dots.value.empty() && std::isfinite(dots.value[n]);
      Vertex v = at(dots.positions[n], dots.value.empty() ? plain(dots.colour)
                                       : known            ? by_value
                                                          : plain(unreached));
      if (known) v.value = dots.value[n];
      add_ball(balls, v, radius, dots.positions.size() < 2000 ? 10 : 6);
    }
    batches.push_back(std::move(balls));
  }
  const double width = tube_radius(making.pixel);
  Batch lines(Look::overlay), ends(Look::overlay);
  for (const auto& path : scene.paths) {
    std::vector<Vertex> line;
    for (const Point& p : path) line.push_back(at(p, plain(path_white)));
    if (!line.empty()) add_tube(lines, line, width, 14);
  }
  batches.push_back(std::move(lines));
  for (const Point& p : scene.targets)
    add_ball(ends, at(p, plain(target_white)), target_radius * width, 14);
  batches.push_back(std::move(ends));
  Batch starts(Look::overlay);
  // One that is hidden is a ring: a dot would seem to lie on the near side.
  starts.veil = {0.88f, 0.16f, 0.1f, 0.9f};
  for (const Point& p : scene.sources) {
    const Vertex source = at(p, plain(source_red));
    const double radius = source_radius * width;
    add_ball(starts, source, radius, 14);
    add_ring(starts.behind, source, 0.72 * radius, 1.08 * radius, making.toward);
  }
  batches.push_back(std::move(starts));
}

// The isolines: where the first is, how far apart they are, and how many.
void choose_isolines(Style& style, const PictureOptions& options, bool cells) {
  const double low = style.low, high = style.high;
  if (options.isolines) {
    style.lines = static_cast<double>(*options.isolines);
    style.line_step = (high - low) / (style.lines + 1);
    style.first_line = low + style.line_step;
    return;
  }
  // Few in cells: there they show the shape, and borders matter.
  style.line_step = cells ? io::ticks(low, high, 5).step : io::ticks(low, high, 6).fine_step();
  const double slack = 1e-6 * style.line_step;
  const double first = std::floor((low + slack) / style.line_step) + 1;
  style.first_line = first * style.line_step;
  style.lines = std::max(0.0, std::ceil((high - slack - style.first_line) / style.line_step));
}

Legend legend_of(const Scene& scene, const PictureOptions& options, const Style& style, bool any) {
  Legend legend;
  legend.low = style.low, legend.high = style.high;
  legend.map = style.map;
  legend.title = options.title;
  bool cells = false, lines = false, missing = false;
  std::int32_t largest = -1;
  bool by_value_somewhere = false;
  for (const Part& part : scene.parts) {
    each_vertex(part, [&](std::uint32_t v) {
      missing = missing || (!part.value.empty() && !std::isfinite(part.value[v]));
      if (part.label.empty()) return;
      largest = std::max(largest, part.label[v]);
      missing = missing || part.label[v] < 0;
    });
    cells = cells || !part.label.empty();
    by_value_somewhere = by_value_somewhere || (!part.value.empty() && part.label.empty() &&
                                                (!part.ghost || !part.edges.empty()));
    lines = lines || !part.triangles.empty() || !part.tets.empty() ||
            (is_cloud(part) && !part.slope.empty());
  }
  for (const Dots& dots : scene.dots)
    by_value_somewhere = by_value_somewhere || !dots.value.empty();
  legend.bar = any && by_value_somewhere;
  if (legend.bar && lines && options.isosurfaces.empty())
    for (double k = 0; k < style.lines; ++k)
      legend.isolines.push_back(style.first_line + k * style.line_step);
  if (!options.isosurfaces.empty()) legend.isolines = options.isosurfaces;
  if (legend.isolines.size() > 60) legend.isolines.clear();
  std::erase_if(legend.isolines, [&](double v) { return v < style.low || v > style.high; });
  if (cells && !legend.bar && largest >= 0 &&
      static_cast<std::size_t>(largest) < cell_palette().size())
    for (std::int32_t l = 0; l <= largest; ++l)
      legend.swatches.push_back(
          {cell_palette()[static_cast<std::size_t>(l)], "source " + std::to_string(l)});
  if (missing && (legend.bar || cells)) legend.swatches.push_back({unreached, "unreached"});
  return legend;
}

}  // namespace

Composition compose(const Scene& scene, const PictureOptions& options) {
  check(scene, options);
  const io::ColourMap map(options.map);
  const Box<3> box = extent(scene);
  const Point size = minus(box.high, box.low);
  Making making;
  making.frame.centre = between(box.low, box.high, 0.5);
  const double diagonal = std::sqrt(dot(size, size));
  making.frame.scale = diagonal > 0 ? 1 / diagonal : 1;
  const Axes axes = axes_of(options.view.value_or(default_view(size, options.up)), options.up);
  making.toward = axes.toward;
  making.clip = clip_plane(options, making.frame, axes.toward);
  making.pixel = 1.0 / static_cast<double>(std::min(options.width, options.height));

  Composition made;
  Style& style = made.style;
  style.map = map.table();
  style.pen = line_width(static_cast<double>(options.width), static_cast<double>(options.height));
  style.transparent = options.transparent;
  style.device = options.device;
  bool any_value = false;
  const auto range = range_of(scene, options, any_value);
  style.low = range[0], style.high = range[1];
  const bool cells = std::any_of(scene.parts.begin(), scene.parts.end(),
                                 [](const Part& part) { return !part.label.empty(); });
  choose_isolines(style, options, cells);

  std::vector<Batch>& batches = made.batches;
  for (const Part& part : scene.parts) {
    Making making_part = making;
    if (part.whole) making_part.clip.reset();
    add_part(batches, part, options, making_part);
  }
  add_overlays(batches, scene, making);
  const bool empty = std::all_of(batches.begin(), batches.end(),
                                 [](const Batch& batch) { return batch.corners.empty(); });
  if (empty) throw UsageError("picture: nothing to draw: the clip plane cuts all away");

  Legend& legend = made.legend;
  if (options.legend) legend = legend_of(scene, options, style, any_value);
  const auto width = static_cast<double>(options.width),
             height = static_cast<double>(options.height);
  style.camera =
      fit(axes, options.orthographic, batches, scene_window(legend, width, height), width, height);
  made.frame = making.frame;
  made.pixel = making.pixel;
  return made;
}

}  // namespace plexway::render
