#pragma once

#include <cstddef>

#include <plexway/any_domain.hpp>
#include <plexway/mixed/mixed_complex.hpp>

namespace plexway {

/// Edges of solids around which ways bend: those with more than pi of solid around.
struct SolidBends {
  std::size_t edges = 0;
  std::size_t cracks = 0;  ///< of those, ends of cracks
};
/// Of all solids of a mixed domain; none where all pieces join to one, or strings solve it. Cost:
/// those edges, and what joins pieces.
template <class Real>
[[nodiscard]] SolidBends solid_bends(const MixedComplex<Real>& complex);
/// The same; none in other domains.
[[nodiscard]] SolidBends solid_bends(const AnyDomain& domain);

/// Where ways of a mixed domain may be refracted and bend around a solid's edges besides.
struct BentCrossings {
  std::size_t hinges = 0;  ///< faces and edges where refracted ways enter or leave such solids
  std::size_t edges = 0;   ///< of these solids, with more than pi of solid around
  std::size_t cracks = 0;  ///< of those, ends of cracks
};

/// Those of all solids with such edges that share faces with a solid of another speed, or faces or
/// edges with a surface that measures them otherwise. A way over such a hinge and around such an
/// edge is not always the shortest (docs/contributing/methods/mixed.md). None where strings solve.
/// Cost: a look at each hinge.
template <class Real>
[[nodiscard]] BentCrossings bent_crossings(const MixedComplex<Real>& complex);

}  // namespace plexway
