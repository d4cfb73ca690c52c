#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include <plexway/render/picture.hpp>

#include "complexes/common/geometry.hpp"

namespace plexway::render {
using namespace detail;

inline Point plus(const Point& a, const Point& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline Point times(double s, const Point& a) { return {s * a[0], s * a[1], s * a[2]}; }
inline Point between(const Point& a, const Point& b, double t) {
  return plus(times(1 - t, a), times(t, b));
}
/// Of any length, 0 included.
inline Point unit_or_zero(const Point& a) {
  const double square = dot(a, a);
  return square > 0 ? unit(a) : Point{};
}

/// What colours a place: its fourth number says how.
using Paint = std::array<std::uint8_t, 4>;
/// By the value and the map, with isolines.
inline constexpr Paint by_value = {0, 0, 0, 0};
/// One colour, with isolines of the value.
inline Paint lined(const Colour& c) { return {c[0], c[1], c[2], 128}; }
inline Paint plain(const Colour& c) { return {c[0], c[1], c[2], 255}; }

/// A corner of a triangle as the device gets it.
struct Corner {
  std::array<float, 3> position;
  std::array<std::int16_t, 4> normal;
  float value;
  Paint paint;
};

/// The second and third cell that a triangle may belong to: the least of the three values wins.
struct Others {
  std::array<float, 2> value;
  std::array<Paint, 2> paint;
};

/// A corner before it is cut and packed.
struct Vertex {
  Point position{}, normal{};
  double value = 0;
  Paint paint = by_value;
  std::optional<Others> others;
};

enum class Look {
  lit,      ///< shaded
  cap,      ///< a cut through a solid: evenly bright, so that colours are those of the bar
  overlay,  ///< shaded, outlined, and seen faintly through what is in front
  ghost     ///< a veil, denser where it is seen edge-on
};

/// Triangles that look alike.
struct Batch {
  explicit Batch(Look l) : look(l) {}

  Look look;
  bool isolines = false;
  bool joined = true;  ///< triangles meet in edges; discs lie over each other
  std::array<float, 4> veil = {1, 1, 1, 0.3f};  ///< an overlay behind something: sRGB and opacity
  std::vector<Corner> corners;
  std::vector<Others> others;  ///< as many as corners, or none
  /// Of an overlay: what is drawn in its place where it is behind something; empty: itself.
  std::vector<Corner> behind;

  void add(const Vertex& a, const Vertex& b, const Vertex& c);
};

/// Keeps normal . x <= offset.
struct Plane {
  Point normal;
  double offset;

  /// 0 for points of the plane, in spite of rounding.
  [[nodiscard]] double over(const Point& p) const {
    const double d = dot(normal, p) - offset;
    return std::abs(d) < 1e-9 ? 0 : d;
  }
};

Vertex between(const Vertex& a, const Vertex& b, double t);

/// Adds what of the triangle is on this side of the plane.
void add_clipped(Batch& batch, const std::optional<Plane>& plane, const Vertex& a, const Vertex& b,
                 const Vertex& c);

/// A colour with an opacity of 0 to 1.
struct Ink {
  Colour colour = {0, 0, 0};
  double opacity = 1;
};

/// Places in an image: pixels from its upper left corner, x to the right and y down.
using Place = std::array<double, 2>;

/// Puts ink with some coverage over a pixel.
void blend(std::array<std::uint8_t, 4>& pixel, const Ink& ink, double coverage);

/// What boxes and text are put on.
class Sheet {
 public:
  Sheet(double width, double height) : width_(width), height_(height) {}
  virtual ~Sheet() = default;
  Sheet(const Sheet&) = delete;
  Sheet& operator=(const Sheet&) = delete;

  ///@{
  /// In pixels.
  [[nodiscard]] double width() const { return width_; }
  [[nodiscard]] double height() const { return height_; }
  ///@}
  /// A rectangle; edges may lie within pixels.
  virtual void box(const Place& from, const Place& to, const Ink& ink) = 0;
  /// One that is filled with the colours of a map, the last on top.
  virtual void ramp(const Place& from, const Place& to, const std::array<Colour, 256>& map) = 0;
  /// Text with the left end of its baseline at `at`, capitals `size` pixels high.
  virtual void text(std::string_view line, const Place& at, double size, const Ink& ink) = 0;

 private:
  double width_, height_;
};

/// Pixels.
class ImageSheet final : public Sheet {
 public:
  explicit ImageSheet(Image& image)
      : Sheet(static_cast<double>(image.width), static_cast<double>(image.height)), image_(image) {}
  void box(const Place& from, const Place& to, const Ink& ink) override;
  void ramp(const Place& from, const Place& to, const std::array<Colour, 256>& map) override;
  void text(std::string_view line, const Place& at, double size, const Ink& ink) override;

 private:
  Image& image_;
};

/// How wide text is.
double text_width(std::string_view text, double size);

}  // namespace plexway::render
