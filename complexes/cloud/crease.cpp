#include "complexes/cloud/crease.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "complexes/common/arrays.hpp"

namespace plexway::detail {
namespace {

// On which side of a place do the neighbours of its own plane lie, by a direction in that plane?
double own_side(const Places& places, std::span<const TangentFrame> frames, Index i,
                const Point3& direction) {
  constexpr double own = 0.9;  // cosine of the angle between normals
  double sum = 0;
  for (const Index k : places.near.around(i))
    if (std::abs(dot(frames[i].normal, frames[k].normal)) > own)
      sum += dot(direction, minus(places.at[k], places.at[i]));
  return sum;
}

// The median height of the neighbours of a place's own plane over it, in spacings.
double roughness(const Places& places, std::span<const TangentFrame> frames, Index i) {
  constexpr double own = 0.9;
  std::vector<double> heights;
  for (const Index k : places.near.around(i))
    if (std::abs(dot(frames[i].normal, frames[k].normal)) > own)
      heights.push_back(std::abs(dot(frames[i].normal, minus(places.at[k], places.at[i]))));
  if (heights.empty()) return 1;
  return median(heights) / static_cast<double>(frames[i].spacing);
}

}  // namespace

double length_over(const Crease& crease, const Places& places, std::span<const TangentFrame> frames,
                   Index i, Index j) {
  constexpr double planar = 0.01, bent = 0.03;
  const double rough = std::max(roughness(places, frames, i), roughness(places, frames, j));
  const double sharp = std::clamp((bent - rough) / (bent - planar), 0.0, 1.0);
  const Point3 q = minus(places.at[j], places.at[i]);
  const double along = dot(crease.along, q), across = crease.here + crease.there;
  const double chord = dot(q, q), way = along * along + across * across;
  return std::sqrt(chord + sharp * (way - chord));
}

namespace {

// The line in which two tangent planes meet, as the place i sees it.
struct Meeting {
  Point3 along;   // unit
  Point3 across;  // in the plane of i, unit
  double to;      // from i to the line, by `across`
};

// Of the planes across m and n; q is from i to the place of the other.
Meeting meeting_of(const Point3& m, const Point3& n, const Point3& q) {
  const Point3 along = unit(cross(m, n)), across = cross(along, m);
  return {along, across, dot(n, q) / dot(n, across)};
}

// On which side of the line is the part of a plane around place i that has points, by `across`; 0
// if both have some. Points are in the plane that they are nearer to: `m` is its normal, `n` and
// `j` are of the other.
double half_of(const Places& places, const Meeting& line, const Point3& m, Index i, const Point3& n,
               Index j, double most_height) {
  constexpr double nearer = 0.5, most_beyond = 0.1;
  double height = 0;
  int count = 0;
  double ahead = std::max(0.0, -line.to), behind = std::max(0.0, line.to);
  for (const Index k : places.near.around(i)) {
    const Point3 q = minus(places.at[k], places.at[i]);
    const double off = std::abs(dot(m, q));
    if (off > nearer * std::abs(dot(n, minus(places.at[k], places.at[j])))) continue;
    height += off, ++count;
    const double from_line = dot(line.across, q) - line.to;
    (from_line > 0 ? ahead : behind) += std::abs(from_line);
  }
  if (count < 2 || height > most_height * count) return 0;
  if (std::min(ahead, behind) > most_beyond * std::max(ahead, behind)) return 0;
  return ahead > behind ? 1 : -1;
}

// Two planes that make less than half a right angle with each other, or little more: do both end
// where they meet, as at a sharp ridge, and lie on the same side of it? Where the surface is only
// bent the two go on, to opposite sides; two thin layers go on beside each other.
bool folds(const Places& places, Meeting& line, const Point3& m, Index i, const Point3& n, Index j,
           double spacing, double flat) {
  constexpr double on_line = 0.2;  // spacings
  const Point3 q = minus(places.at[j], places.at[i]);
  const Point3 theirs = cross(line.along, n);
  const double there = dot(m, q) / dot(m, theirs);  // from the line to j
  // Of two places that are no part of the line their own sides tell most bends.
  const double both = -line.to * there * dot(line.across, theirs);
  if (both <= 0 && std::abs(line.to) > on_line * spacing && std::abs(there) > on_line * spacing)
    return false;
  const double here = half_of(places, line, m, i, n, j, flat * spacing);
  if (here == 0) return false;
  const double beyond = half_of(places, {line.along, theirs, -there}, n, j, m, i, flat * spacing);
  if (!(here * beyond * dot(line.across, theirs) > 0)) return false;
  if (here > 0)  // towards the line
    for (double& x : line.across) x = -x;
  return true;
}

}  // namespace

std::optional<Crease> crease_between(const Places& places, std::span<const TangentFrame> frames,
                                     const SheetRule& rule, Index i, Index j, double farthest) {
  constexpr double bent_sine = 0.5, sure = 0.2;             // the latter in spacings
  if (i >= frames.size() || j >= frames.size()) return {};  // a place that is no point
  const double cosine = dot(frames[i].normal, frames[j].normal);
  const bool same_side = cosine >= rule.least_cosine;
  // Normals that tell inside from outside are on one side of a bend, and on both of a ridge.
  if (!may_crease(cosine) || (rule.oriented && same_side)) return {};
  const Point3 m = normal_of(frames[i]), n = normal_of(frames[j]);
  const Point3 q = minus(places.at[j], places.at[i]);
  Meeting line = meeting_of(m, n, q);
  // The sine of the angle between a plane's normal and the other plane is that of the two normals.
  const double sine = norm(cross(m, n));
  Crease crease = {line.along, line.across, std::abs(line.to), std::abs(dot(m, q)) / sine};
  const double spacing = static_cast<double>(frames[i].spacing + frames[j].spacing) / 2;
  if (crease.here + crease.there > farthest * spacing) return {};
  const bool acute = rule.oriented ? sine < bent_sine : std::abs(cosine) >= rule.least_cosine;
  if (acute) {
    if (!folds(places, line, m, i, n, j, spacing, 0.03)) return {};
    crease.across = line.across;
    return crease;
  }
  if (sine < bent_sine) return {};
  // Who is on the line looks away from its own plane's neighbours.
  const double towards =
      crease.here > sure * spacing ? line.to : -own_side(places, frames, i, crease.across);
  if (towards < 0)
    for (double& x : crease.across) x = -x;
  return crease;
}

double way_over_ridge(const Places& places, std::span<const TangentFrame> frames,
                      const SheetRule& rule, Index i, Index j, double noise) {
  constexpr double farthest = 4, noisy = 0.03, less_clear = 0.1;  // spacings
  if (i >= frames.size() || j >= frames.size()) return 0;
  const double cosine = dot(frames[i].normal, frames[j].normal);
  if (!may_crease(cosine)) return 0;
  if (rule.oriented && cosine >= rule.least_cosine) return 0;
  const Point3 m = normal_of(frames[i]), n = normal_of(frames[j]);
  const Point3 q = minus(places.at[j], places.at[i]);
  Meeting line = meeting_of(m, n, q);
  const double across = std::abs(line.to) + std::abs(dot(m, q)) / norm(cross(m, n)),
               along = dot(line.along, q);
  const double spacing = static_cast<double>(frames[i].spacing + frames[j].spacing) / 2;
  if (across > farthest * spacing) return 0;
  const double way = std::sqrt(along * along + across * across);
  if (std::abs(cosine) < rule.least_cosine) return noise > noisy ? way : 0;
  return folds(places, line, m, i, n, j, spacing, less_clear + 2 * noise) ? way : 0;
}

Point3 over_crease(const Places& places, std::span<const TangentFrame> frames,
                   const SheetRule& rule, Index i, Index j) {
  const Point3 q = minus(places.at[j], places.at[i]);
  const auto crease = crease_between(places, frames, rule, i, j);
  if (!crease) return q;
  const double along = dot(crease->along, q), across = crease->here + crease->there;
  Point3 there;
  for (std::size_t d = 0; d < 3; ++d)
    there[d] = along * crease->along[d] + across * crease->across[d];
  return there;
}

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

}  // namespace plexway::detail
