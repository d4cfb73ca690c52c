#include "strings/mixed_strings.hpp"

#include <limits>
#include <utility>

#include "strings/to_field.hpp"

namespace plexway::detail {
namespace {

// Where a point of a simplex is a vertex of it.
Index corner_of(const strings::MediaSpace& media, Index simplex, const PointSource& point) {
  for (std::size_t i = 0; i < 4; ++i)
    if (point.barycentric[i] == 1) return media.simplices()[simplex].corner[i];
  return none;
}

// A point of these simplices, as one of each.
std::vector<strings::Inside> inside_of(const strings::MediaSpace& media, const strings::Point& at,
                                       std::span<const Index> simplices) {
  std::vector<strings::Inside> inside;
  for (const Index s : simplices) {
    const auto& simplex = media.simplices()[s];
    inside.push_back({s, simplex.medium, simplex.corner, media.beside(s, at)});
  }
  return inside;
}

strings::Source source_of(const MixedSpace& space, const PointSource& given,
                          std::vector<strings::Inside>& inside) {
  const strings::MediaSpace& media = *space.media;
  strings::Source source;
  source.offset = given.offset / media.unit();
  if (given.vertex != none) {
    source.point = space.point[given.vertex];
  } else {
    const Index simplex = space.simplex(given.simplex);
    source.point = corner_of(media, simplex, given);
    source.at = media.at(simplex, given.barycentric);
    if (source.point == none)
      source.inside = inside =
          inside_of(media, source.at, media.simplices_around(simplex, given.barycentric));
  }
  if (source.point != none) source.at = media.point(source.point);
  return source;
}

}  // namespace

template <class Real>
void MixedStrings::solve(const MixedComplex<Real>& domain, std::shared_ptr<const MixedSpace> space,
                         std::span<const PointSource> sources, const PropagateOptions& options,
                         const strings::Threads& threads, DistanceField<Real>& field) {
  const strings::MediaSpace& media = *space->media;
  if (!solver_ || space_ != space) {
    solver_ = std::make_unique<strings::Solver>(media);
    space_ = std::move(space);
  }
  sources_.clear();
  inside_.assign(sources.size(), {});
  for (const PointSource& s : sources)
    sources_.push_back(source_of(*space_, s, inside_[sources_.size()]));
  const double unit = media.unit();
  field.complete =
      solver_->solve(sources_, strings::limits_of(options, unit, domain.simplex_count(), threads));
  const auto number = [&](Index vertex) { return space_->point[vertex]; };
  strings::to_field(*solver_, domain.vertex_count(), number, unit, sources, options.radius, field);
  field.accuracy = Accuracy::accurate();
}

MixedStrings::Found MixedStrings::at(const PointSource& point) const {
  const std::lock_guard lock(asked_);
  const strings::MediaSpace& media = *space_->media;
  Index number;
  if (point.vertex != none) {
    number = space_->point[point.vertex];
  } else {
    const Index simplex = space_->simplex(point.simplex);
    number = corner_of(media, simplex, point);
    if (number == none) {
      number = static_cast<Index>(media.points());
      const strings::Point at = media.at(simplex, point.barycentric);
      const auto inside = inside_of(media, at, media.simplices_around(simplex, point.barycentric));
      std::vector<Index> own;  // sources that share one of these
      for (Index n = 0; n < inside_.size(); ++n)
        if (!inside_[n].empty()) own.push_back(n);
      solver_->attach(at, inside, own);
    }
  }
  const Index source = solver_->source(number);
  if (source == none) return {std::numeric_limits<double>::infinity(), none, {}, {}};
  auto [points, through] = solver_->path(number);
  return {solver_->distance(number) * media.unit(), source, std::move(points), std::move(through)};
}

std::size_t MixedStrings::bytes() const {
  return sizeof(*this) + (solver_ ? solver_->bytes() : 0) +
         sources_.capacity() * sizeof(strings::Source);
}

template void MixedStrings::solve(const MixedComplex<float>&, std::shared_ptr<const MixedSpace>,
                                  std::span<const PointSource>, const PropagateOptions&,
                                  const strings::Threads&, DistanceField<float>&);
template void MixedStrings::solve(const MixedComplex<double>&, std::shared_ptr<const MixedSpace>,
                                  std::span<const PointSource>, const PropagateOptions&,
                                  const strings::Threads&, DistanceField<double>&);

}  // namespace plexway::detail
