#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <type_traits>
#include <vector>

#include <plexway/common/rows_of.hpp>
#include <plexway/fields/read_out.hpp>
#include <plexway/paths/path.hpp>
#include <plexway/solid/tet_mesh.hpp>
#include <plexway/solve.hpp>
#include <plexway/solve/distance_field.hpp>
#include <plexway/solve/options.hpp>
#include <plexway/solve/workspace.hpp>
#include <plexway/source/point_source.hpp>
#include <plexway/source/source_list.hpp>
#include <plexway/surface/intrinsic_delaunay.hpp>
#include <plexway/surface/triangle_mesh.hpp>
#include <plexway/wireframe/wireframe.hpp>

namespace plexway {

namespace detail {
class Cells;
struct CellField;
template <class Real>
struct Solved;
}  // namespace detail

/// A distance field that traces paths: what a solve learned, and the domain it holds on.
///
/// @code
///   PathField field(mesh, positions);
///   field.solve(Serial{}, 0);
///   Path path = field.trace(17);
///
/// @endcode
/// Domain: TriangleMesh, TetMesh or Wireframe. The domain is referred to and must outlive it, and
/// so are positions, unless they would be gone after the line (Given).
template <class Domain>
class PathField {
  static_assert(support(Purpose::paths, Domain::kind),
                "paths are traced on surfaces, solids, wireframes, clouds and mixed domains: make "
                "a complex of simplices of dimension 1 to 3 one of these");

 public:
  /// Does not compile, either.
  template <class... Rest>
  explicit PathField(const Domain&, const Rest&...) {}
};

/// On a surface, a solid or a wireframe.
template <template <class> class Domain, class Real>
class PathField<Domain<Real>> {
 public:
  /// `positions`, one a vertex in the caller's order and unit, are those the domain was made from.
  /// With them paths have coordinates, and all lengths are taken from them in double. Throws
  /// UsageError for another count. Cost: linear; 4 bytes a vertex, and a tetrahedron, and 40 an
  /// edge of a wireframe; 50 a triangle of a surface with refracting edges, 60 a tetrahedron
  /// without coordinates.
  explicit PathField(const Domain<Real>& domain, GivenPoints positions = {});
  /// The domain would be gone after this line.
  explicit PathField(const Domain<Real>&& domain, GivenPoints positions = {}) = delete;

  /// On the intrinsic Delaunay triangulation of a surface, `domain`, which is delaunay.mesh(): all
  /// points, positions and paths are those of the input. A path is found where it was solved, and
  /// laid on the input's triangles; its length is that there. Refers to all of them.
  PathField(const Domain<Real>& domain, const IntrinsicDelaunay& delaunay,
            const Domain<Real>& input,
            GivenPoints positions = {}) requires(Domain<Real>::kind == DomainKind::surface);
  ///@{
  /// One of them would be gone after this line.
  PathField(const Domain<Real>&&, const IntrinsicDelaunay&, const Domain<Real>&,
            GivenPoints = {}) = delete;
  PathField(const Domain<Real>&, const IntrinsicDelaunay&&, const Domain<Real>&,
            GivenPoints = {}) = delete;
  PathField(const Domain<Real>&, const IntrinsicDelaunay&, const Domain<Real>&&,
            GivenPoints = {}) = delete;
  ///@}

  /// The distance of every vertex from the nearest of `sources`, points and vertices only. Throws
  /// and costs as plexway::solve. Paths can be traced after an executor that leaves no labels as
  /// well, by the vertices' distances alone; in solids in space strings are then solved for them.
  template <class Executor>
  const DistanceField<Real>& solve(Executor executor, const SourceList& sources,
                                   const PropagateOptions& options = {}) {
    const std::span<const PointSource> there = take(sources);
    constexpr bool keeps = std::is_same_v<WorkspaceOf<Executor, Domain<Real>>, Workspace<Real>>;
    if constexpr (keeps) {
      workspace_.keep_windows(true);
      plexway::solve(executor, *domain_, there, options, workspace_, field_);
    } else {
      field_ = plexway::solve(executor, *domain_, there, options);
    }
    const bool fast = field_.accuracy == Accuracy::fast();
    took(options, !keeps ? Kept::nothing : fast ? Kept::labels : Kept::windows);
    return field_;
  }

  /// The field of the last solve. Vertices that a refinement put in come last.
  [[nodiscard]] const DistanceField<Real>& distances() const { return field_; }

  /// The path from a point (its offset does not count) back to its nearest source: the shortest
  /// among those nearby, so that any small change makes it longer. Where none exists, an empty
  /// path of infinite length.
  ///
  /// On surfaces it is straight over every edge and bends only at vertices with at least pi of
  /// surface on both sides. After windows (Accuracy) it is the one that they lead, as long as the
  /// distance: after Accuracy::exact() to rounding, else to what that is off. After labels it is at
  /// most 1 % longer than the shortest path along edges, and mostly the shortest of all
  /// (TraceOptions, whose margin is refused elsewhere). On surfaces with refracting
  /// edges it is refracted, as on mixed domains (mixed_path_field.hpp). In solids it is the string
  /// to the point, as long as the distance by strings. Solids without coordinates are as if
  /// refracting: each tetrahedron is flat in its own lengths.
  ///
  /// Throws UsageError for a point that is not in the domain, or before a solve. Any number of
  /// threads may trace at once. Cost: about that of looking at each simplex on the way some ten
  /// times, and on surfaces of the windows.
  [[nodiscard]] Path trace(const PointSource& point, const TraceOptions& options = {}) const;
  /// From a vertex.
  [[nodiscard]] Path trace(Index vertex, const TraceOptions& options = {}) const {
    return trace(PointSource::at(vertex), options);
  }

