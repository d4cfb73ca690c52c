// The way back over the windows that a solve kept.

#include <limits>
#include <utility>

#include "fields/window_read_out.hpp"
#include "paths/surface_trace.hpp"

namespace plexway {

/// From triangle to triangle, each time to where the nearest window says that the path came in.
/// Distances of vertices on the way fall, and there is a most of steps, so it ends; false if it
/// finds no way on.
template <class Real>
bool SurfaceTrace<Real>::follow_windows(Index f, std::array<double, 3> at, StripWay& way) const {
  using Sight = typename WindowReadOut<Real>::Sight;
  const WindowReadOut<Real> windows(mesh_, solved_);
  const auto triangles = mesh_.triangles();
  const auto distance = [&](Index v) {
    return static_cast<double>(solved_.field.distance[solved_.outer[v]]);
  };
  // The source that a vertex is, or none.
  const auto source_at = [&](Index v) {
    const Index outer = solved_.outer[v];
    const Index n = solved_.field.label.empty() ? 0 : solved_.field.label[outer];
    if (n >= solved_.sources.size()) return none;
    const PointSource& s = solved_.sources[n];
    const bool here =
        s.vertex == outer && static_cast<Real>(s.offset) <= solved_.field.distance[outer];
    return here ? n : none;
  };
  constexpr double at_end = 1e-12;  // of an edge: a crossing so near is the vertex
  std::vector<Strip> strips;
  std::vector<Index> corners;
  Strip leg;
  leg.first = f;
  leg.start = at;
  std::size_t entered = 3;
  double known = std::numeric_limits<double>::infinity();
  const std::size_t most = 2 * mesh_.face_count() + 64;
  for (std::size_t steps = 0; steps < most; ++steps) {
    Sight sight;
    if (const std::size_t i = corner_of(at); i < 3) {
      const Index v = triangles[f].corner[i];
      if (!(distance(v) < known)) return false;
      known = distance(v);
      if (steps > 0) {
        leg.end = at;
        strips.push_back(std::move(leg));
      }
      if (const Index n = source_at(v); n != none) {
        if (strips.empty()) strips.push_back({f, at, at, {}});
        way = strips_.joined(std::move(strips), n);
        return true;
      }
      mesh_.corners_at(v, corners);
      for (const Index c : corners)
        if (const Sight there = windows.look(c / 3, at_corner(c % 3));
            there.distance < sight.distance)
          sight = there, f = c / 3, at = at_corner(c % 3);
      leg = Strip{};
      leg.first = f;
      leg.start = at;
    } else {
      sight = windows.look(f, at, entered);
    }
    switch (sight.over) {
      case Sight::Over::nothing:
        return false;
      case Sight::Over::source:
        leg.end = sight.place;
        strips.push_back(std::move(leg));
        way = strips_.joined(std::move(strips), sight.source);
        return true;
      case Sight::Over::corner:
        at = sight.place;
        entered = 3;
        break;
      case Sight::Over::edge: {
        const std::size_t e = sight.edge;
        const double share = sight.place[edge_after(e)];
        if (share < at_end || share > 1 - at_end) {
          at = at_corner(share < at_end ? e : edge_after(e));
          entered = 3;
          break;
        }
        // Over an edge of several triangles: to the one that it came from.
        std::optional<Crossing> back;
        std::array<double, 3> there = {};
        double least = std::numeric_limits<double>::infinity();
        across_edge(mesh_, f, e, [&](const Crossing& c) {
          std::array<double, 3> place = {};
          place[c.edge] = c.flip ? 1 - share : share;
          place[edge_after(c.edge)] = 1 - place[c.edge];
          const double d = windows.look(c.face, place, c.edge).distance;
          if (d < least) least = d, back = c, there = place;
        });
        if (!back) return false;
        leg.crossings.push_back(*back);
        f = back->face;
        at = there;
        entered = back->edge;
      }
    }
  }
  return false;
}

template bool SurfaceTrace<float>::follow_windows(Index, std::array<double, 3>, StripWay&) const;
template bool SurfaceTrace<double>::follow_windows(Index, std::array<double, 3>, StripWay&) const;

}  // namespace plexway
