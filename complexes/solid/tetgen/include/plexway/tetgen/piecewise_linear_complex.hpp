#pragma once

#include <array>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

#include <plexway/common/ids.hpp>

namespace plexway::tetgen {

/// The boundary of a solid as TetGen's `.poly` files have it: flat facets of polygons.
struct PiecewiseLinearComplex {
  /// A flat piece of boundary or of an inner wall.
  struct Facet {
    /// Corners in order; a polygon of two is an edge in the facet, of one a point.
    std::vector<std::vector<Index>> polygons;
    std::vector<std::array<double, 3>> holes;  ///< points in parts that are not there
  };
  /// The part of space around a point, up to the next facets.
  struct Region {
    /// Anywhere inside of it.
    std::array<double, 3> point;
    double attribute = 0;   ///< what Solid::regions says of its tetrahedra
    double max_volume = 0;  ///< of them; 0 for no bound
  };

  /// n, in any unit; some may be of no facet.
  std::vector<std::array<double, 3>> positions;
  /// Of vertices < n.
  std::vector<Facet> facets;
  std::vector<std::array<double, 3>> holes;  ///< points in parts of space that stay empty
  /// May be none.
  std::vector<Region> regions;
};

/// Reads TetGen's `.poly` or `.smesh`. Points count from 0 or 1, as the file's first one does;
/// where the file says 0 points, they are in the `.node` file of the same name.
///
/// Throws InputError "FILE:LINE: cause" or "FILE: cause" for what is missing, malformed, not finite
/// or out of range, and for an extension that is neither.
[[nodiscard]] PiecewiseLinearComplex read_poly(const std::filesystem::path& file);

/// The extensions that `read_poly` knows, with the dot, in lower case.
[[nodiscard]] std::span<const std::string_view> poly_extensions();

}  // namespace plexway::tetgen
