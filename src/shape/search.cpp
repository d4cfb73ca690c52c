#include <plexway/shape/search.hpp>

#include <type_traits>

#include <plexway/shape/complex.hpp>
#include <plexway/shape/support.hpp>

#include "shape/inside.hpp"

namespace plexway {

SearchResult find_paths(const AnyDomain& domain, std::span<const PointSource> sources,
                        std::span<const PointSource> targets, const SearchOptions& options) {
  support(Purpose::astar, domain.kind()).require();
  const AnyShape& shape = domain.shape();
  const OpenSimplices* const open = domain.open_simplices();
  const Inside from(open, sources), to(open, targets);
  // Under a metric a straight line in space is no lower bound.
  const bool straight = domain.lengths() == nullptr && !shape.positions().empty();
  SearchResult found;
  const auto search = [&]<class Real>(const TriangleMesh<Real>& mesh) {
    PathSearch<Real> within =
        straight ? PathSearch<Real>(mesh, shape.positions()) : PathSearch<Real>(mesh);
    found = within.find(Serial{}, from.list().points(), to.list().points(), options);
  };
  with_complex(domain, [&](const auto& complex) {
    if constexpr (std::decay_t<decltype(complex)>::kind == DomainKind::surface) search(complex);
  });
  for (Path& path : found.paths) {
    if (open != nullptr) open->outside(path);
    if (!path.positions.empty() || shape.positions().empty()) continue;
    for (const PathPoint& at : path.points)  // the search knew none
      path.positions.push_back(
          shape.position({.simplex = at.simplex, .barycentric = at.barycentric}));
  }
  return found;
}

}  // namespace plexway
