#include "paths/media_paths.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>

#include "paths/infinity.hpp"
#include "paths/straight_walk.hpp"

namespace plexway::detail {
namespace {

struct Medium {
  const strings::MediaSpace& space;
  Index medium;

  [[nodiscard]] const std::array<Index, 4>& corners(Index s) const {
    return space.simplices()[s].corner;
  }
  [[nodiscard]] const strings::Point& point(Index p) const { return space.point(p); }
  // Triangles may belong to a solid medium, if that is as fast.
  [[nodiscard]] bool may_cross(Index s) const {
    return space.simplices()[s].medium == medium &&
           (corners(s)[3] != none || !space.media()[medium].is_solid);
  }
  [[nodiscard]] std::vector<Index> around(Index s, const std::array<double, 4>& weight) const {
    return space.simplices_around(s, weight);
  }
};
using MediaWalk = StraightWalk<Medium>;

}  // namespace

template <class Real>
MediaPaths::MediaPaths(const MixedStrings& strings, std::span<const Real> distance,
                       std::span<const PointSource> sources,
                       std::span<const std::array<double, 3>> positions)
    : strings_(&strings),
      space_(&strings.space()),
      sources_(sources),
      positions_(positions),
      distance_(space_->media->points(), infinity) {
  if (!positions.empty()) vertex_.resize(distance_.size());
  for (Index v = 0; v < distance.size(); ++v) {
    const Index p = space_->point[v];
    distance_[p] = std::min(distance_[p], static_cast<double>(distance[v]));
    if (!positions.empty()) vertex_[p] = v;
  }
}

bool MediaPaths::is_reached(const PointSource& point) const {
  const auto reached = [&](Index p) { return p != none && distance_[p] < infinity; };
  if (point.vertex != none) return reached(space_->point[point.vertex]);
  const auto& corner = space_->media->simplices()[space_->simplex(point.simplex)].corner;
  return std::any_of(corner.begin(), corner.end(), reached);
}

std::vector<Index> MediaPaths::simplices_at(const PointSource& point) const {
  if (point.vertex != none) {
    const auto found = space_->media->simplices_at(space_->point[point.vertex]);
    return {found.begin(), found.end()};
  }
  return space_->media->simplices_around(space_->simplex(point.simplex), point.barycentric);
}

void MediaPaths::add(Path& path, Index simplex, const strings::Point& at) const {
  constexpr double rounding = 1e-14;
  MediaWalk::Weights w = MediaWalk({*space_->media, none}).weights(simplex, at);
  double sum = 0;
  for (double& x : w) sum += x = x > rounding ? x : 0;
  for (double& x : w) x /= sum;
  path.points.push_back({space_->outer_simplex(simplex), w});
  if (positions_.empty()) return;
  std::array<double, 3> place = {0, 0, 0};
  for (std::size_t i = 0; i < 4; ++i)
    if (const Index p = space_->media->simplices()[simplex].corner[i]; p != none)
      for (std::size_t k = 0; k < 3; ++k) place[k] += w[i] * positions_[vertex_[p]][k];
  path.positions.push_back(place);
}

Path MediaPaths::trace(const PointSource& point) const {
  Path path;
  if (!is_reached(point)) return path;
  std::vector<Index> from = simplices_at(point);
  if (from.empty()) {  // a vertex of no simplex is a source
    for (Index n = 0; n < sources_.size(); ++n)
      if (sources_[n].vertex == point.vertex &&
          (path.source == none || sources_[n].offset < sources_[path.source].offset))
        path.source = n, path.length = 0;
    return path;
  }
  const MixedStrings::Found found = strings_->at(point);
  if (found.points.empty()) return path;
  const strings::MediaSpace& media = *space_->media;
  path.source = found.source;
  path.length = 0;
  Index last = none;
  std::vector<MediaWalk::Step> steps;
  for (std::size_t k = found.media.size(); k-- > 0;) {
    const strings::Point &p = found.points[k + 1], &q = found.points[k], leg = q - p;
    path.length += media.unit() * media.media()[found.media[k]].slowness * norm(leg);
    if (!(norm(leg) > 1e-12)) continue;
    const MediaWalk walk({media, found.media[k]});
    const bool arrived = walk.walk(from, p, q, steps);
    for (const auto& step : steps) add(path, last = step.simplex, p + step.begin * leg);
    if (arrived) {
      from = walk.around(last, q);
    } else {  // on from where the next leg begins
      from.resize(media.simplices().size());
      std::iota(from.begin(), from.end(), Index{0});
    }
  }
  add(path, last == none ? from.front() : last, found.points.front());
  return path;
}

double MediaPaths::at(const PointSource& point, ReadOut level) const {
  if (point.vertex != none) return distance_[space_->point[point.vertex]];
  if (level != ReadOut::linear) return strings_->at(point).distance;
  const auto& corner = space_->media->simplices()[space_->simplex(point.simplex)].corner;
  double sum = 0;
  for (std::size_t i = 0; i < 4; ++i)
    if (point.barycentric[i] > 0) sum += point.barycentric[i] * distance_[corner[i]];
  return sum;
}

template MediaPaths::MediaPaths(const MixedStrings&, std::span<const float>,
                                std::span<const PointSource>,
                                std::span<const std::array<double, 3>>);
template MediaPaths::MediaPaths(const MixedStrings&, std::span<const double>,
                                std::span<const PointSource>,
                                std::span<const std::array<double, 3>>);

}  // namespace plexway::detail
