#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <plexway/source/point_source.hpp>

#include "executors/parts/part_pieces.hpp"
#include "labels/straight_lines.hpp"

namespace plexway::detail {

/// Where the sources of a solve are in the pieces of this process.
struct PartSources {
  /// Those in one piece, by its numbers: at its own vertices, and in its own triangles and ghosts.
  struct Here {
    std::vector<PointSource> points;
    std::vector<Index> numbers;  ///< among all

    /// The same by numbers.
    [[nodiscard]] Here ascending() const;
  };
  /// Where a source lies: so many units from the origin of some piece. Infinitely far at a vertex
  /// of no triangle.
  struct Site {
    std::array<double, 3> at, origin;
  };
  std::span<const PointSource> all;  ///< by the surface's numbers
  std::vector<Here> here;            ///< of each of our pieces
  std::vector<Site> sites;           ///< of each source

  /// As vertices of a piece see them.
  template <class Real>
  [[nodiscard]] std::vector<SourcePlace> places(const PartPiece<Real>& part, double unit) const {
    std::vector<SourcePlace> found(all.size());
    for (std::size_t n = 0; n < found.size(); ++n) {
      found[n].sigma = all[n].offset / unit;
      for (std::size_t d = 0; d < 3; ++d)
        found[n].at[d] = sites[n].at[d] + (sites[n].origin[d] - part.origin[d]) / unit;
    }
    return found;
  }
};

/// All processes call it, with the same sources, which are checked.
template <class Real>
[[nodiscard]] PartSources part_sources(PieceRanks* ranks, const PartPieces<Real>& pieces,
                                       std::span<const PointSource> sources);

/// As SurfaceParts::nearest.
template <class Real>
[[nodiscard]] PartPoint nearest_on(const Team& team, const PartPieces<Real>& pieces,
                                   const std::array<double, 3>& point);

}  // namespace plexway::detail