  /// The distance of any point of the domain, in its unit; its offset does not count. +inf where no
  /// path leads. `linear` needs the vertices' distances only; the other levels ask the virtual
  /// sources that Visibility::saddles or windows left, with Serial and OpenMP. In solids they are
  /// the length of the string to the point, after any solve; along the edges of
  /// wireframes all levels but `linear` are exact. A solve's radius bounds the distances of
  /// vertices, so `linear`; the labels that other levels ask go on by about a simplex. After
  /// windows (Accuracy) all levels but `linear` ask those, and are as accurate as they are: exact
  /// after Accuracy::exact(). On surfaces with refracting edges and in solids by
  /// intrinsic lengths they are the lengths of paths.
  ///
  /// Across an edge `neighbours` and `star` are continuous where the labels on both sides are all
  /// that is asked; docs/how-to/read-out.md has what jumps. Throws UsageError for a
  /// point that is not in the domain, before a solve, and without such labels.
  /// Any number of threads may ask at once. Cost: on surfaces 1, 1, 4 and at most 31 labels looked
  /// at, in solids that of a vertex of a solve.
  [[nodiscard]] double at(const PointSource& point, ReadOut level = ReadOut::neighbours) const;
  /// By a simplex and one coordinate a corner.
  template <std::size_t N>
  [[nodiscard]] double at(Index simplex, const double (&barycentric)[N],
                          ReadOut level = ReadOut::neighbours) const {
    return at(PointSource::in(simplex, barycentric), level);
  }
  /// Of many points.
  [[nodiscard]] std::vector<double> at(std::span<const PointSource> points,
                                       ReadOut level = ReadOut::neighbours) const;
  /// The direction away from the source at the centre of each triangle or tetrahedron, caller's
  /// order: of length 1, in the triangle's plane; 0 where unreachable, or the source is there.
  /// Needs labels as `at`, and on surfaces positions. UsageError for wireframes.
  [[nodiscard]] std::vector<std::array<double, 3>> gradient() const;

  /// The source that the label of each simplex leads to, caller's order: the nearest to its centre,
  /// by its place in the list; none where unreachable. Surfaces and solids; throws as `at`, but
  /// any policy will do.
  [[nodiscard]] std::vector<Index> simplex_labels() const;

  /// Bytes held, without those of the domain and the positions.
  [[nodiscard]] std::size_t bytes() const;

  /// The domain that it refers to.
  [[nodiscard]] const Domain<Real>& domain() const { return *domain_; }

 private:
  PathField(const Domain<Real>& domain, const IntrinsicDelaunay* delaunay,
            const Domain<Real>& given, GivenPoints positions);
  [[nodiscard]] Support support_of(Purpose purpose) const;
  /// The field as the workspace has it.
  enum class Kept { nothing, labels, windows };  // in solids strings
  /// Where they are in the domain.
  std::span<const PointSource> take(const SourceList& sources);
  void took(const PropagateOptions& options, Kept kept);
  [[nodiscard]] PointSource checked(const PointSource& point) const;
  [[nodiscard]] std::span<const PointSource> given_sources() const {
    return delaunay_ ? given_sources_ : sources_;
  }
  [[nodiscard]] std::span<const Index> given_outer() const {
    return delaunay_ ? given_outer_ : outer_;
  }
  [[nodiscard]] detail::Solved<Real> solved() const;
  [[nodiscard]] detail::CellField cell_field() const;

  const Domain<Real>* domain_;         // that fields are solved on
  const Domain<Real>* given_;          // that points are in: mostly the same
  const IntrinsicDelaunay* delaunay_;  // from the one to the other
  GivenPoints positions_;
  std::vector<Index> outer_;            // from vertices inside to the caller's
  std::vector<Index> given_outer_;      // the same of `given_`, where that is another
  std::vector<Index> outer_simplices_;  // of tetrahedra inside
  Workspace<Real> workspace_;
  DistanceField<Real> field_;
  std::vector<PointSource> sources_;        // in the domain
  std::vector<PointSource> given_sources_;  // as they were given, where that is another
  Visibility visibility_ = Visibility::saddles;
  bool solved_ = false;
  Kept kept_ = Kept::nothing;
  // Where paths are refracted, in solids of intrinsic lengths, and along wires.
  std::shared_ptr<const detail::Cells> cells_;
  std::vector<double> cell_distance_;
};

/// The domain says which it is.
template <template <class> class Domain, class Real>
PathField(const Domain<Real>&) -> PathField<Domain<Real>>;
/// Likewise, with positions.
template <template <class> class Domain, class Real, class Positions>
PathField(const Domain<Real>&, const Positions&) -> PathField<Domain<Real>>;
/// Likewise.
template <class Real>
PathField(const TriangleMesh<Real>&, const IntrinsicDelaunay&, const TriangleMesh<Real>&,
          const GivenPoints&) -> PathField<TriangleMesh<Real>>;

extern template class PathField<TriangleMesh<float>>;
extern template class PathField<TriangleMesh<double>>;
extern template class PathField<TetMesh<float>>;
extern template class PathField<TetMesh<double>>;
extern template class PathField<Wireframe<float>>;
extern template class PathField<Wireframe<double>>;

}  // namespace plexway
