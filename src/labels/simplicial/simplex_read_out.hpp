#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include <plexway/source/point_source.hpp>

#include "labels/front.hpp"
#include "labels/simplicial/simplex_cells.hpp"
#include "labels/straight_lines.hpp"
#include "labels/workspace_state.hpp"

/// From labels in simplices to distances at vertices.
namespace plexway::detail {

/// Vertices whose neighbours must be looked at again, in the room of a front that has run empty. If
/// that should not be enough, some are lost, and it says so.
class ChangedVertices {
 public:
  explicit ChangedVertices(FrontStorage& storage)
      : list_(storage.near.get()), capacity_(storage.capacity) {}

  void clear() { count_ = 0, lost_ = false; }
  void push(Index vertex) {
    if (count_ < capacity_)
      list_[count_++] = vertex;
    else
      lost_ = true;
  }
  bool pop(Index& vertex) {
    if (count_ == 0) return false;
    vertex = list_[--count_];
    return true;
  }
  [[nodiscard]] bool lost() const { return lost_; }

 private:
  Index* list_;
  std::size_t capacity_, count_ = 0;
  bool lost_ = false;
};

/// The least that the simplices at a vertex offer; then the sources and the corners of simplices
/// they lie in, exactly.
template <class Domain, class Rule, class Front, class Real>
void read_out_simplices(const Domain& domain, std::span<const PointSource> sources,
                        const Rule& rule, const Front& front, WorkspaceState<Real>& workspace) {
  workspace.vertex.assign(domain.vertex_count(), std::numeric_limits<Real>::infinity());
  workspace.vertex_source.assign(domain.vertex_count(), none);
  for (Index s = 0; s < rule.cells().count(); ++s) {
    if (!front.reached(s)) continue;
    for (Index i = 0; i <= Rule::N; ++i) {
      const Index v = rule.cells().vertex_of(s, i);
      const Real d = rule.corner_distance(s, i);
      if (!(d < workspace.vertex[v])) continue;
      workspace.vertex[v] = d;
      workspace.vertex_source[v] = front.source(s);
    }
  }
  for (std::size_t n = sources.size(); n-- > 0;)
    offer_corners(domain, sources[n], [&](Index v, double d) {
      const Real distance = static_cast<Real>(d);
      if (distance > workspace.vertex[v]) return;
      workspace.vertex[v] = distance;
      workspace.vertex_source[v] = static_cast<Index>(n);
    });
}

/// No vertex is farther than a neighbour and the edge between: where one came out so, it is given
/// that way, and what lies behind it. Cost: one look at all edges.
template <class Domain, class Real>
void relax_edges(const Domain& domain, WorkspaceState<Real>& workspace) {
  using Cells = SimplexCells<Domain>;
  constexpr Index sides = Cells::N + 1;
  const Cells cells(domain);
  Real* const d = workspace.vertex.data();
  ChangedVertices changed(workspace.front);
  const auto relax = [&](Index s, Index i, Index j) {
    // Most need no change, and whichever end is nearer: that cannot be predicted.
    Index v = cells.vertex_of(s, i), w = cells.vertex_of(s, j);
    const Real length2 = cells.squared_edge(s, j * (j - 1) / 2 + i);
    const Real rise = d[w] - d[v];
    if (rise * rise <= length2) [[likely]]
      return;
    if (d[w] < d[v]) std::swap(v, w);
    // A search that ends early does not go on here.
    if (!(d[w] < std::numeric_limits<Real>::infinity())) return;
    const Real by = d[v] + std::sqrt(length2);
    if (!(by < d[w])) return;
    d[w] = by;
    workspace.vertex_source[w] = workspace.vertex_source[v];
    changed.push(w);
  };
  do {
    changed.clear();
    for (Index s = 0; s < cells.count(); ++s)
      for (Index j = 1; j < sides; ++j)
        for (Index i = 0; i < j; ++i) relax(s, i, j);
    for (Index v = 0; changed.pop(v);)
      for (const Index c : domain.corners_at(v))
        for (Index j = 0; j < sides; ++j)
          if (j != c % sides) relax(c / sides, std::min(j, c % sides), std::max(j, c % sides));
  } while (changed.lost());
}

/// No path is shorter than the straight line between its ends, whatever the complex does in
/// between. Where two simplices lie on one side of the facet that they share, a source unfolded
/// over it is a mirror image, and the plain step, which judges a line of sight by centres, may
/// measure to it past the facet: such a distance can only be wrong, and gets the line's length,
/// which is nearer to the truth. Returns how many were below it by more than `much_nearer`. Cost:
/// the coordinates of all vertices, times all sources.
template <class Domain, class Real>
std::size_t raise_to_lines(const Domain& domain, std::span<const PointSource> sources,
                           WorkspaceState<Real>& workspace) {
  const std::size_t axes = domain.coordinates(0).size();
  if (axes == 0) return 0;
  const SimplexCells<Domain> cells(domain);
  std::vector<double> from(axes * sources.size(), 0);
  for (std::size_t n = 0; n < sources.size(); ++n) {
    const auto add = [&](Index v, double weight) {
      for (std::size_t d = 0; d < axes; ++d)
        from[axes * n + d] += weight * domain.coordinates(v)[d];
    };
    if (sources[n].vertex != none) {
      add(domain.inside_vertex(sources[n].vertex), 1);
      continue;
    }
    const auto [s, b] = cells.inside(domain, sources[n]);
    for (std::size_t i = 0; i < b.size(); ++i) add(cells.vertex_of(s, static_cast<Index>(i)), b[i]);
  }
  const auto line = [&](std::span<const double> to, std::size_t n) {
    double sum = 0;
    for (std::size_t d = 0; d < axes; ++d)
      sum += (to[d] - from[axes * n + d]) * (to[d] - from[axes * n + d]);
    return sources[n].offset / domain.unit() + std::sqrt(sum);
  };
  // By more than rounding.
  constexpr double slack = 1 - 64 * static_cast<double>(std::numeric_limits<Real>::epsilon());
  std::size_t raised = 0;
  for (std::size_t v = 0; v < workspace.vertex.size(); ++v) {
    Real& d = workspace.vertex[v];
    if (!(d < std::numeric_limits<Real>::infinity())) continue;
    const auto to = domain.coordinates(static_cast<Index>(v));
    // Most are above that of their own source.
    const Index own = workspace.vertex_source[v];
    double least = own == none ? std::numeric_limits<double>::infinity() : line(to, own);
    for (std::size_t n = 0; n < sources.size() && static_cast<double>(d) < slack * least; ++n)
      least = std::min(least, line(to, n));
    if (!(static_cast<double>(d) < slack * least)) continue;
    raised += static_cast<double>(d) < least * (1 - much_nearer);
    d = static_cast<Real>(least);
  }
  return raised;
}

}  // namespace plexway::detail
