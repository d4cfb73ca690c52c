#include "complexes/cloud/sheet.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <vector>

#include "complexes/cloud/crease.hpp"
#include "complexes/common/arrays.hpp"

namespace plexway::detail {
namespace {

using Edge = std::array<Index, 2>;

// The same from both sides: then lengths have the same bits.
Edge edge_of(const std::array<Index, 3>& face, std::size_t i) {
  const Index a = face[i], b = face[(i + 1) % 3];
  return {std::min(a, b), std::max(a, b)};
}

// Do two places both lie in the plane of a third?
bool share_plane(const Places& places, std::span<const TangentFrame> frames, Index c, Index a,
                 Index b) {
  constexpr double near = 0.1;  // spacings
  if (c >= frames.size()) return false;
  const double most = near * static_cast<double>(frames[c].spacing);
  const auto height = [&](Index p) {
    return std::abs(dot(frames[c].normal, minus(places.at[p], places.at[c])));
  };
  return height(a) <= most && height(b) <= most;
}

// At a corner of three sides two places may both lie on the one that is neither's own, as the third
// corner of a triangle knows. They see each other straight; the way over the line in which their
// own sides meet goes around the corner, and is as long as that over the third corner beyond.
std::vector<Edge> straight_edges(const Places& places, std::span<const TangentFrame> frames,
                                 std::span<const std::array<Index, 3>> faces,
                                 std::span<const std::array<double, 3>> lengths) {
  constexpr double around = 0.995;
  std::vector<Edge> long_ones, seen, both;
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (std::size_t i = 0; i < 3; ++i) {
      const auto& l = lengths[f];
      if (l[i] > around * (l[(i + 1) % 3] + l[(i + 2) % 3]))
        long_ones.push_back(edge_of(faces[f], i));
      if (share_plane(places, frames, faces[f][(i + 2) % 3], faces[f][i], faces[f][(i + 1) % 3]))
        seen.push_back(edge_of(faces[f], i));
    }
  std::sort(long_ones.begin(), long_ones.end());
  std::sort(seen.begin(), seen.end());
  std::set_intersection(long_ones.begin(), long_ones.end(), seen.begin(), seen.end(),
                        std::back_inserter(both));
  return both;
}

// In a noisy cloud, as far as planes meet there.
void lengthen_over_ridges(const Places& places, std::span<const TangentFrame> frames,
                          std::span<const std::array<Index, 3>> faces, double farthest,
                          std::vector<std::array<double, 3>>& lengths) {
  NoisyRidges ridges(places, frames);
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (std::size_t i = 0; i < 3; ++i) {
      const Edge e = edge_of(faces[f], i);
      const NoisyRidge ridge = ridges.between(e[0], e[1], farthest);
      if (!(ridge.sharp > 0)) continue;
      const double square = lengths[f][i] * lengths[f][i];
      lengths[f][i] = std::sqrt(square + ridge.sharp * (ridge.way * ridge.way - square));
    }
}

}  // namespace

std::vector<std::array<double, 3>> sheet_lengths(const Places& places,
                                                 std::span<const TangentFrame> frames,
                                                 const SheetRule& rule,
                                                 std::span<const std::array<Index, 3>> faces,
                                                 double flat, double noise) {
  // What closes a hole beside a ridge may be long, and is no chord for that.
  constexpr double farthest = 12;  // spacings
  const auto for_creases = [&](const auto& visit) {
    for (std::size_t f = 0; f < faces.size(); ++f)
      for (std::size_t i = 0; i < 3; ++i) {
        const Edge e = edge_of(faces[f], i);
        if (e[1] >= frames.size() || !may_crease(dot(frames[e[0]].normal, frames[e[1]].normal)))
          continue;
        if (const auto crease = crease_between(places, frames, rule, e[0], e[1], farthest))
          visit(f, i, e, *crease);
      }
  };
  bool any = false;
  for_creases([&](std::size_t, std::size_t, const Edge&, const Crease&) { any = true; });
  if (!any && !(flat > 0) && !(noise > 0)) return {};
  std::vector<std::array<double, 3>> lengths(faces.size());
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (std::size_t i = 0; i < 3; ++i) {
      const Edge e = edge_of(faces[f], i);
      lengths[f][i] = tangent_length(places, frames, e[0], e[1], flat);
    }
  if (!any && !(noise > 0)) return lengths;
  auto over = lengths;
  for_creases([&](std::size_t f, std::size_t i, const Edge& e, const Crease& crease) {
    over[f][i] = length_over(crease, places, frames, e[0], e[1]);
  });
  if (noise > 0) lengthen_over_ridges(places, frames, faces, farthest, over);
  const std::vector<Edge> straight = straight_edges(places, frames, faces, over);
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (std::size_t i = 0; i < 3; ++i)
      if (!std::binary_search(straight.begin(), straight.end(), edge_of(faces[f], i)))
        lengths[f][i] = over[f][i];
  return lengths;
}

std::vector<Index> chord_places(const Places& places, std::span<const TangentFrame> frames,
                                const SheetRule& rule, std::span<const std::array<Index, 3>> faces,
                                std::span<const std::array<double, 3>> lengths, double height,
                                double noise) {
  // Who is farther from the plane of a side than noise lifts anyone is not of that side.
  constexpr double shorter = 0.85, unclear = 0.8, farthest = 4, most_off = 2.5;
  // One side a place, but only where they are asked for.
  NoisyRidges ridges(places, noise > 0 ? frames : std::span<const TangentFrame>());
  std::vector<Index> found;
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (std::size_t i = 0; i < 3; ++i) {
      const Edge e = edge_of(faces[f], i);
      if (e[1] >= frames.size() || !may_crease(dot(frames[e[0]].normal, frames[e[1]].normal)))
        continue;
      const Point3 q = minus(places.at[e[1]], places.at[e[0]]);
      const double length = lengths.empty() ? std::sqrt(dot(q, q)) : lengths[f][i];
      bool chord = length < shorter * way_over_ridge(places, frames, rule, e[0], e[1], height);
      if (noise > 0) {
        const NoisyRidge ridge = ridges.between(e[0], e[1], farthest);
        chord = (ridge.sharp < 1 && (chord || length < unclear * ridge.way)) ||
                (ridge.sharp > 0 && ridge.off > most_off * noise);
      }
      if (chord) found.insert(found.end(), e.begin(), e.end());
    }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

namespace {

constexpr double least_cosine = 0.9;  // of the angle between two normals

struct TangentEdge {
  double square, height;  // length and height, squared
  bool known;
};

TangentEdge edge_between(const Places& places, std::span<const TangentFrame> frames, Index a,
                         Index b) {
  const Point3 q = minus(places.at[b], places.at[a]);
  TangentEdge edge = {dot(q, q), 0, false};
  if (a >= frames.size() || b >= frames.size()) return edge;  // a place that is no point
  const auto &m = frames[a].normal, &n = frames[b].normal;
  const double cosine = dot(m, n);
  if (std::abs(cosine) < least_cosine) return edge;
  Point3 mean;
  for (std::size_t d = 0; d < 3; ++d)
    mean[d] = static_cast<double>(m[d]) + (cosine < 0 ? -1.0 : 1.0) * static_cast<double>(n[d]);
  const double along = dot(mean, q);
  edge.height = along * along / dot(mean, mean);
  edge.known = true;
  return edge;
}

}  // namespace

HeightNoise height_noise(const Places& places, std::span<const TangentFrame> frames) {
  constexpr std::size_t enough = 64, sampled = 4096;
  std::vector<double> near, far, heights;  // squares, in spacings
  const std::size_t n = places.near.point_count();
  for (std::size_t i = 0; i < n; i += n / sampled + 1)
    for (const Index j : places.near.around(static_cast<Index>(i))) {
      const TangentEdge e = edge_between(places, frames, static_cast<Index>(i), j);
      const double spacing = static_cast<double>(frames[i].spacing);
      const double length = std::sqrt(e.square) / spacing;
      if (!e.known) continue;
      if (length >= 0.5 && length < 1) {
        near.push_back(e.height / (spacing * spacing));
        heights.push_back(e.height);
      }
      if (length >= 1.5 && length < 2.25) far.push_back(e.height / (spacing * spacing));
    }
  if (near.size() < enough || far.size() < enough) return {};
  const double low = median(near), high = median(far);
  if (!(low > 0)) return {};
  // Measured: 0.9 for noise on a sphere, 3.4 and more for clean points on a sphere, a swiss roll, a
  // height field and three scans.
  constexpr double noise = 1.5, clean = 3;
  const double share = std::clamp((clean - high / low) / (clean - noise), 0.0, 1.0);
  return {share, share > 0 ? std::sqrt(median(heights)) : 0};
}

double tangent_length(const Places& places, std::span<const TangentFrame> frames, Index a, Index b,
                      double share) {
  const TangentEdge e = edge_between(places, frames, a, b);
  return std::sqrt(std::max(e.square - share * e.height, 0.0));
}

}  // namespace plexway::detail
