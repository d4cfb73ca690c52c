#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "render/camera.hpp"

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

}  // namespace plexway::render
