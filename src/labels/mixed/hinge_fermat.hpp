#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace plexway {

/// A point of a hinge, as both pieces number it: (0, 0) is vertex 0, (1, 0) vertex 1, (0, 1)
/// vertex 2; of an edge the second is 0.
template <class Real>
using HingePlace = std::array<Real, 2>;

/// How long a piece finds a hinge: vertex 0 at the origin, vertex 1 at (length, 0), vertex 2 at
/// (x, y), y > 0. Of an edge x = 0 and y = 1.
template <class Real>
struct HingeShape {
  Real length, x = 0, y = 1;

  [[nodiscard]] std::array<Real, 2> place(const HingePlace<Real>& b) const {
    return {b[0] * length + b[1] * x, b[1] * y};
  }
  [[nodiscard]] HingePlace<Real> point(Real along, Real off) const {
    const Real second = y > 0 ? off / y : Real(0);
    return {length > 0 ? (along - second * x) / length : Real(0), second};
  }
  /// Do two pieces measure the hinge alike, up to `tolerance` of its length?
  [[nodiscard]] bool agrees(const HingeShape& other, int dimension, Real tolerance) const {
    const Real most = tolerance * std::max(length, other.length);
    if (!(std::abs(length - other.length) <= most)) return false;
    if (dimension == 1) return true;
    const Real span = tolerance * std::max({length, std::hypot(x, y), other.length});
    return std::abs(x - other.x) <= span && std::abs(y - other.y) <= span;
  }
};

/// One end of a path over a hinge: (x, y) in the frame of its piece, at height h.
template <class Real>
struct HingeEnd {
  Real x, y, h;
};

/// Where a path from one end to the other crosses a hinge that two pieces measure each in its own
/// way: Fermat's point, the least way. The sum of both parts is convex.
template <class Real>
class HingeFermat {
 public:
  HingeFermat(const HingeShape<Real>& from, const HingeShape<Real>& to, int dimension)
      : shape_{from, to}, dimension_(dimension) {}

  [[nodiscard]] Real way(const HingeEnd<Real>& from, const HingeEnd<Real>& to,
                         const HingePlace<Real>& b) const {
    return part(shape_[0], from, b) + part(shape_[1], to, b);
  }

  [[nodiscard]] HingePlace<Real> crossing(const HingeEnd<Real>& from,
                                          const HingeEnd<Real>& to) const {
    if (dimension_ == 1) return on_edge(from, to, {0, 0}, {1, 0});
    // Inside by Newton's steps; if they lead out, the least is on an edge that they cross.
    HingePlace<Real> b = {Real(1) / 3, Real(1) / 3};
    if (inside(from, to, b)) {
      // A kink at an end that lies in the hinge's plane: the path may start or end right there.
      Real least = way(from, to, b);
      for (const std::size_t side : {0, 1}) {
        const HingeEnd<Real>& end = side == 0 ? from : to;
        const HingePlace<Real> foot = shape_[side].point(end.x, end.y);
        if (!within(foot)) continue;
        if (const Real d = way(from, to, foot); d < least) least = d, b = foot;
      }
      return b;
    }
    static constexpr Real corner[3][2] = {{0, 0}, {1, 0}, {0, 1}};
    HingePlace<Real> best = {0, 0};
    Real least = std::numeric_limits<Real>::infinity();
    const bool beyond[3] = {b[1]<0, b[0] + b[1]> 1, b[0] < 0};
    const bool unknown = !beyond[0] && !beyond[1] && !beyond[2];
    for (std::size_t i = 0; i < 3; ++i) {
      if (!beyond[i] && !unknown) continue;
      const std::size_t j = i == 2 ? 0 : i + 1;
      const HingePlace<Real> c =
          on_edge(from, to, {corner[i][0], corner[i][1]}, {corner[j][0], corner[j][1]});
      if (const Real d = way(from, to, c); d < least) least = d, best = c;
    }
    for (const std::size_t side : {0, 1}) {
      const HingeEnd<Real>& end = side == 0 ? from : to;
      const HingePlace<Real> foot = shape_[side].point(end.x, end.y);
      if (!within(foot)) continue;
      if (const Real d = way(from, to, foot); d < least) least = d, best = foot;
    }
    return best;
  }

 private:
  static bool within(const HingePlace<Real>& b) {
    return b[0] >= 0 && b[1] >= 0 && b[0] + b[1] <= 1;
  }
  static Real part(const HingeShape<Real>& shape, const HingeEnd<Real>& end,
                   const HingePlace<Real>& b) {
    const auto p = shape.place(b);
    const Real dx = p[0] - end.x, dy = p[1] - end.y;
    return std::sqrt(dx * dx + dy * dy + end.h * end.h);
  }

