#include <plexway/paths/path_field.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <type_traits>
#include <utility>

#include <plexway/error.hpp>

#include "complexes/common/arrays.hpp"
#include "executors/checks.hpp"
#include "fields/surface_labels.hpp"
#include "fields/window_read_out.hpp"
#include "paths/cells/cells.hpp"
#include "paths/solved.hpp"
#include "paths/string_paths.hpp"
#include "paths/strip_paths.hpp"
#include "paths/surface_trace.hpp"

namespace plexway {
using namespace detail;
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

template <class Domain>
struct ReadOutFor;
template <class Real>
struct ReadOutFor<TriangleMesh<Real>> {
  using Type = SurfaceReadOut<Real>;
};
template <class Real>
struct ReadOutFor<TetMesh<Real>> {
  using Type = StringPaths<Real>;
};
template <class Domain>
using ReadOutOf = typename ReadOutFor<Domain>::Type;

template <class Real>
double distance_in(const TriangleMesh<Real>& mesh, const SurfaceReadOut<Real>& read_out,
                   const PointSource& at, ReadOut level) {
  const auto [f, turned] = mesh.inside_face(at.simplex);
  return read_out.at(f, inside(at.barycentric, turned), level) * mesh.unit();
}
template <class Real>
double distance_in(const TetMesh<Real>& mesh, const StringPaths<Real>& paths, const PointSource& at,
                   ReadOut level) {
  const auto [t, turned] = mesh.inside_tet(at.simplex);
  std::array<double, 4> weight = at.barycentric;
  if (turned) std::swap(weight[2], weight[3]);
  return paths.at(t, weight, level);
}
template <class Real>
double linear_in(const TriangleMesh<Real>& mesh, std::span<const Index> outer,
                 std::span<const Real> distance, const PointSource& at) {
  const auto [f, turned] = mesh.inside_face(at.simplex);
  const std::array<double, 3> weight = inside(at.barycentric, turned);
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i)
    if (weight[i] > 0)
      sum += weight[i] * static_cast<double>(distance[outer[mesh.triangles()[f].corner[i]]]);
  return sum;
}

/// The middle of a triangle of the input, as a point of one of `mesh`, not on its rim, where the
/// way back is not distinguished from others. Numbers inside.
template <class Real>
std::pair<Index, std::array<double, 3>> middle(const TriangleMesh<Real>& mesh,
                                               const IntrinsicDelaunay* delaunay, Index simplex) {
  constexpr double third = 1. / 3, least = 1e-9;
  std::array<double, 3> at = {third, third, third};
  Index face = simplex;
  if (delaunay != nullptr) {
    const PointSource there = delaunay->to_intrinsic(PointSource::in(simplex, at));
    face = there.simplex;
    double sum = 0;
    for (std::size_t i = 0; i < 3; ++i) sum += at[i] = std::max(there.barycentric[i], least);
    for (double& share : at) share /= sum;
  }
  const auto [f, turned] = mesh.inside_face(face);
  return {f, inside({at[0], at[1], at[2], 0}, turned)};
}

}  // namespace

template <template <class> class Domain, class Real>
PathField<Domain<Real>>::PathField(const Domain<Real>& domain, GivenPoints positions)
    : PathField(domain, nullptr, domain, std::move(positions)) {}

template <template <class> class Domain, class Real>
PathField<Domain<Real>>::PathField(const Domain<Real>& domain, const IntrinsicDelaunay& delaunay,
                                   const Domain<Real>& input,
                                   GivenPoints positions) requires(Domain<Real>::kind ==
                                                                   DomainKind::surface)
    : PathField(domain, &delaunay, input, std::move(positions)) {}

template <template <class> class Domain, class Real>
PathField<Domain<Real>>::PathField(const Domain<Real>& domain, const IntrinsicDelaunay* delaunay,
                                   const Domain<Real>& given, GivenPoints positions)
    : domain_(&domain), given_(&given), delaunay_(delaunay), positions_(std::move(positions)) {
  // Without one space around that lines are straight in.
  if (Domain<Real>::kind == DomainKind::wireframe ||
      given.metric() == (Domain<Real>::kind == DomainKind::solid ? MetricKind::intrinsic
                                                                 : MetricKind::refracting))
    cells_ = std::make_shared<const ComplexCells<Real>>(given);
  if (!positions_.empty() && positions_.size() != given.vertex_count())
    throw UsageError(std::to_string(positions_.size()) + " positions for " +
                     std::to_string(given.vertex_count()) +
                     " vertices: give one a vertex, or none");
  outer_ = vertices_outside(domain);
  if (delaunay != nullptr) given_outer_ = vertices_outside(given);
  if constexpr (std::is_same_v<Domain<Real>, TetMesh<Real>>) {
    outer_simplices_.resize(domain.tet_count());
    for (Index t = 0; t < domain.tet_count(); ++t) outer_simplices_[domain.inside_tet(t).first] = t;
  }
}

