#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace plexway::render {

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
