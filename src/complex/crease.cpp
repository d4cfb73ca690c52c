#include "complex/crease.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace plexway {
namespace {

Point3 normal_of(const TangentFrame& frame) {
  const auto& n = frame.normal;
  return {n[0], n[1], n[2]};
}

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
  const auto middle = heights.begin() + static_cast<std::ptrdiff_t>(heights.size() / 2);
  std::nth_element(heights.begin(), middle, heights.end());
  return *middle / static_cast<double>(frames[i].spacing);
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

std::optional<Crease> crease_between(const Places& places, std::span<const TangentFrame> frames,
                                     const SheetRule& rule, Index i, Index j) {
  // Planes that are nearly parallel meet anywhere. The two sides of a thin plate are no crease.
  constexpr double least_sine = 0.5, farthest = 4, sure = 0.2;  // the latter in spacings
  if (i >= frames.size() || j >= frames.size()) return {};      // a place that is no point
  const double cosine = dot(frames[i].normal, frames[j].normal);
  if ((rule.oriented ? cosine : std::abs(cosine)) >= rule.least_cosine) return {};
  const Point3 m = normal_of(frames[i]), n = normal_of(frames[j]);
  Crease crease;
  crease.along = cross(m, n);
  const double sine = std::sqrt(dot(crease.along, crease.along));
  if (sine < least_sine) return {};
  crease.along = unit(crease.along);
  crease.across = cross(crease.along, m);
  const Point3 q = minus(places.at[j], places.at[i]);
  // The sine of the angle between a plane's normal and the other plane is that of the two normals.
  const double here = dot(n, q) / dot(n, crease.across);
  crease.here = std::abs(here);
  crease.there = std::abs(dot(m, q)) / sine;
  const double spacing = static_cast<double>(frames[i].spacing + frames[j].spacing) / 2;
  if (crease.here + crease.there > farthest * spacing) return {};
  // Who is on the line looks away from its own plane's neighbours.
  const double towards =
      crease.here > sure * spacing ? here : -own_side(places, frames, i, crease.across);
  if (towards < 0)
    for (double& x : crease.across) x = -x;
  return crease;
}

Point3 unfolded(const Places& places, std::span<const TangentFrame> frames, const SheetRule& rule,
                Index i, Index j) {
  const Point3 q = minus(places.at[j], places.at[i]);
  const auto crease = crease_between(places, frames, rule, i, j);
  if (!crease) return q;
  const double along = dot(crease->along, q), across = crease->here + crease->there;
  Point3 there;
  for (std::size_t d = 0; d < 3; ++d)
    there[d] = along * crease->along[d] + across * crease->across[d];
  return there;
}

}  // namespace plexway
