#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "complexes/common/number_range.hpp"
#include "fields/window_read_out.hpp"
#include "paths/surface_trace.hpp"
#include "paths/window_search.hpp"

namespace plexway::detail {

template <class Real>
SurfaceTrace<Real>::SurfaceTrace(const TriangleMesh<Real>& mesh, const Solved<Real>& solved)
    : mesh_(mesh),
      solved_(solved),
      strips_(mesh, solved.positions, solved.outer),
      shape_(strips_.shape()),
      labels_(mesh, solved) {}

template <class Real>
double SurfaceTrace<Real>::distance(Index v) const {
  if (!solved_.field.distance.empty())
    return static_cast<double>(solved_.field.distance[solved_.outer[v]]);
  double least = infinity;
  mesh_.corners_at(v, corners_);
  for (const Index c : corners_)
    if (labels_.reached(c / 3)) least = std::min(least, labels_.corner_distance(c / 3, c % 3));
  return least * mesh_.unit();
}

template <class Real>
double SurfaceTrace<Real>::promise(Index f, const std::array<double, 3>& b) const {
  double least = infinity;
  for (std::size_t i = 0; i < 3; ++i)
    least = std::min(
        least, distance(mesh_.triangles()[f].corner[i]) + shape_.distance(f, at_corner(i), b));
  return least;
}

template <class Real>
PulledWay SurfaceTrace<Real>::find(const PointSource& point, const TraceOptions& options) const {
  Index f = none;
  std::array<double, 3> b = {};
  Index vertex = point.vertex;
  if (vertex == none) {
    const auto [face, turned] = mesh_.inside_face(point.simplex);
    f = face;
    b = inside(point.barycentric, turned);
    if (const std::size_t i = corner_of(b); i < 3)
      vertex = solved_.outer[mesh_.triangles()[f].corner[i]];
  }
  const auto known = [&](Index v) { return distance(v) < infinity; };
  if (vertex != none) {
    const Index corner = mesh_.corner_at(mesh_.inside_vertex(vertex));
    if (corner == none || !known(mesh_.inside_vertex(vertex))) return {};
    f = corner / 3;
    b = at_corner(corner % 3);
  } else if (!std::any_of(std::begin(mesh_.triangles()[f].corner),
                          std::end(mesh_.triangles()[f].corner), known)) {
    return {};
  }

  if (StripWay way; solved_.windows && follow_windows(f, b, way)) {
    PulledWay best = strips_.straighten(std::move(way));
    // Exact ones leave nothing to be found.
    if (options.margin && solved_.field.accuracy != Accuracy::exact())
      search_windows(f, b, options, best);
    return best;
  }

  // A path longer than promised by this is a reason to try the shortest way along edges as well.
  constexpr double failure = 1.01;
  const double promised = promise(f, b);
  PulledWay best;
  const auto whole = [&](const PulledWay& t) {
    return t.source == none ? infinity : t.length + solved_.sources[t.source].offset;
  };
  for (const bool blindly : {false, true}) {
    StripWay way;
    if (whole(best) <= promised * failure || !descend(f, b, blindly, way)) continue;
    PulledWay traced = strips_.straighten(std::move(way));
    if (whole(traced) < whole(best)) best = std::move(traced);
  }
  if (best.source != none) search_windows(f, b, options, best);
  return best;
}

/// The shortest way of all, near one that is known.
template <class Real>
void SurfaceTrace<Real>::search_windows(Index f, const std::array<double, 3>& b,
                                        const TraceOptions& options, PulledWay& best) const {
  const auto left = [&](Index v) { return distance(v); };
  std::vector<WindowGoal> goals;
  for (const PointSource& s : solved_.sources) {
    WindowGoal goal;
    goal.left = s.offset;
    if (s.vertex != none) {
      goal.vertex = mesh_.inside_vertex(s.vertex);
    } else {
      const auto [face, turned] = mesh_.inside_face(s.simplex);
      goal.at = inside(s.barycentric, turned);
      if (const std::size_t i = corner_of(goal.at); i < 3)
        goal.vertex = mesh_.triangles()[face].corner[i];
      else
        goal.face = face;
    }
    goals.push_back(goal);
  }
  WindowSearch<Real> search(mesh_, shape_, left, goals);
  const auto length = [&] { return best.length + solved_.sources[best.source].offset; };
  // Where the field and the path it led to disagree, or a path much shorter than that is found, the
  // field is off by more than usual: look wider.
  constexpr double shorter = 1 - 1e-12, widest = 0.05;
  const double promised = promise(f, b);
  // Looks for something shorter within a margin. False if windows ran out before all was seen.
  const auto look = [&](double margin, std::size_t most, double bound = infinity) {
    const double known = length();
    auto found = search.find(f, b, std::min(known * shorter, bound), margin, most);
    std::size_t windows = best.windows + found.windows;
    if (found.goal != none) {
      if (found.strips.empty()) {  // the point is that source
        Strip stay;
        stay.first = f;
        stay.start = stay.end = b;
        found.strips.push_back(std::move(stay));
      }
      PulledWay traced = strips_.straighten(strips_.joined(std::move(found.strips), found.goal));
      if (traced.length + solved_.sources[found.goal].offset < known) best = std::move(traced);
    }
    best.windows = windows;
    return found.complete;
  };
  // What is far from the known way uses up windows that are wanted near it. So margins beyond the
  // usual are reached in steps, each with the length that the last found; and where windows run
  // out, narrower ones are tried. A larger margin is then never worse.
  bool seen = true;
  std::size_t used = 0;
  const auto widen = [&](double margin) {
    const std::size_t before = best.windows;
    seen = look(margin, options.max_windows - used);
    used += best.windows - before;
    double narrower = margin;
    for (int i = 0; i < 4 && !seen; ++i) look(narrower /= 2, options.max_windows);
  };
  const double asked = options.margin.value_or(TraceOptions::usual_margin);
  double margin = std::min(asked, TraceOptions::usual_margin);
  // What is longer than promised would be far from the shortest: first near that.
  if (const double near = promised * (1 + margin); margin > 0 && near < length())
    look(margin, options.max_windows, near);
  while (margin > 0 && seen && used < options.max_windows) {
    const double known = length();
    widen(margin);
    const double gain = 1 - length() / known;
    const double off = promised > 0 && promised < infinity ? std::abs(length() / promised - 1) : 0;
    const double next = std::min(4 * std::max(gain, off), widest);
    const double wanted = margin < asked ? std::min(2 * margin, asked) : 0;
    margin = next > margin ? std::max(next, 2 * margin) : wanted;
  }
  best.capped = !seen || margin > 0;
}

/// From triangle to triangle, each time to where the nearest window says that the path came in.
/// Distances of vertices on the way fall, and there is a most of steps, so it ends; false if it
/// finds no way on.
template <class Real>
bool SurfaceTrace<Real>::follow_windows(Index f, std::array<double, 3> at, StripWay& way) const {
  using Sight = typename WindowReadOut<Real>::Sight;
  const WindowReadOut<Real> windows(mesh_, solved_);
  const auto triangles = mesh_.triangles();
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

template class SurfaceTrace<float>;
template class SurfaceTrace<double>;

}  // namespace plexway::detail
