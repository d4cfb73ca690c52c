#include <plexway/apps/path_field.hpp>

#include <string>
#include <type_traits>

#include <plexway/error.hpp>

#include "apps/solid_trace.hpp"
#include "apps/solved.hpp"
#include "apps/surface_trace.hpp"
#include "apps/wire_trace.hpp"
#include "executors/checks.hpp"

namespace plexway {
namespace {

template <class Real>
SourceDomain described(const TriangleMesh<Real>& mesh) {
  return {mesh.vertex_count(), mesh.face_count(), "face", 3};
}
template <class Real>
SourceDomain described(const TetMesh<Real>& mesh) {
  return {mesh.vertex_count(), mesh.tet_count(), "tet", 4};
}
template <class Real>
SourceDomain described(const Wireframe<Real>& wireframe) {
  return {wireframe.vertex_count(), wireframe.edge_count(), "edge", 2};
}

template <class Real>
Path trace_in(const TriangleMesh<Real>& mesh, const Solved<Real>& solved, const PointSource& point,
              const TraceOptions& options) {
  return SurfaceTrace<Real>(mesh, solved).trace(point, options);
}
template <class Real>
Path trace_in(const TetMesh<Real>& mesh, const Solved<Real>& solved, const PointSource& point,
              const TraceOptions&) {
  return trace_solid(mesh, solved, point);
}
template <class Real>
Path trace_in(const Wireframe<Real>& wireframe, const Solved<Real>& solved,
              const PointSource& point, const TraceOptions&) {
  return trace_wire(wireframe, solved, point);
}

}  // namespace

template <template <class> class Domain, class Real>
PathField<Domain<Real>>::PathField(const Domain<Real>& domain,
                                   std::span<const std::array<double, 3>> positions)
    : domain_(&domain), positions_(positions) {
  const std::span<const Index> inside = domain.vertices_inside();
  if (!positions.empty() && positions.size() != inside.size())
    throw UsageError(std::to_string(positions.size()) + " positions for " +
                     std::to_string(inside.size()) + " vertices: give one a vertex, or none");
  outer_.resize(inside.size());
  for (std::size_t v = 0; v < inside.size(); ++v) outer_[inside[v]] = static_cast<Index>(v);
  if constexpr (std::is_same_v<Domain<Real>, TetMesh<Real>>) {
    outer_simplices_.resize(domain.tet_count());
    for (Index t = 0; t < domain.tet_count(); ++t) outer_simplices_[domain.inside_tet(t).first] = t;
  }
  if constexpr (std::is_same_v<Domain<Real>, Wireframe<Real>>) {
    // Rows hold their arcs in the order of the edges.
    outer_simplices_.resize(domain.arcs().size());
    std::vector<Index> end(domain.begin().begin(), domain.begin().end() - 1);
    for (Index e = 0; e < domain.edge_count(); ++e) {
      const auto edge = domain.inside_edge(e);
      outer_simplices_[end[edge.from]++] = e;
      if (edge.from != edge.to) outer_simplices_[end[edge.to]++] = e;
    }
  }
}

template <template <class> class Domain, class Real>
void PathField<Domain<Real>>::took(std::span<const PointSource> sources, Visibility visibility,
                                   bool labels) {
  sources_.assign(sources.begin(), sources.end());
  visibility_ = visibility;
  labels_ = labels;
  solved_ = true;
}

template <template <class> class Domain, class Real>
Path PathField<Domain<Real>>::trace(const PointSource& point, const TraceOptions& options) const {
  if (!solved_) throw UsageError("there is nothing to trace before a solve");
  PointSource at = point;
  at.offset = 0;
  check_source(at, described(*domain_));
  const Solved<Real> solved = {workspace_, field_,           sources_,    positions_, {},
                               outer_,     outer_simplices_, visibility_, labels_};
  check(options);
  return trace_in(*domain_, solved, at, options);
}

template <template <class> class Domain, class Real>
std::size_t PathField<Domain<Real>>::bytes() const {
  return (outer_.capacity() + outer_simplices_.capacity()) * sizeof(Index) + workspace_.bytes() +
         field_.distance.capacity() * sizeof(Real) + field_.label.capacity() * sizeof(Index) +
         sources_.capacity() * sizeof(PointSource);
}

template class PathField<TriangleMesh<float>>;
template class PathField<TriangleMesh<double>>;
template class PathField<TetMesh<float>>;
template class PathField<TetMesh<double>>;
template class PathField<Wireframe<float>>;
template class PathField<Wireframe<double>>;

}  // namespace plexway