template <template <class> class Domain, class Real>
std::span<const PointSource> PathField<Domain<Real>>::take(const SourceList& sources) {
  solved_ = false;
  const std::span<const PointSource> points = points_of(Purpose::paths, sources);
  sources_.assign(points.begin(), points.end());
  if constexpr (Domain<Real>::kind == DomainKind::surface)
    if (delaunay_ != nullptr) {
      given_sources_ = sources_;
      for (PointSource& source : sources_) {
        check_source(source, described(*given_));
        source = delaunay_->to_intrinsic(source);
      }
    }
  return sources_;
}

template <template <class> class Domain, class Real>
void PathField<Domain<Real>>::took(const PropagateOptions& options, Kept kept) {
  visibility_ = options.visibility;
  kept_ = kept;
  if constexpr (std::is_same_v<Domain<Real>, TetMesh<Real>>)
    if (!cells_ && kept != Kept::windows) {
      PropagateOptions by_strings = options;
      by_strings.max_expansions = PropagateOptions{}.max_expansions;  // others are counted
      DistanceField<Real> unused;
      auto& strings = workspace_.state().strings;
      if (!strings) strings = std::make_shared<SolidStrings>();
      strings->solve(*domain_, sources_, by_strings, {}, unused);
    }
  if (cells_) cell_distance_ = cell_distances<Real>(*cells_, field_.distance);
  solved_ = true;
}

template <template <class> class Domain, class Real>
Solved<Real> PathField<Domain<Real>>::solved() const {
  const windows::KeptWindows<Real>* windows = nullptr;
  if constexpr (std::is_same_v<Domain<Real>, TriangleMesh<Real>>)
    if (kept_ == Kept::windows) windows = workspace_.state().windows.solver()->kept();
  return {workspace_.state(),
          field_,
          sources_,
          delaunay_ ? std::span<const std::array<double, 3>>() : std::span(positions_),
          {},
          outer_,
          outer_simplices_,
          visibility_,
          windows};
}

template <template <class> class Domain, class Real>
Path PathField<Domain<Real>>::trace(const PointSource& point, const TraceOptions& options) const {
  if (!solved_) throw UsageError("there is nothing to trace before a solve");
  const PointSource at = checked(point);
  check(options, *domain_);
  if (cells_) return trace_cells(cell_field(), at);
  const Solved<Real> solved = this->solved();
  const auto found = [&]() -> Path {
    if constexpr (Domain<Real>::kind == DomainKind::surface) {
      const SurfaceTrace<Real> trace(*domain_, solved);
      if (delaunay_ == nullptr) return trace.trace(at, options);
      const PulledWay way = trace.find(delaunay_->to_intrinsic(at), options);
      if (way.source == none) return {};
      std::vector<StraightPiece> lines;
      for (const StraightPiece& line : StripPaths<Real>::pieces(way))
        for (const StraightPiece& piece : laid_on(*given_, *delaunay_, *domain_, line))
          lines.push_back(piece);
      Path path = LaidPaths<Real>(*given_, positions_, given_outer())
                      .lay(lines, at, given_sources_[way.source]);
      path.source = way.source;
      path.windows = way.windows;
      path.capped = way.capped;
      return path;
    } else if constexpr (Domain<Real>::kind == DomainKind::solid) {
      return StringPaths<Real>(*domain_, solved).trace(at);
    }
    return {};  // wireframes are cells
  };
  return or_no_way_at_all(found(), solved, at);
}

// What left no labels counts as GL, which does not either. A solid has positions of its own.
template <template <class> class Domain, class Real>
Support PathField<Domain<Real>>::support_of(Purpose purpose) const {
  if (!solved_) throw UsageError("there is nothing to read before a solve");
  return support(purpose, *domain_, visibility_,
                 kept_ == Kept::nothing ? ExecutorKind::gl : ExecutorKind::serial,
                 Domain<Real>::kind == DomainKind::solid || !positions_.empty());
}

template <template <class> class Domain, class Real>
CellField PathField<Domain<Real>>::cell_field() const {
  return {*cells_, cell_distance_, given_sources(), positions_,
          Domain<Real>::kind == DomainKind::wireframe};
}

template <template <class> class Domain, class Real>
PointSource PathField<Domain<Real>>::checked(const PointSource& point) const {
  PointSource at = point;
  at.offset = 0;
  check_source(at, described(*given_));
  return at;
}

template <template <class> class Domain, class Real>
double PathField<Domain<Real>>::at(const PointSource& point, ReadOut level) const {
  return at(std::span<const PointSource>(&point, 1), level)[0];
}

