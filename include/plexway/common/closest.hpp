#pragma once

#include <array>
#include <cstddef>
#include <ranges>
#include <span>

#include <plexway/common/ids.hpp>
#include <plexway/common/rows_of.hpp>
#include <plexway/source/point_source.hpp>

namespace plexway {

namespace detail {

// What one of the three functions takes without a copy.
template <class R>
concept PlainSimplices = std::convertible_to<const R&, std::span<const std::array<Index, 2>>> ||
    std::convertible_to<const R&, std::span<const std::array<Index, 3>>> ||
    std::convertible_to<const R&, std::span<const std::array<Index, 4>>>;

}  // namespace detail

///@{
/// The point of a domain closest to a point in space, as a source: `solve(executor, mesh,
/// closest(positions, triangles, {1, 2, 3}))`. A vertex where it is that; of several the one in the
/// first simplex; of tetrahedra the point itself where it lies inside. Throws UsageError for no
/// simplices and for a point that is not finite. Cost: one pass over the simplices.
[[nodiscard]] PointSource closest(const GivenPoints& positions,
                                  std::span<const std::array<Index, 2>> edges,
                                  const std::array<double, 3>& point);
[[nodiscard]] PointSource closest(const GivenPoints& positions,
                                  std::span<const std::array<Index, 3>> triangles,
                                  const std::array<double, 3>& point);
[[nodiscard]] PointSource closest(const GivenPoints& positions,
                                  std::span<const std::array<Index, 4>> tets,
                                  const std::array<double, 3>& point);
/// The same, simplices in arrays of any kind, copied for a while; rows have 2, 3 or 4 vertices.
template <RowsOfAnyWidth Simplices>
requires(!detail::PlainSimplices<Simplices>) [[nodiscard]] PointSource
    closest(const GivenPoints& positions, const Simplices& simplices,
            const std::array<double, 3>& point) {
  std::size_t width = 3;
  if constexpr (MatrixLike<Simplices>)
    width = static_cast<std::size_t>(simplices.cols());
  else if (!std::ranges::empty(simplices))
    width = std::ranges::size(*std::ranges::begin(simplices));
  const auto with = [&]<std::size_t N>() -> PointSource {
    if constexpr (detail::is_of_other_width<Simplices, N>)
      throw UsageError("rows of simplices have 2, 3 or 4 vertices");
    else
      return closest(positions, std::span<const std::array<Index, N>>(rows_of<Index, N>(simplices)),
                     point);
  };
  if (width == 2) return with.template operator()<2>();
  if (width == 4) return with.template operator()<4>();
  return with.template operator()<3>();
}
///@}

}  // namespace plexway
