#include <plexway/paths/mixed_path_field.hpp>

#include <string>
#include <variant>

#include <plexway/error.hpp>

#include "executors/checks.hpp"
#include "paths/cell_trace.hpp"
#include "paths/solved.hpp"

namespace plexway {
namespace {

// How many corners a simplex has; 0 if there is none such.
template <class Real>
std::size_t corners_of(const MixedComplex<Real>& domain, Index simplex) {
  for (const auto& piece : domain.pieces())
    if (simplex >= piece.first_simplex && simplex - piece.first_simplex < piece.simplices)
      return domain.complex(piece).index() == 0 ? 3 : domain.complex(piece).index() == 1 ? 4 : 2;
  return 0;
}

}  // namespace

template <class Real>
PathField<MixedComplex<Real>>::PathField(const MixedComplex<Real>& domain,
                                         std::span<const std::array<double, 3>> positions)
    : domain_(&domain), positions_(positions), cells_(new ComplexCells<Real>(domain)) {
  if (!positions.empty() && positions.size() != domain.vertex_count())
    throw UsageError(std::to_string(positions.size()) + " positions for " +
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
void PathField<MixedComplex<Real>>::adopt(DistanceField<Real> found,
                                          std::span<const PointSource> sources) {
  field_ = std::move(found);
  sources_.assign(sources.begin(), sources.end());
  distance_ = cell_distances<Real>(*cells_, field_.distance);
  solved_ = true;
}

template <class Real>
PointSource PathField<MixedComplex<Real>>::checked(const PointSource& point) const {
  if (!solved_) throw UsageError("there is nothing to trace before a solve");
  PointSource at = point;
  at.offset = 0;
  const std::size_t corners = at.vertex == none ? corners_of(*domain_, at.simplex) : 4;
  check_source(at, {domain_->vertex_count(), domain_->simplex_count(), "simplex",
                    corners == 0 ? 4 : corners});
  return at;
}

template <class Real>
Path PathField<MixedComplex<Real>>::trace(const PointSource& point,
                                          const TraceOptions& options) const {
  const PointSource at = checked(point);
  check(options, *domain_);
  return trace_cells({*cells_, distance_, sources_, positions_}, at);
}

template <class Real>
double PathField<MixedComplex<Real>>::at(const PointSource& point, ReadOut level) const {
  return read_cells({*cells_, distance_, sources_, positions_}, checked(point), level);
}

template <class Real>
std::size_t PathField<MixedComplex<Real>>::bytes() const {
  return cells_->bytes() + distance_.capacity() * sizeof(double) +
         field_.distance.capacity() * sizeof(Real);
}

template class PathField<MixedComplex<float>>;
template class PathField<MixedComplex<double>>;

}  // namespace plexway
