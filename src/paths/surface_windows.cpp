// The shortest way of all, near one that is known.

#include <algorithm>
#include <cmath>
#include <utility>

#include "paths/infinity.hpp"
#include "paths/surface_trace.hpp"
#include "paths/window_search.hpp"

namespace plexway {
namespace {}  // namespace

template <class Real>
void SurfaceTrace<Real>::search_windows(Index f, const std::array<double, 3>& b,
                                        const TraceOptions& options, PulledWay& best) const {
  const double unit = mesh_.unit();
  std::vector<Index> corners;
  const auto left = [&](Index v) {
    if (!solved_.field.distance.empty())
      return static_cast<double>(solved_.field.distance[solved_.outer[v]]);
    double least = infinity;  // a search leaves labels only
    mesh_.corners_at(v, corners);
    for (const Index c : corners)
      if (labels_.reached(c / 3)) least = std::min(least, labels_.corner_distance(c / 3, c % 3));
    return least * unit;
  };
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
  double promise = infinity;
  for (std::size_t i = 0; i < 3; ++i)
    promise = std::min(promise,
                       left(mesh_.triangles()[f].corner[i]) + shape_.distance(f, at_corner(i), b));
  // Looks for something shorter within a margin. False if windows ran out before all was seen.
  const auto look = [&](double margin, std::size_t most) {
    const double known = length();
    auto found = search.find(f, b, known * shorter, margin, most);
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
  while (margin > 0 && seen && used < options.max_windows) {
    const double known = length();
    widen(margin);
    const double gain = 1 - length() / known;
    const double off = promise > 0 && promise < infinity ? std::abs(length() / promise - 1) : 0;
    const double next = std::min(4 * std::max(gain, off), widest);
    const double wanted = margin < asked ? std::min(2 * margin, asked) : 0;
    margin = next > margin ? std::max(next, 2 * margin) : wanted;
  }
  best.capped = !seen || margin > 0;
}

template void SurfaceTrace<float>::search_windows(Index, const std::array<double, 3>&,
                                                  const TraceOptions&, PulledWay&) const;
template void SurfaceTrace<double>::search_windows(Index, const std::array<double, 3>&,
                                                   const TraceOptions&, PulledWay&) const;

}  // namespace plexway
