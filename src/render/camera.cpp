#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "render/camera.hpp"
#include "render/canvas.hpp"

namespace plexway::render {

using namespace detail;
namespace {

constexpr double half_angle_tangent = 0.21;  // 24 degrees from top to bottom

// A vector whose z is up, in space where another axis is: the front stays the front.
Point with_up(const Point& p, char up) {
  if (up == 'y') return {p[0], p[2], -p[1]};
  if (up == 'x') return {p[2], p[0], p[1]};
  return p;
}

}  // namespace

Axes axes_of(const View& view, char up) {
  constexpr double degree = 3.14159265358979323846 / 180;
  const double az = view.azimuth * degree, el = view.elevation * degree;
  const Point toward = {std::sin(az) * std::cos(el), -std::cos(az) * std::cos(el), std::sin(el)};
  const Point right = {std::cos(az), std::sin(az), 0};
  return {with_up(right, up), with_up(cross(toward, right), up), with_up(toward, up)};
}

View default_view(const Point& size, char up) {
  const double widest = std::max({size[0], size[1], size[2]});
  std::size_t flat = 3;
  for (std::size_t k = 0; k < 3; ++k)
    if (size[k] < 1e-3 * widest) flat = k;
  if (flat == 3) return {28, 24};
  for (const View view : {View{0, 90}, View{0, 0}, View{90, 0}})
    if (std::abs(axes_of(view, up).toward[flat]) > 0.5) return view;
  return {28, 24};
}

double Camera::depth_to_distance(double depth) const {
  if (orthographic) return near + depth * (far - near);
  return near * far / (far - depth * (far - near));
}

Camera fit(const Axes& axes, bool orthographic, std::span<const Batch> batches,
           const Window& window, double width, double height) {
  // In perspective the frustum's sides have slopes; the camera is as near as they allow.
  const double ty = orthographic ? 0 : half_angle_tangent;
  const double tx = ty * window.width / window.height;
  constexpr double infinite = std::numeric_limits<double>::infinity();
  double right = -infinite, left = -infinite, top = -infinite, bottom = -infinite;
  double front = -infinite, back = -infinite;
  for (const Batch& batch : batches)
    for (const Corner& corner : batch.corners) {
      const double x = dot(corner.position, axes.right), y = dot(corner.position, axes.up),
                   z = dot(corner.position, axes.toward);
      right = std::max(right, x + tx * z), left = std::max(left, -x + tx * z);
      top = std::max(top, y + ty * z), bottom = std::max(bottom, -y + ty * z);
      front = std::max(front, z), back = std::max(back, -z);
    }
  const double cx = (right - left) / 2, cy = (top - bottom) / 2;
  const double half_x = std::max((right + left) / 2, 1e-6),
               half_y = std::max((top + bottom) / 2, 1e-6);
  Camera camera;
  camera.axes = axes;
  camera.orthographic = orthographic;
  const double margin = 1e-3 + 0.02 * (front + back);
  // Where the window's middle and size are in device coordinates.
  const double sx = window.width / width, sy = window.height / height;
  const double ox = 2 * (window.left + window.width / 2) / width - 1;
  const double oy = 1 - 2 * (window.top + window.height / 2) / height;
  std::array<std::array<double, 4>, 4> rows{};  // of clip coordinates: x, y, z, w
  const auto row = [&](std::size_t k, const Point& direction, double scale, double constant) {
    for (std::size_t j = 0; j < 3; ++j) rows[k][j] += scale * direction[j];
    rows[k][3] += constant;
  };
  if (orthographic) {
    const double scale = std::min(window.width / (2 * half_x), window.height / (2 * half_y));
    camera.pixel = 1 / scale;
    camera.distance = front + margin + 1;
    camera.near = 1, camera.far = camera.distance + back + margin;
    row(0, axes.right, 2 * scale / width, -cx * 2 * scale / width + ox);
    row(1, axes.up, 2 * scale / height, -cy * 2 * scale / height + oy);
    const double depth = camera.far - camera.near;
    row(2, axes.toward, -2 / depth, 2 * (camera.distance - camera.near) / depth - 1);
    rows[3][3] = 1;
    for (std::size_t k = 0; k < 3; ++k) camera.eye[k] = static_cast<float>(axes.toward[k]);
  } else {
    camera.distance = std::max({half_x / tx, half_y / ty, front + margin});
    camera.near = std::max(camera.distance - front - margin, 1e-3 * camera.distance);
    camera.far = camera.distance + back + margin;
    camera.pixel = 2 * ty / window.height;
    const auto w = [&](std::size_t k, double scale) {
      row(k, axes.toward, -scale, scale * camera.distance);
    };
    row(0, axes.right, sx / tx, -cx * sx / tx), w(0, ox);
    row(1, axes.up, sy / ty, -cy * sy / ty), w(1, oy);
    const double n = camera.near, f = camera.far;
    w(2, (f + n) / (f - n)), rows[2][3] -= 2 * f * n / (f - n);
    w(3, 1);
    const Point eye =
        plus(plus(times(cx, axes.right), times(cy, axes.up)), times(camera.distance, axes.toward));
    for (std::size_t k = 0; k < 3; ++k) camera.eye[k] = static_cast<float>(eye[k]);
    camera.eye[3] = 1;
  }
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t j = 0; j < 4; ++j) camera.to_clip[4 * j + k] = static_cast<float>(rows[k][j]);
  return camera;
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
