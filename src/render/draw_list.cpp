#include "render/draw_list.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "render/composition.hpp"

namespace plexway::render {
namespace {

constexpr Others nothing_else = {{1e30f, 1e30f}, {by_value, by_value}};

Corner packed(const Vertex& v) {
  Corner corner{};
  for (std::size_t k = 0; k < 3; ++k) {
    corner.position[k] = static_cast<float>(v.position[k]);
    corner.normal[k] =
        static_cast<std::int16_t>(std::lround(32767 * std::clamp(v.normal[k], -1.0, 1.0)));
  }
  corner.value = static_cast<float>(v.value);
  corner.paint = v.paint;
  return corner;
}

}  // namespace

void Batch::add(const Vertex& a, const Vertex& b, const Vertex& c) {
  const bool more = a.others.has_value();
  if (more && others.empty()) others.assign(corners.size(), nothing_else);
  for (const Vertex* v : {&a, &b, &c}) {
    corners.push_back(packed(*v));
    if (more || !others.empty()) others.push_back(v->others.value_or(nothing_else));
  }
}

Vertex between(const Vertex& a, const Vertex& b, double t) {
  Vertex v = a;
  v.position = between(a.position, b.position, t);
  v.normal = unit_or_zero(between(a.normal, b.normal, t));
  v.value = (1 - t) * a.value + t * b.value;
  if (v.others)
    for (std::size_t k = 0; k < 2; ++k)
      v.others->value[k] = static_cast<float>((1 - t) * static_cast<double>(a.others->value[k]) +
                                              t * static_cast<double>(b.others->value[k]));
  return v;
}

void add_clipped(Batch& batch, const std::optional<Plane>& plane, const Vertex& a, const Vertex& b,
                 const Vertex& c) {
  if (!plane) return batch.add(a, b, c);
  const std::array<const Vertex*, 3> corners = {&a, &b, &c};
  std::array<double, 3> over{};
  for (std::size_t k = 0; k < 3; ++k) over[k] = plane->over(corners[k]->position);
  if (over[0] <= 0 && over[1] <= 0 && over[2] <= 0) return batch.add(a, b, c);
  std::vector<Vertex> kept;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3;
    if (over[k] <= 0) kept.push_back(*corners[k]);
    if ((over[k] <= 0) != (over[next] <= 0))
      kept.push_back(between(*corners[k], *corners[next], over[k] / (over[k] - over[next])));
  }
  for (std::size_t k = 2; k < kept.size(); ++k) batch.add(kept[0], kept[k - 1], kept[k]);
}

namespace {

constexpr double units = 8;  // of a capital's height

double pen_width(double height) { return std::max(1.15, height * 0.125); }

double distance_to_segment(const Place& p, const Place& a, const Place& b) {
  const double dx = b[0] - a[0], dy = b[1] - a[1];
  const double square = dx * dx + dy * dy;
  double t = square > 0 ? ((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / square : 0;
  t = std::clamp(t, 0.0, 1.0);
  return std::hypot(p[0] - a[0] - t * dx, p[1] - a[1] - t * dy);
}

}  // namespace

void blend(std::array<std::uint8_t, 4>& pixel, const Ink& ink, double coverage) {
  const double over = std::clamp(coverage, 0.0, 1.0) * ink.opacity;
  if (over <= 0) return;
  const double under = pixel[3] / 255.0 * (1 - over);
  const double alpha = over + under;
  for (std::size_t c = 0; c < 3; ++c)
    pixel[c] =
        static_cast<std::uint8_t>(std::lround((ink.colour[c] * over + pixel[c] * under) / alpha));
  pixel[3] = static_cast<std::uint8_t>(std::lround(255 * alpha));
}

void ImageSheet::box(const Place& from, const Place& to, const Ink& ink) {
  Image& image = image_;
  const auto share = [](double pixel, double low, double high) {
    return std::max(0.0, std::min(pixel + 1, high) - std::max(pixel, low));
  };
  const auto first = [](double x) {
    return static_cast<std::size_t>(std::max(0.0, std::floor(x)));
  };
  for (std::size_t y = first(from[1]); y < image.height && static_cast<double>(y) < to[1]; ++y)
    for (std::size_t x = first(from[0]); x < image.width && static_cast<double>(x) < to[0]; ++x)
      blend(image.at(x, y), ink,
            share(static_cast<double>(x), from[0], to[0]) *
                share(static_cast<double>(y), from[1], to[1]));
}

void ImageSheet::ramp(const Place& from, const Place& to, const std::array<Colour, 256>& map) {
  const double tall = to[1] - from[1];
  for (double y = from[1]; y < to[1]; ++y) {
    const double t = 1 - (y + 0.5 - from[1]) / tall;
    const double place = std::clamp(t * 255, 0.0, 255.0);
    const auto k = std::min(static_cast<std::size_t>(place), std::size_t{254});
    Ink ink;
    for (std::size_t c = 0; c < 3; ++c)
      ink.colour[c] = static_cast<std::uint8_t>(
          std::lround(map[k][c] + (place - static_cast<double>(k)) * (map[k + 1][c] - map[k][c])));
    box({from[0], y}, {to[0], y + 1}, ink);
  }
}

void ImageSheet::text(std::string_view line, const Place& at, double height, const Ink& ink) {
  Image& image = image_;
  StrokeText strokes = stroke_text(line);
  const double scale = height / units, reach = pen_width(height) / 2;
  for (auto& stroke : strokes.strokes)
    for (Place& p : stroke) p = {at[0] + p[0] * scale, at[1] - p[1] * scale};
  const auto low = [](double x) { return std::max<long>(0, std::lround(std::floor(x))); };
  const long top = low(at[1] - 10 * scale - 2), bottom = std::lround(at[1] + 4 * scale + 2);
  const long left = low(at[0] - 2), right = std::lround(at[0] + strokes.width * scale + 3);
  // The nearest stroke counts, so that strokes do not darken each other where they meet.
  for (long y = top; y <= bottom && y < static_cast<long>(image.height); ++y)
    for (long x = left; x <= right && x < static_cast<long>(image.width); ++x) {
      const Place p = {static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5};
      double nearest = std::numeric_limits<double>::infinity();
      for (const auto& stroke : strokes.strokes) {
        const double dot = stroke.size() == 1 ? 0.45 * reach : 0;
        for (std::size_t k = 0; k < stroke.size(); ++k)
          nearest =
              std::min(nearest, distance_to_segment(p, stroke[k], stroke[k > 0 ? k - 1 : 0]) - dot);
      }
      blend(image.at(static_cast<std::size_t>(x), static_cast<std::size_t>(y)), ink,
            reach + 0.5 - nearest);
    }
}

double text_width(std::string_view text, double height) {
  return stroke_text(text).width * height / units;
}

}  // namespace plexway::render
