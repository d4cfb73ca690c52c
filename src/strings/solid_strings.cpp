#include "strings/solid_strings.hpp"

#include <algorithm>
#include <limits>

#include <plexway/error.hpp>

#include "complex/number_range.hpp"

namespace plexway {
namespace {

using strings::Point;

template <class Real>
strings::Source source_of(const TetMesh<Real>& mesh, const strings::SolidSpace& space,
                          const PointSource& given) {
  strings::Source source;
  source.offset = given.offset / mesh.unit();
  if (given.vertex != none) {
    source.vertex = mesh.inside_vertex(given.vertex);
    source.at = source.beside = space.point(source.vertex);
    return source;
  }
  const auto [tet, turned] = mesh.inside_tet(given.simplex);
  std::array<double, 4> b = given.barycentric;
  if (turned) std::swap(b[2], b[3]);
  Point middle = {0, 0, 0};
  source.at = {0, 0, 0};
  for (std::size_t i = 0; i < 4; ++i) {
    source.corners[i] = mesh.tets()[tet].corner[i];
    source.at = source.at + b[i] * space.point(source.corners[i]);
    middle = middle + .25 * space.point(source.corners[i]);
  }
  source.beside = source.at + space.aside() * strings::unit(middle - source.at);
  return source;
}

}  // namespace

template <class Real>
void SolidStrings::solve(const TetMesh<Real>& mesh, std::span<const PointSource> sources,
                         const PropagateOptions& options, DistanceField<Real>& field) {
  NumberRange<Real>::check_unit(mesh.unit());
  if (!space_ || identity_ != mesh.identity()) {
    solver_.reset();
    space_ = std::make_unique<strings::SolidSpace>(mesh);
    solver_ = std::make_unique<strings::Solver>(*space_);
    identity_ = mesh.identity();
  }
  sources_.clear();
  for (const PointSource& s : sources) sources_.push_back(source_of(mesh, *space_, s));
  const std::size_t vertices = mesh.vertex_count();
  strings::Limits limits;
  limits.radius = options.radius / mesh.unit();
  limits.expansions = options.max_expansions;
  if (options.progress)
    limits.progress = [&](std::size_t expansions, double distance) {
      if (!options.progress({expansions, std::min(expansions, mesh.tet_count()), mesh.tet_count(),
                             distance * mesh.unit()}))
        throw Cancelled("cancelled by the progress callback");
    };
  field.complete = solver_->solve(sources_, limits);
  constexpr Real infinity = std::numeric_limits<Real>::infinity();
  field.distance.resize(vertices);
  field.label.assign(sources.size() > 1 ? vertices : 0, none);
  for (std::size_t v = 0; v < vertices; ++v) {
    const Index inside = mesh.inside_vertex(static_cast<Index>(v));
    const Real d = static_cast<Real>(solver_->distance(inside) * mesh.unit());
    const bool in = d <= static_cast<Real>(options.radius) && d < infinity;
    field.distance[v] = in ? d : infinity;
    if (in && sources.size() > 1) field.label[v] = solver_->source(inside);
  }
  // An offset survives scaling exactly.
  for (const PointSource& s : sources)
    if (s.vertex != none && s.offset <= options.radius)
      field.distance[s.vertex] = std::min(field.distance[s.vertex], static_cast<Real>(s.offset));
  field.accuracy = Accuracy::accurate();
  field.error.clear();
  field.statistics = {};
  field.statistics.expansions = solver_->counts().expansions;
  field.statistics.updates = solver_->counts().labels;
}

std::size_t SolidStrings::bytes() const {
  return sizeof(*this) + (space_ ? space_->bytes() : 0) + (solver_ ? solver_->bytes() : 0);
}

template void SolidStrings::solve(const TetMesh<float>&, std::span<const PointSource>,
                                  const PropagateOptions&, DistanceField<float>&);
template void SolidStrings::solve(const TetMesh<double>&, std::span<const PointSource>,
                                  const PropagateOptions&, DistanceField<double>&);

}  // namespace plexway
