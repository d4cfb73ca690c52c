#pragma once

#include <cstddef>

#include <plexway/any_domain.hpp>

namespace plexway {

/// Edges of solids around which ways bend: those with more than pi of solid around.
struct SolidBends {
  std::size_t edges = 0;
  std::size_t cracks = 0;  ///< of those, ends of cracks
};
/// Of all solids of a mixed domain; none in others, nor where all pieces join to one, or strings
/// solve it. Cost: those
/// edges, and what joins pieces.
[[nodiscard]] SolidBends solid_bends(const AnyDomain& domain);

/// Where ways of a mixed domain may be refracted and bend around a solid's edges besides.
struct BentCrossings {
  std::size_t hinges = 0;  ///< faces and edges where refracted ways enter or leave such solids
  std::size_t edges = 0;   ///< of these solids, with more than pi of solid around
  std::size_t cracks = 0;  ///< of those, ends of cracks
};

/// Those of all solids with such edges that share faces with a solid of another speed, or faces or
/// edges with a surface that measures them otherwise. A way over such a hinge and around such an
/// edge is not always the shortest (docs/contributing/methods/mixed.md). None in a domain that is
/// not mixed, or that strings solve. Cost: a look at each hinge.
[[nodiscard]] BentCrossings bent_crossings(const AnyDomain& domain);

}  // namespace plexway
