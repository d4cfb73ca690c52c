#include <algorithm>
#include <array>
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

Sight::Sight(const Drawn& drawn, const Camera& camera) : drawn_(drawn), camera_(camera) {}

Sight::Seen Sight::operator()(const Point& point) const {
  std::array<double, 4> clip{};
  for (std::size_t k = 0; k < 4; ++k) {
    clip[k] = static_cast<double>(camera_.to_clip[12 + k]);
    for (std::size_t j = 0; j < 3; ++j)
      clip[k] += static_cast<double>(camera_.to_clip[4 * j + k]) * point[j];
  }
  const auto scale = static_cast<double>(drawn_.scale);
  const double width = static_cast<double>(drawn_.width) / scale,
               height = static_cast<double>(drawn_.height) / scale;
  const double depth = (clip[2] / clip[3] + 1) / 2;
  return {{(clip[0] / clip[3] + 1) / 2 * width, (1 - clip[1] / clip[3]) / 2 * height},
          camera_.depth_to_distance(depth)};
}

bool Sight::open(const Seen& seen, double slack) const {
  const auto scale = static_cast<double>(drawn_.scale);
  const auto pixel = [&](double place) { return std::lround(std::floor(place * scale)); };
  const long column = pixel(seen.place[0]);
  const long row = static_cast<long>(drawn_.height) - 1 - pixel(seen.place[1]);
  // On a slope the neighbours are as near as the place itself.
  double farthest = 0;
  for (long dy = -1; dy <= 1; ++dy)
    for (long dx = -1; dx <= 1; ++dx) {
      const auto x = static_cast<std::size_t>(
          std::clamp(column + dx, 0L, static_cast<long>(drawn_.width) - 1));
      const auto y =
          static_cast<std::size_t>(std::clamp(row + dy, 0L, static_cast<long>(drawn_.height) - 1));
      farthest = std::max(farthest, camera_.depth_to_distance(
                                        static_cast<double>(drawn_.depth[y * drawn_.width + x])));
    }
  const double two = 2 / std::max(pixels(1, seen.distance), 1e-9);
  return seen.distance <= farthest + slack + two;
}

double Sight::pixels(double length, double distance) const {
  return length / (camera_.pixel * (camera_.orthographic ? 1 : distance));
}

Sight::Parts Sight::parts(std::span<const Point> line, double radius) const {
  constexpr double step = 1.5;  // pixels between two looks
  Parts parts;
  std::vector<Place> part;
  bool is_open = false;
  const auto finish = [&] {
    if (part.size() > 1) (is_open ? parts.open : parts.hidden).push_back(part);
    part.clear();
  };
  Place across{};  // to the side of the line, of length 1
  const auto any_open = [&](const Seen& seen) {
    // Of a tube around a line in the surface about half is seen; over a rim it bends with it.
    const double slack = 3 * radius, aside = pixels(radius, seen.distance);
    if (open(seen, slack)) return true;
    for (const double side : {-aside, aside})
      if (side != 0 && open({{seen.place[0] + side * across[0], seen.place[1] + side * across[1]},
                             seen.distance},
                            slack))
        return true;
    return false;
  };
  const auto look = [&](const Seen& seen, bool corner) {
    const bool now = any_open(seen);
    if (now != is_open) {
      if (!part.empty()) part.push_back(seen.place);
      finish();
      is_open = now;
      part.push_back(seen.place);
      return;
    }
    // Corners nearer than a third of a pixel do not show.
    if (!corner || (!part.empty() && std::hypot(seen.place[0] - part.back()[0],
                                                seen.place[1] - part.back()[1]) < 0.33))
      return;
    part.push_back(seen.place);
  };
  for (std::size_t k = 0; k < line.size(); ++k) {
    const Seen to = (*this)(line[k]);
    if (k > 0) {
      const Seen from = (*this)(line[k - 1]);
      const double length = std::hypot(to.place[0] - from.place[0], to.place[1] - from.place[1]);
      if (length > 0)
        across = {(from.place[1] - to.place[1]) / length, (to.place[0] - from.place[0]) / length};
      const auto looks = static_cast<std::size_t>(std::min(length / step, 1e5));
      for (std::size_t n = 1; n <= looks; ++n) {
        const double t = static_cast<double>(n) / static_cast<double>(looks + 1);
        look((*this)(between(line[k - 1], line[k], t)), false);
      }
    }
    look(to, true);
    if (k + 1 == line.size() && !part.empty() && part.back() != to.place) part.push_back(to.place);
  }
  finish();
  return parts;
}

}  // namespace plexway::render
