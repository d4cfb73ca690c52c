#include <png.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

#include <plexway/error.hpp>
#include <plexway/render/picture.hpp>

#include "io/output_file.hpp"
#include "render/png.hpp"

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

namespace {

using Pixel = std::array<std::uint8_t, 4>;
using Mean = std::array<double, 4>;

struct Count {
  Pixel colour;
  double pixels;  ///< what it weighs: the root of how many have it
};

/// A range of the list of colours.
struct ColourBox {
  std::size_t begin = 0, end = 0;
  Mean mean{};
  std::size_t widest = 0;  ///< the channel that spreads most
  double spread = 0;       ///< its sum of squares
};

ColourBox box_of(const std::vector<Count>& all, std::size_t begin, std::size_t end) {
  ColourBox box;
  box.begin = begin, box.end = end;
  Mean sum{}, squares{};
  double pixels = 0;
  for (std::size_t k = begin; k < end; ++k) {
    pixels += all[k].pixels;
    for (std::size_t c = 0; c < 4; ++c) {
      sum[c] += all[k].pixels * all[k].colour[c];
      squares[c] += all[k].pixels * all[k].colour[c] * all[k].colour[c];
    }
  }
  for (std::size_t c = 0; c < 4; ++c) {
    box.mean[c] = sum[c] / pixels;
    const double spread = squares[c] - sum[c] * box.mean[c];
    if (spread > box.spread) box.spread = spread, box.widest = c;
  }
  return box;
}

std::vector<Count> counted(const Image& image) {
  std::vector<Pixel> sorted = image.pixels;
  std::sort(sorted.begin(), sorted.end());
  std::vector<Count> all;
  for (const Pixel& p : sorted) {
    if (all.empty() || all.back().colour != p) all.push_back({p, 0});
    ++all.back().pixels;
  }
  // Small things, such as a colour bar, keep their colours beside large ones.
  for (Count& count : all) count.pixels = std::sqrt(count.pixels);
  return all;
}

std::size_t nearest(const std::vector<Mean>& means, const Pixel& colour) {
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < means.size(); ++k) {
    double d = 0;
    for (std::size_t c = 0; c < 4; ++c) d += (means[k][c] - colour[c]) * (means[k][c] - colour[c]);
    if (d < least) least = d, best = k;
  }
  return best;
}

}  // namespace

Indexed with_few_colours(const Image& image, std::size_t colours) {
  std::vector<Count> all = counted(image);
  std::vector<ColourBox> boxes = {box_of(all, 0, all.size())};
  while (boxes.size() < colours) {
    const auto widest = std::max_element(
        boxes.begin(), boxes.end(),
        [](const ColourBox& a, const ColourBox& b) { return a.spread < b.spread; });
    if (!(widest->spread > 0)) break;
    const ColourBox box = *widest;
    const auto at = [&](std::size_t k) { return all.begin() + static_cast<std::ptrdiff_t>(k); };
    const auto middle = std::stable_partition(at(box.begin), at(box.end), [&](const Count& count) {
      return count.colour[box.widest] <= box.mean[box.widest];
    });
    const auto cut = static_cast<std::size_t>(middle - all.begin());
    *widest = box_of(all, box.begin, cut);
    boxes.push_back(box_of(all, cut, box.end));
  }
  std::vector<Mean> means;
  for (const ColourBox& box : boxes) means.push_back(box.mean);
  std::vector<std::size_t> place(all.size());
  constexpr int rounds = 4;
  for (int round = 0; round < rounds; ++round) {
    std::vector<Mean> sum(means.size(), Mean{});
    std::vector<double> pixels(means.size(), 0);
    for (std::size_t k = 0; k < all.size(); ++k) {
      place[k] = nearest(means, all[k].colour);
      pixels[place[k]] += all[k].pixels;
      for (std::size_t c = 0; c < 4; ++c) sum[place[k]][c] += all[k].pixels * all[k].colour[c];
    }
    if (round + 1 == rounds) break;
    for (std::size_t m = 0; m < means.size(); ++m)
      for (std::size_t c = 0; c < 4 && pixels[m] > 0; ++c) means[m][c] = sum[m][c] / pixels[m];
  }
  Indexed result;
  for (const Mean& mean : means) {
    Pixel p{};
    for (std::size_t c = 0; c < 4; ++c) p[c] = static_cast<std::uint8_t>(mean[c] + 0.5);
    result.palette.push_back(p);
  }
  std::vector<std::size_t> order(all.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return all[a].colour < all[b].colour; });
  for (const Pixel& p : image.pixels) {
    const auto found =
        std::lower_bound(order.begin(), order.end(), p,
                         [&](std::size_t k, const Pixel& q) { return all[k].colour < q; });
    result.index.push_back(static_cast<std::uint8_t>(place[*found]));
  }
  return result;
}

}  // namespace plexway::render
