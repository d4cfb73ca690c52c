#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

#include <plexway/solid/tet_mesh.hpp>
#include <plexway/solve/distance_field.hpp>
#include <plexway/solve/options.hpp>
#include <plexway/source/point_source.hpp>

#include "strings/solver.hpp"

/// Solids by strings (src/strings): between the library's sources, options and fields, and theirs.
namespace plexway::detail {

/// A point of a tetrahedron; inside.
template <class Real>
strings::Inside inside_of(const TetMesh<Real>& mesh, const strings::MediaSpace& space, Index tet,
                          const strings::Point& at);
/// A vertex as a source; inside.
strings::Source source_at(const strings::MediaSpace& space, Index vertex, double offset);
/// A point of a tetrahedron by one coordinate a corner; `inside` is what it keeps of that.
template <class Real>
strings::Source source_in(const TetMesh<Real>& mesh, const strings::MediaSpace& space, Index tet,
                          const std::array<double, 4>& weight, double offset,
                          strings::Inside& inside);
/// One in the caller's numbers.
template <class Real>
strings::Source source_of(const TetMesh<Real>& mesh, const strings::MediaSpace& space,
                          const PointSource& given, strings::Inside& inside);
/// A solid as one medium, which it keeps.
template <class Real>
std::shared_ptr<const strings::MediaSpace> space_of(const TetMesh<Real>& mesh);

/// What a solve by strings leaves; its memory is used again by the next one.
class SolidStrings {
 public:
  /// The shortest path to a point; its bends and both ends, from the source on, in the solid's
  /// frame inside (TetMesh::points). No points where no path leads.
  struct Found {
    double distance;  ///< in the solid's unit
    Index source;
    std::vector<strings::Point> points;
  };

  /// The same bits for any number of threads.
  template <class Real>
  void solve(const TetMesh<Real>& mesh, std::span<const PointSource> sources,
             const PropagateOptions& options, const strings::Threads& threads,
             DistanceField<Real>& field);

  /// To a vertex, or a point of a tetrahedron by one coordinate a corner, inside. Any number of
  /// threads may ask, one after the other.
  [[nodiscard]] Found at(Index vertex) const;
  template <class Real>
  [[nodiscard]] Found at(const TetMesh<Real>& mesh, Index tet,
                         const std::array<double, 4>& weight) const;

  [[nodiscard]] std::size_t bytes() const;

 private:
  [[nodiscard]] Found found(Index vertex) const;

  std::uint64_t identity_ = 0;  // of the solid below
  double unit_ = 1;
  std::shared_ptr<const strings::MediaSpace> space_;  // the solid's
  std::unique_ptr<strings::Solver> solver_;
  mutable std::mutex asked_;
  std::vector<strings::Source> sources_;         // of a solve; kept for its memory
  std::vector<strings::Inside> tets_;            // likewise, of sources inside
  std::vector<std::pair<Index, Index>> inside_;  // tetrahedra with sources inside, and these
};

}  // namespace plexway::detail
