#include "strings/solid_strings.hpp"

#include <algorithm>
#include <limits>

#include "complexes/common/number_range.hpp"
#include "strings/to_field.hpp"

namespace plexway::detail {

using strings::Point;

strings::Source source_at(const strings::MediaSpace& space, Index vertex, double offset) {
  strings::Source source;
  source.point = vertex;
  source.at = space.point(vertex);
  source.offset = offset;
  return source;
}

template <class Real>
strings::Inside inside_of(const TetMesh<Real>& mesh, const strings::MediaSpace& space, Index tet,
                          const Point& at) {
  strings::Inside inside{tet, 0, {}, {}};
  Point middle = {0, 0, 0};
  for (std::size_t i = 0; i < 4; ++i) {
    inside.corner[i] = mesh.tets()[tet].corner[i];
    middle = middle + .25 * space.point(inside.corner[i]);
  }
  inside.beside = at + space.aside() * strings::unit(middle - at);
  return inside;
}

template <class Real>
strings::Source source_of(const TetMesh<Real>& mesh, const strings::MediaSpace& space,
                          const PointSource& given, strings::Inside& inside) {
  const double offset = given.offset / mesh.unit();
  if (given.vertex != none) return source_at(space, mesh.inside_vertex(given.vertex), offset);
  const auto [tet, turned] = mesh.inside_tet(given.simplex);
  std::array<double, 4> b = given.barycentric;
  if (turned) std::swap(b[2], b[3]);
  return source_in(mesh, space, tet, b, offset, inside);
}

template <class Real>
strings::Source source_in(const TetMesh<Real>& mesh, const strings::MediaSpace& space, Index tet,
                          const std::array<double, 4>& weight, double offset,
                          strings::Inside& inside) {
  strings::Source source;
  source.offset = offset;
  source.at = {0, 0, 0};
  for (std::size_t i = 0; i < 4; ++i)
    source.at = source.at + weight[i] * space.point(mesh.tets()[tet].corner[i]);
  inside = inside_of(mesh, space, tet, source.at);
  source.inside = {&inside, 1};
  return source;
}

template <class Real>
std::shared_ptr<const strings::MediaSpace> space_of(const TetMesh<Real>& mesh) {
  return mesh.space().template get<strings::MediaSpace>([&] {
    return std::make_shared<const strings::MediaSpace>(
        std::make_shared<const strings::SolidSpace>(mesh));
  });
}

template <class Real>
void SolidStrings::solve(const TetMesh<Real>& mesh, std::span<const PointSource> sources,
                         const PropagateOptions& options, const strings::Threads& threads,
                         DistanceField<Real>& field) {
  NumberRange<Real>::check_unit(mesh.unit());
  if (!solver_ || identity_ != mesh.identity()) {
    space_ = space_of(mesh);
    solver_ = std::make_unique<strings::Solver>(*space_);
    identity_ = mesh.identity();
    unit_ = mesh.unit();
  }
  sources_.clear();
  inside_.clear();
  inside_.reserve(sources.size());
  tets_.resize(sources.size());
  for (Index n = 0; n < sources.size(); ++n) {
    const PointSource& s = sources[n];
    if (s.vertex == none) inside_.emplace_back(mesh.inside_tet(s.simplex).first, n);
    sources_.push_back(source_of(mesh, *space_, s, tets_[n]));
  }
  std::sort(inside_.begin(), inside_.end());
  const double unit = mesh.unit();
  field.complete =
      solver_->solve(sources_, strings::limits_of(options, unit, mesh.tet_count(), threads));
  const auto number = [&](Index vertex) { return mesh.inside_vertex(vertex); };
  strings::to_field(*solver_, mesh.vertex_count(), number, unit, sources, options.radius, field);
  field.accuracy = Accuracy::accurate();
}

SolidStrings::Found SolidStrings::found(Index vertex) const {
  const Index source = solver_->source(vertex);
  if (source == none) return {std::numeric_limits<double>::infinity(), none, {}};
  return {solver_->distance(vertex) * unit_, source, solver_->path(vertex).points};
}

SolidStrings::Found SolidStrings::at(Index vertex) const {
  const std::lock_guard lock(asked_);
  return found(vertex);
}

template <class Real>
SolidStrings::Found SolidStrings::at(const TetMesh<Real>& mesh, Index tet,
                                     const std::array<double, 4>& weight) const {
  const std::lock_guard lock(asked_);
  Point at = {0, 0, 0};
  for (std::size_t i = 0; i < 4; ++i) {
    const Index corner = mesh.tets()[tet].corner[i];
    if (weight[i] == 1) return found(corner);
    at = at + weight[i] * space_->point(corner);
  }
  std::vector<Index> own;
  for (auto in = std::lower_bound(inside_.begin(), inside_.end(), std::pair{tet, Index{0}});
       in != inside_.end() && in->first == tet; ++in)
    own.push_back(in->second);
  const strings::Inside inside = inside_of(mesh, *space_, tet, at);
  solver_->attach(at, {&inside, 1}, own);
  return found(static_cast<Index>(space_->points()));
}

std::size_t SolidStrings::bytes() const {
  return sizeof(*this) + (solver_ ? solver_->bytes() : 0) +
         sources_.capacity() * sizeof(strings::Source) + tets_.capacity() * sizeof(strings::Inside);
}

template std::shared_ptr<const strings::MediaSpace> space_of(const TetMesh<float>&);
template std::shared_ptr<const strings::MediaSpace> space_of(const TetMesh<double>&);
template strings::Inside inside_of(const TetMesh<float>&, const strings::MediaSpace&, Index,
                                   const Point&);
template strings::Inside inside_of(const TetMesh<double>&, const strings::MediaSpace&, Index,
                                   const Point&);
template strings::Source source_of(const TetMesh<float>&, const strings::MediaSpace&,
                                   const PointSource&, strings::Inside&);
template strings::Source source_of(const TetMesh<double>&, const strings::MediaSpace&,
                                   const PointSource&, strings::Inside&);
template strings::Source source_in(const TetMesh<float>&, const strings::MediaSpace&, Index,
                                   const std::array<double, 4>&, double, strings::Inside&);
template strings::Source source_in(const TetMesh<double>&, const strings::MediaSpace&, Index,
                                   const std::array<double, 4>&, double, strings::Inside&);

template void SolidStrings::solve(const TetMesh<float>&, std::span<const PointSource>,
                                  const PropagateOptions&, const strings::Threads&,
                                  DistanceField<float>&);
template void SolidStrings::solve(const TetMesh<double>&, std::span<const PointSource>,
                                  const PropagateOptions&, const strings::Threads&,
                                  DistanceField<double>&);

template SolidStrings::Found SolidStrings::at(const TetMesh<float>&, Index,
                                              const std::array<double, 4>&) const;
template SolidStrings::Found SolidStrings::at(const TetMesh<double>&, Index,
                                              const std::array<double, 4>&) const;

}  // namespace plexway::detail
