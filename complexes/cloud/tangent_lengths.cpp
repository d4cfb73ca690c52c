#include "complexes/cloud/tangent_lengths.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "complexes/common/median.hpp"

namespace plexway {
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

}  // namespace plexway
