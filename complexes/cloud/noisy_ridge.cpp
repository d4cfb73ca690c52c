#include "complexes/cloud/noisy_ridge.hpp"

#include <algorithm>
#include <cmath>

#include "complexes/cloud/crease.hpp"

namespace plexway {
namespace {

// Between planes, by normals of whatever sign.
double angle(const Point3& m, const Point3& n) {
  return std::acos(std::min(1.0, std::abs(dot(m, n))));
}

// Heights h over a plane, by coordinates x and y in it: what fits them best is a + b x + c y.
struct LinearFit {
  double count = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0, h = 0, hx = 0, hy = 0;

  void add(double px, double py, double ph) {
    count += 1, x += px, y += py, h += ph;
    xx += px * px, xy += px * py, yy += py * py, hx += ph * px, hy += ph * py;
  }
  // a, b and c; without slopes where places all but lie in a line.
  [[nodiscard]] Point3 solve() const {
    const double cxx = xx - x * x / count, cxy = xy - x * y / count, cyy = yy - y * y / count;
    const double chx = hx - h * x / count, chy = hy - h * y / count;
    const double determinant = cxx * cyy - cxy * cxy;
    if (!(determinant > 0.01 * (cxx + cyy) * (cxx + cyy))) return {h / count, 0, 0};
    const double b = (cyy * chx - cxy * chy) / determinant;
    const double c = (cxx * chy - cxy * chx) / determinant;
    return {(h - b * x - c * y) / count, b, c};
  }
};

}  // namespace

NoisyRidges::NoisyRidges(const Places& places, std::span<const TangentFrame> frames)
    : places_(places), frames_(frames), sides_(frames.size()) {}

const NoisyRidges::Side& NoisyRidges::side_of(Index i) {
  constexpr double own = 0.96, widest = 3;  // cosine of the angle between normals; spacings
  Side& side = sides_[i];
  if (side.known) return side;
  side.known = true;
  const double radius = widest * static_cast<double>(frames_[i].spacing);
  const Point3 m = normal_of(frames_[i]), ex = some_perpendicular(m), ey = cross(m, ex);
  LinearFit fit;
  seen_.clear();
  const auto look = [&](Index k) {
    if (std::abs(dot(m, normal_of(frames_[k]))) < own) return;
    const Point3 q = minus(places_.at[k], places_.at[i]);
    if (dot(q, q) > radius * radius) return;
    if (std::find(seen_.begin(), seen_.end(), k) != seen_.end()) return;
    seen_.push_back(k);
    fit.add(dot(ex, q), dot(ey, q), dot(m, q));
    for (std::size_t d = 0; d < 3; ++d) side.middle[d] += q[d];
  };
  look(i);
  for (const Index k : places_.near.around(i)) look(k);
  const std::size_t ring = seen_.size();
  for (std::size_t s = 1; s < ring; ++s)
    for (const Index k : places_.near.around(seen_[s])) look(k);
  for (double& x : side.middle) x /= fit.count;
  const Point3 found = fit.solve();
  for (std::size_t d = 0; d < 3; ++d) side.normal[d] = m[d] - found[1] * ex[d] - found[2] * ey[d];
  side.normal = unit(side.normal);
  side.height = found[0] * dot(side.normal, m);
  return side;
}

double NoisyRidges::share_between(Index i, Index j, const Point3& m, const Point3& n) const {
  double sum = 0;
  std::size_t count = 0;
  for (const Index end : {i, j})
    for (const Index k : places_.near.around(end)) {
      const Point3 normal = normal_of(frames_[k]);
      sum += std::min(angle(normal, m), angle(normal, n)), ++count;
    }
  return sum / (angle(m, n) * static_cast<double>(std::max<std::size_t>(count, 1)));
}

NoisyRidge NoisyRidges::between(Index i, Index j, double farthest) {
  constexpr double least_sine = 0.42, planes = 0.06, bent = 0.12;
  if (i >= frames_.size() || j >= frames_.size()) return {};  // a place that is no point
  if (!may_crease(dot(frames_[i].normal, frames_[j].normal))) return {};
  const Side &a = side_of(i), &b = side_of(j);
  const Point3 &m = a.normal, &n = b.normal;
  const Point3 line = cross(m, n);
  const double sine = std::sqrt(dot(line, line));
  if (sine < least_sine) return {};
  Point3 q = minus(places_.at[j], places_.at[i]);
  for (std::size_t d = 0; d < 3; ++d) q[d] += n[d] * b.height - m[d] * a.height;
  // How far a place is from the line on its own side of it, by its height over the other plane and
  // that of its side's middle: a place whose side is the other one, by its points, is beyond.
  const auto from_line = [&](double height, double of_middle) {
    return (height + of_middle < 0 ? -height : height) / sine;
  };
  const double across =
      from_line(-dot(n, q), dot(n, a.middle)) + from_line(dot(m, q), dot(m, b.middle));
  const double spacing = static_cast<double>(frames_[i].spacing + frames_[j].spacing) / 2;
  if (std::abs(across) > farthest * spacing) return {};
  const double along = dot(line, q) / sine, share = share_between(i, j, m, n);
  return {std::sqrt(along * along + across * across),
          std::clamp((bent - share) / (bent - planes), 0.0, 1.0),
          std::max(std::abs(a.height), std::abs(b.height)) / spacing};
}

}  // namespace plexway