  // Slope and curvature of the way along a step.
  struct Slope {
    Real first = 0, second = 0;
  };
  [[nodiscard]] Slope along(const HingeEnd<Real>& from, const HingeEnd<Real>& to,
                            const HingePlace<Real>& b, const HingePlace<Real>& step) const {
    Slope sum;
    for (const std::size_t side : {0, 1}) {
      const HingeEnd<Real>& end = side == 0 ? from : to;
      const auto p = shape_[side].place(b), u = shape_[side].place(step);
      const Real dx = p[0] - end.x, dy = p[1] - end.y;
      const Real d = std::sqrt(dx * dx + dy * dy + end.h * end.h);
      if (!(d > 0)) continue;
      const Real forward = (dx * u[0] + dy * u[1]) / d;
      sum.first += forward;
      sum.second += (u[0] * u[0] + u[1] * u[1] - forward * forward) / d;
    }
    return sum;
  }

  // Newton's steps, halving where they leave the bracket.
  [[nodiscard]] HingePlace<Real> on_edge(const HingeEnd<Real>& from, const HingeEnd<Real>& to,
                                         const HingePlace<Real>& start,
                                         const HingePlace<Real>& end) const {
    const HingePlace<Real> step = {end[0] - start[0], end[1] - start[1]};
    const auto at = [&](Real s) -> HingePlace<Real> {
      return {start[0] + s * step[0], start[1] + s * step[1]};
    };
    if (along(from, to, start, step).first >= 0) return start;
    if (along(from, to, end, step).first <= 0) return end;
    Real low = 0, high = 1, s = Real(0.5);
    for (int i = 0; i < 48; ++i) {
      const Slope slope = along(from, to, at(s), step);
      (slope.first < 0 ? low : high) = s;
      Real next = slope.second > 0 ? s - slope.first / slope.second : low;
      if (!(next > low && next < high)) next = (low + high) / 2;
      const Real moved = std::abs(next - s);
      s = next;
      if (moved <= 4 * std::numeric_limits<Real>::epsilon()) break;
    }
    return at(s);
  }

  // False if the least is not inside the triangle.
  [[nodiscard]] bool inside(const HingeEnd<Real>& from, const HingeEnd<Real>& to,
                            HingePlace<Real>& b) const {
    Real now = way(from, to, b);
    for (int i = 0; i < 40; ++i) {
      Real g[2] = {0, 0}, h[3] = {0, 0, 0};
      for (const std::size_t side : {0, 1}) {
        const HingeShape<Real>& s = shape_[side];
        const HingeEnd<Real>& end = side == 0 ? from : to;
        const auto p = s.place(b);
        const Real dx = p[0] - end.x, dy = p[1] - end.y;
        const Real d = std::sqrt(dx * dx + dy * dy + end.h * end.h);
        if (!(d > 0)) continue;
        const Real g0 = s.length * dx / d, g1 = (s.x * dx + s.y * dy) / d;
        g[0] += g0;
        g[1] += g1;
        h[0] += (s.length * s.length - g0 * g0) / d;
        h[1] += (s.length * s.x - g0 * g1) / d;
        h[2] += (s.x * s.x + s.y * s.y - g1 * g1) / d;
      }
      const Real det = h[0] * h[2] - h[1] * h[1];
      if (!(det > 0)) return false;
      Real step[2] = {-(h[2] * g[0] - h[1] * g[1]) / det, -(h[0] * g[1] - h[1] * g[0]) / det};
      const Real largest = std::max(std::abs(step[0]), std::abs(step[1]));
      if (!(largest < std::numeric_limits<Real>::infinity())) return false;
      Real share = largest > 1 ? 1 / largest : Real(1);
      bool moved = false;
      for (int halvings = 0; halvings < 20; ++halvings, share /= 2) {
        const HingePlace<Real> next = {b[0] + share * step[0], b[1] + share * step[1]};
        const Real d = way(from, to, next);
        if (!(d <= now)) continue;
        moved = d < now;
        now = d;
        b = next;
        break;
      }
      // Far outside: it will not come back.
      if (b[0] < -2 || b[1] < -2 || b[0] + b[1] > 3) return false;
      if (!moved || largest <= 4 * std::numeric_limits<Real>::epsilon()) break;
    }
    return within(b);
  }

  HingeShape<Real> shape_[2];
  int dimension_;
};

}  // namespace plexway
