#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include <plexway/common/rows_of.hpp>
#include <plexway/mixed/mixed_complex.hpp>
#include <plexway/paths/path_field.hpp>
#include <plexway/solve.hpp>
#include <plexway/solve/workspace.hpp>
#include <plexway/source/source_list.hpp>

namespace plexway {

namespace detail {
class Cells;
class MediaPaths;
}  // namespace detail

/// A distance field on a mixed domain that traces paths: through pieces of any dimension and
/// over their welds, refracted where two pieces measure a hinge differently.
///
/// @code
///   PathField field(mixed, positions);
///   field.solve(Serial{}, 0);
///   Path path = field.trace(17);
///
/// @endcode
/// Simplices of a path are the domain's numbers, of all pieces. The domain is referred
/// to, must outlive it and must not change; positions too, unless they would be gone after the line
/// (Given).
template <class Real>
class PathField<MixedComplex<Real>> {
 public:
  /// `positions`, one a vertex of the domain, are where paths are drawn; lengths are those of the
  /// pieces. Throws UsageError for another count. Cost: linear; where paths are searched for 36
  /// bytes a tetrahedron.
  explicit PathField(const MixedComplex<Real>& domain, GivenPoints positions = {});
  /// The domain would be gone after this line.
  explicit PathField(const MixedComplex<Real>&& domain, GivenPoints positions = {}) = delete;
  /// Moved; what is left may only be destroyed or assigned to.
  PathField(PathField&&) noexcept;
  /// Likewise.
  PathField& operator=(PathField&&) noexcept;
  ~PathField();

  /// The distance of every vertex from the nearest of `sources`, points only. Throws and costs
  /// as `solve`.
  template <class Executor>
  const DistanceField<Real>& solve(Executor executor, const SourceList& sources,
                                   const PropagateOptions& options = {}) {
    const std::span<const PointSource> points = points_of(Purpose::paths, sources);
    plexway::solve(executor, *domain_, points, options, workspace_, field_);
    took(points);
    return field_;
  }

  /// Distances from the same sources found elsewhere, one a vertex of the domain. Where strings
  /// solve the domain they are solved anew, for paths alone.
  void adopt(DistanceField<Real> found, const SourceList& sources);

  /// The field of the last solve.
  [[nodiscard]] const DistanceField<Real>& distances() const { return field_; }

  /// The path from a point back to its nearest source: no small change makes it shorter. It crosses
  /// a hinge between two speeds where Fermat says, and runs along a fast sheet or wire where that
  /// pays.
  ///
  /// Where strings solve the domain it is the string to the point, as long as the distance: all
  /// pieces lie in one space, with a solid among them and no sheet of many facets, and they are not
  /// solids that join to one of one speed. Elsewhere it is searched for by the
  /// distances of vertices; where it is more than 5e-4 longer than the distance, or inside a
  /// simplex than a path by one of its corners, three times, each time more finely. Throws
  /// UsageError for a point that is not in the domain, or before a solve. Any number of threads may
  /// trace at once. Cost: by strings that of a vertex of a solve, and some microseconds a simplex;
  /// by search some milliseconds for a hundred.
  [[nodiscard]] Path trace(const PointSource& point, const TraceOptions& options = {}) const;
  /// From a vertex.
  [[nodiscard]] Path trace(Index vertex, const TraceOptions& options = {}) const {
    return trace(PointSource::at(vertex), options);
  }

  /// The distance of any point of the domain, in its unit; its offset does not count. `linear` by
  /// the distances of its simplex's corners, other levels by the length of its path. +inf where
  /// none leads. Throws and costs as `trace`.
  [[nodiscard]] double at(const PointSource& point, ReadOut level = ReadOut::neighbours) const;

  /// Bytes held, without those of the domain and the positions.
  [[nodiscard]] std::size_t bytes() const;

 private:
  void took(std::span<const PointSource> sources);
  [[nodiscard]] PointSource checked(const PointSource& point) const;

  const MixedComplex<Real>* domain_;
  GivenPoints positions_;
  std::unique_ptr<const detail::Cells> cells_;  // where strings do not go
  std::vector<double> distance_;                // by the numbers of cells_
  Workspace<Real> workspace_;
  DistanceField<Real> field_;
  std::vector<PointSource> sources_;
  std::unique_ptr<const detail::MediaPaths> paths_;  // by strings
  bool solved_ = false;
};

extern template class PathField<MixedComplex<float>>;
extern template class PathField<MixedComplex<double>>;

}  // namespace plexway
