#pragma once

#include <array>
#include <cstddef>
#include <ranges>
#include <span>

#include <plexway/common/ids.hpp>
#include <plexway/common/rows_of.hpp>
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
/// The same, points and simplices in arrays of any kind (rows_of), copied for a while; rows of
/// simplices have 2, 3 or 4 vertices.
template <RowsOfNumbers Points, RowsOfAnyWidth Simplices>
requires(OtherRows<Points, Simplices, 2>&& OtherRows<Points, Simplices, 3>&&
             OtherRows<Points, Simplices, 4>) [[nodiscard]] PointSource
    closest(const Points& positions, const Simplices& simplices,
            const std::array<double, 3>& point) {
  const auto at = rows_of<double, 3>(positions);
  std::size_t width = 3;
  if constexpr (MatrixLike<Simplices>)
    width = static_cast<std::size_t>(simplices.cols());
  else if (!std::ranges::empty(simplices))
    width = std::ranges::size(*std::ranges::begin(simplices));
  const auto with = [&]<std::size_t N>() -> PointSource {
    if constexpr (detail::is_of_other_width<Simplices, N>)
      throw UsageError("rows of simplices have 2, 3 or 4 vertices");
    else
      return closest(std::span<const std::array<double, 3>>(at),
                     std::span<const std::array<Index, N>>(rows_of<Index, N>(simplices)), point);
  };
  if (width == 2) return with.template operator()<2>();
  if (width == 4) return with.template operator()<4>();
  return with.template operator()<3>();
}
///@}

}  // namespace plexway
