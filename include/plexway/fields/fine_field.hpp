#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <plexway/common/ids.hpp>
#include <plexway/common/rows_of.hpp>

namespace plexway {

/// The distance of a point of a face, by weights of its corners: PathField::at and the like.
using DistanceInside = std::function<double(Index face, const std::array<double, 4>& weights)>;

/// What of a field is to be linear, and how nearly.
struct FineOptions {
  double tolerance = 0;  ///< by which the field may be off midway along an edge, in its unit; > 0
  /// Only faces in which the field has one of these values, or none: all.
  std::span<const double> values = {};
  std::size_t most = std::size_t{1} << 22;  ///< faces, which may keep it from being as fine
};

/// Triangles over a surface on which a field is linear in each, nearly.
struct FineField {
  std::vector<std::array<double, 3>> positions;  ///< those given, then those of new vertices
  std::vector<double> distance;                  ///< likewise
  std::vector<std::array<Index, 3>> faces;       ///< of these
  std::vector<Index> parent;                     ///< the face given that each is a part of
  /// Where the corners of each face are in its parent: weights of the parent's, times `parts`.
  std::vector<std::array<std::array<std::uint8_t, 3>, 3>> place;
  unsigned parts = 1;  ///< into so many each edge was cut
};

/// Cuts each edge into as many parts, 1 to 16, as it takes for a smooth field to be linear between
/// them. At a crease, where shortest paths from two sides meet, 16 may be too few, and then the
/// tolerance does not hold there. Faces with a corner twice are left out.
///
/// Throws UsageError for counts that do not fit, a face of a vertex that is not there, or a
/// tolerance that is not > 0. Cost: `at` once an edge, and once a new vertex.
[[nodiscard]] FineField fine_field(const GivenPoints& positions, const GivenSimplices<3>& faces,
                                   const Given<double>& distance, const DistanceInside& at,
                                   const FineOptions& options);

}  // namespace plexway
