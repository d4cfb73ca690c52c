#include "strings/flat/flat_strings.hpp"

#include "strings/to_field.hpp"

namespace plexway::detail {

using strings::FlatSpace;

template <class Real>
void FlatStrings::solve(const SimplicialComplex<Real, 4>& complex,
                        std::span<const PointSource> sources, const PropagateOptions& options,
                        DistanceField<Real>& field) {
  const FlatDomain<4>& flat = *complex.flat();
  const auto space = flat.space.get<FlatSpace<4>>(
      [&] { return std::make_shared<const FlatSpace<4>>(complex, flat); });
  if (space != space_) {
    space_ = space;
    solver_ = std::make_unique<strings::FlatSolver<4>>(*space_);
  }
  const double unit = complex.unit();
  roots_.clear();
  for (const PointSource& s : sources)
    roots_.push_back(
        {complex.inside_vertex(s.vertex), s.offset / unit, static_cast<Index>(roots_.size())});
  field.complete =
      solver_->solve(roots_, strings::limits_of(options, unit, complex.simplex_count()));
  const auto number = [&](Index vertex) { return complex.inside_vertex(vertex); };
  strings::to_field(*solver_, complex.vertex_count(), number, unit, sources, options.radius, field);
}

template void FlatStrings::solve(const SimplicialComplex<float, 4>&, std::span<const PointSource>,
                                 const PropagateOptions&, DistanceField<float>&);
template void FlatStrings::solve(const SimplicialComplex<double, 4>&, std::span<const PointSource>,
                                 const PropagateOptions&, DistanceField<double>&);

}  // namespace plexway::detail
