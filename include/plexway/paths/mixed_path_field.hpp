#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include <plexway/mixed/mixed_complex.hpp>
#include <plexway/paths/path_field.hpp>
#include <plexway/solve.hpp>

namespace plexway {

class Cells;

/// A distance field on a mixed domain that can tell the way: through pieces of any dimension and
/// over their welds, refracted where two pieces measure a hinge differently.
///
/// @code
///   PathField field(mixed, positions);
///   field.solve(Serial{}, PointSource::at(0));
///   Path path = field.trace(17);
///
/// @endcode
/// Simplices of a path are the domain's numbers, of all pieces. The domain and the positions are
/// referred to and must outlive it; the domain must not change.
template <class Real>
class PathField<MixedComplex<Real>> {
 public:
  /// `positions`, one a vertex of the domain, are where paths are drawn; lengths are those of the
  /// pieces. Throws UsageError for another count. Cost: linear; 36 bytes a tetrahedron.
  explicit PathField(const MixedComplex<Real>& domain,
                     std::span<const std::array<double, 3>> positions = {});
  /// Moved; what is left may only be destroyed or assigned to.
  PathField(PathField&&) noexcept;
  /// Likewise.
  PathField& operator=(PathField&&) noexcept;
  ~PathField();

  /// The distance of every vertex from the nearest of `sources`. Throws and costs as `solve`.
  template <class Executor>
  const DistanceField<Real>& solve(Executor executor, std::span<const PointSource> sources,
                                   const PropagateOptions& options = {}) {
    adopt(plexway::solve(executor, *domain_, sources, options), sources);
    return field_;
  }
  /// From one source.
  template <class Executor>
  const DistanceField<Real>& solve(Executor executor, const PointSource& source,
                                   const PropagateOptions& options = {}) {
    return solve(executor, std::span<const PointSource>(&source, 1), options);
  }

  /// Distances from the same sources found elsewhere, one a vertex of the domain.
  void adopt(DistanceField<Real> found, std::span<const PointSource> sources);

  /// What the last solve found.
  [[nodiscard]] const DistanceField<Real>& distances() const { return field_; }

  /// The way from a point back to its nearest source: no small change makes it shorter. It crosses
  /// a hinge between two speeds where Fermat says, runs along a fast sheet where that pays, and
  /// meets wires at their vertices only, as distances do. Where it is more than 5e-4 longer than
  /// the distance, or inside a simplex than a way by one of its corners, it was looked for three
  /// times, each time more finely. Throws UsageError for a point that is not in the domain, or
  /// before a solve. Any number of threads may trace at once.
  /// Cost: see search_cells; some milliseconds for a hundred cells.
  [[nodiscard]] Path trace(const PointSource& point, const TraceOptions& options = {}) const;
  /// From a vertex.
  [[nodiscard]] Path trace(Index vertex, const TraceOptions& options = {}) const {
    return trace(PointSource::at(vertex), options);
  }

  /// The distance of any point of the domain, in its unit; its offset does not count. `linear` by
  /// the distances of its simplex's corners, other levels by its path. +inf where none leads.
  /// Throws and costs as `trace`.
  [[nodiscard]] double at(const PointSource& point, ReadOut level = ReadOut::neighbours) const;

  /// Bytes held, without those of the domain and the positions.
  [[nodiscard]] std::size_t bytes() const;

 private:
  [[nodiscard]] PointSource checked(const PointSource& point) const;

  const MixedComplex<Real>* domain_;
  std::span<const std::array<double, 3>> positions_;
  std::unique_ptr<const Cells> cells_;
  std::vector<double> distance_;  // by the numbers of cells_
  DistanceField<Real> field_;
  std::vector<PointSource> sources_;
  bool solved_ = false;
};

extern template class PathField<MixedComplex<float>>;
extern template class PathField<MixedComplex<double>>;

}  // namespace plexway
