#include "render/canvas.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace plexway::render {

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