template <template <class> class Domain, class Real>
std::vector<double> PathField<Domain<Real>>::at(std::span<const PointSource> points,
                                                ReadOut level) const {
  const Support supported = support_of(Purpose::read_out);
  if (level != ReadOut::linear) supported.require();
  std::vector<double> distance;
  distance.reserve(points.size());
  if (cells_) {
    for (const PointSource& point : points)
      distance.push_back(read_cells(cell_field(), checked(point), level));
    return distance;
  }
  if constexpr (Domain<Real>::kind != DomainKind::wireframe) {
    const Solved<Real> solved = this->solved();
    const ReadOutOf<Domain<Real>> read_out(*domain_, solved);
    for (const PointSource& point : points) {
      PointSource at = checked(point);
      if (at.vertex != none) {
        distance.push_back(static_cast<double>(field_.distance[at.vertex]));
        continue;
      }
      if constexpr (Domain<Real>::kind == DomainKind::surface) {
        if (level == ReadOut::linear) {
          distance.push_back(
              linear_in(*given_, given_outer(), std::span<const Real>(field_.distance), at));
          continue;
        }
        if (delaunay_ != nullptr) at = delaunay_->to_intrinsic(at);
      }
      distance.push_back(distance_in(*domain_, read_out, at, level));
    }
  }
  return distance;
}

template <template <class> class Domain, class Real>
std::vector<std::array<double, 3>> PathField<Domain<Real>>::gradient() const {
  support_of(Purpose::directions).require();
  std::vector<std::array<double, 3>> directions;
  if constexpr (std::is_same_v<Domain<Real>, TetMesh<Real>>) {
    const Solved<Real> solved = this->solved();
    const StringPaths<Real> paths(*domain_, solved);
    for (Index tet = 0; tet < domain_->tet_count(); ++tet)
      directions.push_back(paths.gradient(domain_->inside_tet(tet).first));
  }
  if constexpr (std::is_same_v<Domain<Real>, TriangleMesh<Real>>) {
    const Solved<Real> solved = this->solved();
    const SurfaceReadOut<Real> read_out(*domain_, solved);
    directions.assign(given_->face_count(), {0, 0, 0});
    for (Index face = 0; face < given_->face_count(); ++face) {
      const auto [f, from] = middle(*domain_, delaunay_, face);
      const auto to = read_out.towards(f, from);
      if (!to) continue;
      std::vector<StraightPiece> lines = {{f, from, *to}};
      if (delaunay_ != nullptr) lines = laid_on(*given_, *delaunay_, *domain_, lines[0]);
      const Index own = given_->inside_face(face).first;
      std::array<double, 3>& way = directions[face];
      for (const StraightPiece& line : lines)
        for (std::size_t i = 0; i < 3 && line.face == own; ++i) {
          const Index v = given_outer()[given_->triangles()[own].corner[i]];
          for (std::size_t k = 0; k < 3; ++k)
            way[k] += (line.from[i] - line.to[i]) * positions_[v][k];
        }
      const double length = std::hypot(way[0], way[1], way[2]);
      for (double& x : way) x = length > 0 ? x / length : 0;
    }
  }
  return directions;
}

template <template <class> class Domain, class Real>
std::vector<Index> PathField<Domain<Real>>::simplex_labels() const {
  support_of(Purpose::simplex_labels).require();
  std::vector<Index> labels;
  const auto take = [&](Index inside) {
    const bool many = sources_.size() > 1;
    labels.push_back(!workspace_.state().marks.reached(inside) ? none
                     : many                                    ? workspace_.state().source[inside]
                                                               : 0);
  };
  if constexpr (std::is_same_v<Domain<Real>, TriangleMesh<Real>>) {
    const Solved<Real> solved = this->solved();
    const WindowReadOut<Real> windows(*domain_, solved);
    for (Index face = 0; face < given_->face_count(); ++face) {
      const auto [f, at] = middle(*domain_, delaunay_, face);
      if (solved.windows)
        labels.push_back(windows.look(f, at).source);
      else
        take(f);
    }
  } else if constexpr (std::is_same_v<Domain<Real>, TetMesh<Real>>) {
    if (cells_) {
      for (Index t = 0; t < domain_->tet_count(); ++t) take(domain_->inside_tet(t).first);
    } else {
      const Solved<Real> solved = this->solved();
      const StringPaths<Real> paths(*domain_, solved);
      for (Index t = 0; t < domain_->tet_count(); ++t)
        labels.push_back(paths.source(domain_->inside_tet(t).first));
    }
  }
  return labels;
}

template <template <class> class Domain, class Real>
std::size_t PathField<Domain<Real>>::bytes() const {
  return (outer_.capacity() + outer_simplices_.capacity()) * sizeof(Index) + workspace_.bytes() +
         field_.distance.capacity() * sizeof(Real) + field_.label.capacity() * sizeof(Index) +
         sources_.capacity() * sizeof(PointSource) + (cells_ ? cells_->bytes() : 0) +
         cell_distance_.capacity() * sizeof(double);
}

template class PathField<TriangleMesh<float>>;
template class PathField<TriangleMesh<double>>;
template class PathField<TetMesh<float>>;
template class PathField<TetMesh<double>>;
template class PathField<Wireframe<float>>;
template class PathField<Wireframe<double>>;

}  // namespace plexway
