#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>

#include "complexes/simplicial/flat_domain.hpp"
#include "labels/simplicial/simplex_label.hpp"
#include "labels/simplicial/simplex_string.hpp"

namespace plexway {

template <int N>
using StringPoint = std::array<double, N>;

/// From one point to another: of length 1, or nothing where they are one.
template <int N>
StringPoint<N> direction(const StringPoint<N>& from, const StringPoint<N>& to) {
  const StringPoint<N> way = minus(to, from);
  const double length = std::sqrt(inner(way, way));
  return length > 0 ? plus(StringPoint<N>{}, 1 / length, way) : StringPoint<N>{};
}

/// A string that is its source and nothing else yet.
template <int N>
SimplexStringLabel<N> point_label(const StringPoint<N>& at, double sigma) {
  SimplexStringLabel<N> label;
  label.source = at;
  label.sigma = sigma;
  label.bends = 0;
  std::fill(std::begin(label.nudge), std::end(label.nudge), 0.F);
  return label;
}

/// Held off its source by a clearance in that direction.
template <int N>
void hold(SimplexStringLabel<N>& label, const StringPoint<N>& direction) {
  for (std::size_t d = 0; d < N; ++d) label.nudge[d] = static_cast<float>(direction[d]);
}

/// Do they come from the same source over the same faces?
template <int N>
bool same_way(const SimplexStringLabel<N>& a, const SimplexStringLabel<N>& b) {
  return a.bends == b.bends && a.sigma == b.sigma && a.source == b.source &&
         std::equal(a.face, a.face + a.bends, b.face);
}

/// The label's string but for its end.
template <int N>
void draw(const FlatDomain<N>& flat, const SimplexStringLabel<N>& label, SimplexString<N>& string) {
  StringPoint<N> at = label.source;
  for (std::size_t d = 0; d < N; ++d) at[d] += flat.clearance * static_cast<double>(label.nudge[d]);
  string.start(at, label.source);
  for (std::size_t i = 0; i < label.bends; ++i) string.add_bend(label.face[i], label.along[i]);
}

/// What the string is for its end; beyond four bends the first ones are walked.
template <int N>
SimplexStringLabel<N> label_of(const FlatDomain<N>& flat, const SimplexString<N>& string,
                               double sigma) {
  using Label = SimplexStringLabel<N>;
  const std::size_t bends = string.bends();
  const std::size_t first = bends > Label::most ? bends - Label::most : 0;
  for (std::size_t i = 0; i < first; ++i)
    sigma += distance_of(string[i].sharp, string[i + 1].sharp);
  Label label = point_label<N>(string[first].sharp, sigma);
  for (std::size_t d = 0; d < N; ++d)
    label.nudge[d] =
        static_cast<float>((string[first].at[d] - string[first].sharp[d]) / flat.clearance);
  label.bends = static_cast<Index>(bends - first);
  label.centre = sigma;
  for (std::size_t i = 0; i < label.bends; ++i) {
    label.face[i] = string[first + 1 + i].face;
    label.along[i] = string[first + 1 + i].along;
  }
  for (std::size_t i = first; i + 1 < string.count(); ++i)
    label.centre += distance_of(string[i].sharp, string[i + 1].sharp);
  return label;
}

/// No path over the label's faces to a point near its end is shorter: a distance is convex.
template <int N>
double least_over(const FlatDomain<N>& flat, const SimplexStringLabel<N>& label,
                  const StringPoint<N>& end, const StringPoint<N>& to) {
  if (label.bends == 0) return label.sigma + distance_of(label.source, to);
  const Index last = label.bends - 1;
  const StringPoint<N> eye = flat.faces[label.face[last]].at(label.along[last]);
  const StringPoint<N> leg = minus(end, eye);
  const double length = std::sqrt(inner(leg, leg));
  return label.centre + (length > 0 ? inner(leg, minus(to, end)) / length : 0);
}

/// Nor is one that bends on all of them, and goes around the last as far as it likes: distances to
/// the other bends are convex, and that one unfolds.
template <int N>
double least_around(const FlatDomain<N>& flat, const SimplexStringLabel<N>& label,
                    const StringPoint<N>& end, const StringPoint<N>& to) {
  if (label.bends == 0) return label.sigma + distance_of(label.source, to);
  const Index last = label.bends - 1;
  const BendingFace<N>& face = flat.faces[label.face[last]];
  const StringPoint<N> eye = face.at(label.along[last]);
  const StringPoint<N> leg = minus(end, eye), way = minus(to, eye);
  const double length2 = inner(leg, leg);
  if (!(length2 > 0)) return least_over<N>(flat, label, end, to);
  const double leg_into = inner(leg, face.into), leg_side = inner(leg, face.side);
  const double way_into = inner(way, face.into), way_side = inner(way, face.side);
  const double off_face = std::sqrt((leg_into * leg_into + leg_side * leg_side) *
                                    (way_into * way_into + way_side * way_side));
  const double along_face = inner(leg, way) - (leg_into * way_into + leg_side * way_side);
  return label.centre + (along_face + off_face - length2) / std::sqrt(length2);
}

}  // namespace plexway
