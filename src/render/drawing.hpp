#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include <plexway/render/image.hpp>
#include <plexway/render/scene.hpp>

namespace plexway::render {

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
