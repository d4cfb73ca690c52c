#include <png.h>

#include <algorithm>
#include <string>

#include <plexway/error.hpp>
#include <plexway/render/image.hpp>

#include "io/output_file.hpp"
#include "palette.hpp"
#include "png_bytes.hpp"

// libpng's simplified interface reports failures by a code, without longjmp.

namespace plexway::render {

std::string png_bytes(const Image& image, std::size_t colours) {
  if (image.pixels.empty() || image.pixels.size() != image.width * image.height)
    throw UsageError("a PNG cannot be empty");
  if (colours > 256)
    throw UsageError("a PNG has at most 256 colours in a list, not " + std::to_string(colours));
  const bool opaque = std::all_of(image.pixels.begin(), image.pixels.end(),
                                  [](const auto& pixel) { return pixel[3] == 255; });
  const std::size_t channels = opaque ? 3 : 4;
  const auto put = [&](std::string& bytes, const auto& pixels) {
    for (const auto& pixel : pixels)
      for (std::size_t c = 0; c < channels; ++c) bytes.push_back(static_cast<char>(pixel[c]));
  };
  std::string rows, palette;
  if (colours > 0) {
    const Indexed indexed = with_few_colours(image, colours);
    rows.assign(indexed.index.begin(), indexed.index.end());
    put(palette, indexed.palette);
  } else {
    put(rows, image.pixels);
  }

  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = static_cast<png_uint_32>(image.width);
  png.height = static_cast<png_uint_32>(image.height);
  png.format = opaque ? PNG_FORMAT_RGB : PNG_FORMAT_RGBA;
  if (colours > 0) {
    png.format |= PNG_FORMAT_FLAG_COLORMAP;
    png.colormap_entries = static_cast<png_uint_32>(palette.size() / channels);
  }
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(png);
  std::string bytes(size, '\0');
  if (png_image_write_to_memory(&png, bytes.data(), &size, 0, rows.data(), 0, palette.data()) == 0)
    throw Error(std::string("cannot make a PNG: ") + png.message);
  bytes.resize(size);
  return bytes;
}

void write_png(const std::filesystem::path& file, const Image& image, std::size_t colours) {
  const std::string bytes = png_bytes(image, colours);
  io::OutputFile out(file);
  out.write(bytes);
  out.commit();
}

Image read_png(const std::filesystem::path& file) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_file(&png, file.string().c_str()) == 0)
    throw InputError(file.string() + ": " + png.message);
  png.format = PNG_FORMAT_RGBA;
  Image image;
  image.width = png.width;
  image.height = png.height;
  image.pixels.resize(image.width * image.height);
  if (png_image_finish_read(&png, nullptr, image.pixels.data(), 0, nullptr) == 0)
    throw InputError(file.string() + ": " + png.message);
  return image;
}

}  // namespace plexway::render
