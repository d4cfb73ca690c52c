#include <plexway/paths/mixed_path_field.hpp>

#include <string>
#include <utility>

#include <plexway/error.hpp>

#include "executors/checks.hpp"
#include "labels/workspace_state.hpp"
#include "paths/cell_trace.hpp"
#include "paths/media_paths.hpp"
#include "paths/solved.hpp"
#include "strings/mixed_strings.hpp"

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
