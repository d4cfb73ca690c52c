#include "drawing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "stroke_font.hpp"

namespace plexway::render {
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
