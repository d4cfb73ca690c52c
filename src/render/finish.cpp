#include <algorithm>
#include <cmath>

#include <plexway/render/picture.hpp>

#include "render/canvas.hpp"
#include "render/composition.hpp"
#include "render/draw_list.hpp"

namespace plexway::render {
namespace {

constexpr std::size_t directions = 8;                            // a half circle, both ways
constexpr std::array<double, 3> radii = {0.0035, 0.011, 0.026};  // of the smaller side
constexpr std::array<double, 3> strengths = {0.16, 0.17, 0.17};

}  // namespace

void shade_hollows(Drawn& drawn, const Camera& camera) {
  struct Probe {
    long dx, dy;
    float reach, strength;  // reach: the depth that counts in full, for a distance of 1
  };
  std::vector<Probe> probes;
  const auto side = static_cast<double>(std::min(drawn.width, drawn.height));
  const double pixel = camera.pixel / static_cast<double>(drawn.scale);
  for (std::size_t r = 0; r < radii.size(); ++r)
    for (std::size_t k = 0; k < directions; ++k) {
      constexpr double half_turn = 3.14159265358979323846;
      const double angle =
          half_turn * (static_cast<double>(k) + static_cast<double>(r) / 3) / directions;
      const double radius = std::max(1.0, radii[r] * side);
      probes.push_back({std::lround(radius * std::cos(angle)),
                        std::lround(radius * std::sin(angle)),
                        static_cast<float>(1.5 * pixel * radius),
                        static_cast<float>(strengths[r] / static_cast<double>(directions))});
    }
  const auto width = static_cast<long>(drawn.width), height = static_cast<long>(drawn.height);
  std::vector<float> distance(drawn.depth.size());
  for (std::size_t i = 0; i < distance.size(); ++i)
    distance[i] = static_cast<float>(camera.depth_to_distance(static_cast<double>(drawn.depth[i])));
  for (long y = 0; y < height; ++y)
    for (long x = 0; x < width; ++x) {
      const auto at = static_cast<std::size_t>(y * width + x);
      if (drawn.depth[at] >= 1) continue;
      const float own = distance[at];
      float dark = 0;
      for (const Probe& probe : probes) {
        const float reach = probe.reach * (camera.orthographic ? 1.0f : own);
        const auto nearer = [&](long px, long py) {
          const long cx = std::clamp(px, 0L, width - 1), cy = std::clamp(py, 0L, height - 1);
          const float difference = own - distance[static_cast<std::size_t>(cy * width + cx)];
          return std::clamp(difference, -reach, reach);
        };
        // A plane, however it slopes, gives 0.
        const float hollow =
            nearer(x + probe.dx, y + probe.dy) + nearer(x - probe.dx, y - probe.dy);
        dark += probe.strength * std::max(0.0f, hollow / reach - 0.15f);
      }
      const float keep = 1 - std::min(dark, 0.6f);
      for (std::size_t c = 0; c < 3; ++c)
        drawn.colour[at][c] =
            static_cast<std::uint8_t>(std::lround(keep * static_cast<float>(drawn.colour[at][c])));
    }
}

Image reduced(const Drawn& drawn) {
  Image image;
  image.width = drawn.width / drawn.scale;
  image.height = drawn.height / drawn.scale;
  image.pixels.resize(image.width * image.height);
  for (std::size_t y = 0; y < image.height; ++y)
    for (std::size_t x = 0; x < image.width; ++x) {
      std::array<unsigned, 4> sum{};
      for (std::size_t j = 0; j < drawn.scale; ++j)
        for (std::size_t i = 0; i < drawn.scale; ++i) {
          const std::size_t row = drawn.height - 1 - (y * drawn.scale + j);
          const auto& pixel = drawn.colour[row * drawn.width + x * drawn.scale + i];
          for (std::size_t c = 0; c < 4; ++c) sum[c] += pixel[c];
        }
      const auto count = static_cast<unsigned>(drawn.scale * drawn.scale);
      auto& out = image.at(x, y);
      out[3] = static_cast<std::uint8_t>((sum[3] + count / 2) / count);
      for (std::size_t c = 0; c < 3; ++c)
        out[c] =
            sum[3] == 0
                ? 255
                : static_cast<std::uint8_t>(std::min(255u, (255 * sum[c] + sum[3] / 2) / sum[3]));
    }
  return image;
}

Image picture(const Scene& scene, const PictureOptions& options) {
  const Composition made = compose(scene, options);
  Drawn drawn = draw(made.batches, options.width, options.height, made.style);
  shade_hollows(drawn, made.style.camera);
  Image image = reduced(drawn);
  ImageSheet sheet(image);
  if (options.legend) draw_legend(sheet, made.legend);
  return image;
}

}  // namespace plexway::render
