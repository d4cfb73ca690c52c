#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/fields/read_out.hpp>
#include <plexway/paths/mixed_path_field.hpp>
#include <plexway/paths/path.hpp>
#include <plexway/source/point_source.hpp>

#include "complexes/common/number_range.hpp"
#include "executors/checks.hpp"
#include "labels/workspace_state.hpp"
#include "paths/cells/cells.hpp"
#include "paths/solved.hpp"
#include "paths/straight_walk.hpp"
#include "strings/mixed_strings.hpp"

namespace plexway::detail {

/// Paths, and distances of points, on a mixed domain that strings solved: the strings themselves.
class MediaPaths {
 public:
  /// `distance` is the field's, one a vertex, which may end at a radius where strings go on; paths
  /// are drawn between `positions`, one a vertex, or not at all. Refers to all but the distances.
  template <class Real>
  MediaPaths(const MixedStrings& strings, std::span<const Real> distance,
             std::span<const PointSource> sources,
             std::span<const std::array<double, 3>> positions);

  /// The string from a point back to its source, cut where it goes from simplex to simplex. Empty
  /// where none leads.
  [[nodiscard]] Path trace(const PointSource& point) const;
  /// In the domain's unit.
  [[nodiscard]] double at(const PointSource& point, ReadOut level) const;
  [[nodiscard]] std::size_t bytes() const {
    return distance_.capacity() * sizeof(double) + vertex_.capacity() * sizeof(Index);
  }

 private:
  [[nodiscard]] bool is_reached(const PointSource& point) const;
  [[nodiscard]] std::vector<Index> simplices_at(const PointSource& point) const;
  void add(Path& path, Index simplex, const strings::Point& at) const;

  const MixedStrings* strings_;
  const MixedSpace* space_;
  std::span<const PointSource> sources_;
  std::span<const std::array<double, 3>> positions_;
  std::vector<double> distance_;  // of points of the space
  std::vector<Index> vertex_;     // likewise, one of those that lie there; if paths are drawn
};

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

}  // namespace plexway::detail

namespace plexway {
using namespace detail;

template <class Real>
PathField<MixedComplex<Real>>::PathField(const MixedComplex<Real>& domain, GivenPoints positions)
    : domain_(&domain), positions_(std::move(positions)) {
  if (!MixedSpace::of(domain)->media) cells_ = std::make_unique<ComplexCells<Real>>(domain);
  if (!positions_.empty() && positions_.size() != domain.vertex_count())
    throw UsageError(std::to_string(positions_.size()) + " positions for " +
                     std::to_string(domain.vertex_count()) +
                     " vertices: give one a vertex, or none");
}

template <class Real>
PathField<MixedComplex<Real>>::PathField(PathField&&) noexcept = default;
template <class Real>
PathField<MixedComplex<Real>>& PathField<MixedComplex<Real>>::operator=(PathField&&) noexcept =
    default;
template <class Real>
PathField<MixedComplex<Real>>::~PathField() = default;

template <class Real>
void PathField<MixedComplex<Real>>::adopt(DistanceField<Real> found, const SourceList& sources) {
  const std::span<const PointSource> points = points_of(Purpose::paths, sources);
  if (!cells_) {
    auto& strings = workspace_.state().media;
    if (!strings) strings = std::make_shared<MixedStrings>();
    strings->solve(*domain_, MixedSpace::of(*domain_), points, {}, {}, field_);
  }
  field_ = std::move(found);
  took(points);
}

template <class Real>
void PathField<MixedComplex<Real>>::took(std::span<const PointSource> sources) {
  sources_.assign(sources.begin(), sources.end());
  const std::span<const Real> distance = field_.distance;
  if (cells_)
    distance_ = cell_distances<Real>(*cells_, distance);
  else
    paths_ = std::make_unique<MediaPaths>(*workspace_.state().media, distance,
                                          std::span<const PointSource>(sources_), positions_);
  solved_ = true;
}

template <class Real>
PointSource PathField<MixedComplex<Real>>::checked(const PointSource& point) const {
  if (!solved_) throw UsageError("there is nothing to trace before a solve");
  PointSource at = point;
  at.offset = 0;
  check_source(at, source_domain(*domain_, at));
  return at;
}

template <class Real>
Path PathField<MixedComplex<Real>>::trace(const PointSource& point,
                                          const TraceOptions& options) const {
  const PointSource at = checked(point);
  check(options, *domain_);
  if (paths_) return paths_->trace(at);
  return trace_cells({*cells_, distance_, sources_, positions_}, at);
}

template <class Real>
double PathField<MixedComplex<Real>>::at(const PointSource& point, ReadOut level) const {
  const PointSource inside = checked(point);
  if (paths_) return paths_->at(inside, level);
  return read_cells({*cells_, distance_, sources_, positions_}, inside, level);
}

template <class Real>
std::size_t PathField<MixedComplex<Real>>::bytes() const {
  const auto& strings = workspace_.state().media;
  return (cells_ ? cells_->bytes() : 0) + (paths_ ? paths_->bytes() : 0) +
         (strings ? strings->bytes() : 0) + workspace_.bytes() +
         distance_.capacity() * sizeof(double) + field_.distance.capacity() * sizeof(Real);
}

template class PathField<MixedComplex<float>>;
template class PathField<MixedComplex<double>>;

}  // namespace plexway
