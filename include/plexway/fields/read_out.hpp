#pragma once

namespace plexway {

/// Who is asked for the distance of a point inside a simplex. Each level asks those before it, too,
/// but `linear`.
enum class ReadOut {
  linear,      ///< the distances of the corners, interpolated
  simplex,     ///< the simplex's own virtual source
  neighbours,  ///< also those of simplices beyond its facets, unfolded, and the corners
  star,        ///< also those of all simplices around its corners
};

}  // namespace plexway
