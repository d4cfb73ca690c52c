#pragma once

#include <array>
#include <span>

#include <plexway/common/ids.hpp>
#include <plexway/source/point_source.hpp>

namespace plexway {

///@{
/// The point of a domain closest to a point in space, as a source: `solve(executor, mesh,
/// closest(positions, triangles, {1, 2, 3}))`. A vertex where it is that; of several the one in the
/// first simplex; of tetrahedra the point itself where it lies inside. Throws UsageError for no
/// simplices and for a point that is not finite. Cost: one pass over the simplices.
[[nodiscard]] PointSource closest(std::span<const std::array<double, 3>> positions,
                                  std::span<const std::array<Index, 2>> edges,
                                  const std::array<double, 3>& point);
[[nodiscard]] PointSource closest(std::span<const std::array<double, 3>> positions,
                                  std::span<const std::array<Index, 3>> triangles,
                                  const std::array<double, 3>& point);
[[nodiscard]] PointSource closest(std::span<const std::array<double, 3>> positions,
                                  std::span<const std::array<Index, 4>> tets,
                                  const std::array<double, 3>& point);
///@}

}  // namespace plexway
