#pragma once

namespace plexway {

/// What the distance of a point inside a simplex is computed from. Each level takes the least of
/// its own values and those of the levels before it, but `linear`.
enum class ReadOut {
  linear,      ///< the distances of the corners, interpolated
  simplex,     ///< the simplex's own virtual source
  neighbours,  ///< also those of simplices beyond its facets, unfolded, and the corners
  star,        ///< also those of all simplices around its corners
};

}  // namespace plexway
