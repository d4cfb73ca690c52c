#include "paths/straighten.hpp"

#include <algorithm>
#include <limits>
#include <numbers>

namespace plexway::detail {
namespace {

// Less than this is not worth a move: it shortens the path by its square.
constexpr double angle_worth_moving = 1e-6;
constexpr double shorter = 1 - 1e-14;
constexpr std::size_t most_shortenings =
    10000;  // each of them shortens; this is for the impossible

// A triangle at a vertex, come in by one of its two edges there.
struct Visit {
  Index face;
  std::uint8_t corner, in;  // the edge it came in by
  double angle;             // from the direction in to that edge
  std::size_t before;       // the visit before, or none
  Crossing crossing;        // how it came in
  bool done;
};

}  // namespace

template <class Real>
bool Straightener<Real>::around(Index f, std::size_t in, double in_angle, Index g, std::size_t out,
                                double out_angle, double most, std::vector<Crossing>& way) const {
  constexpr std::size_t nobody = ~std::size_t{0};
  way.clear();
  double best = std::numeric_limits<double>::infinity();
  std::size_t best_visit = nobody;
  if (f == g && in == out) best = std::abs(out_angle - in_angle);
  // Dijkstra's algorithm on the few triangles there; a list serves as the queue.
  std::vector<Visit> visits;
  const auto leave = [&](Index face, std::size_t corner, std::size_t edge, double angle,
                         std::size_t from) {
    if (!(angle < best) || !(angle <= most)) return;
    across_edge(*mesh_, face, edge, [&](const Crossing& c) {
      const std::size_t there = carried(c, corner);
      for (Visit& v : visits)
        if (v.face == c.face && v.corner == there && v.in == c.edge) {
          if (!v.done && angle < v.angle) v.angle = angle, v.before = from, v.crossing = c;
          return;
        }
      visits.push_back({c.face, static_cast<std::uint8_t>(there), c.edge, angle, from, c, false});
    });
  };
  leave(f, in, in, in_angle, nobody);
  leave(f, in, edge_before(in), shape_->angle(f, in) - in_angle, nobody);
  for (;;) {
    std::size_t next = nobody;
    for (std::size_t i = 0; i < visits.size(); ++i)
      if (!visits[i].done && (next == nobody || visits[i].angle < visits[next].angle)) next = i;
    if (next == nobody || !(visits[next].angle < best)) break;
    visits[next].done = true;
    const Visit v = visits[next];
    const double whole = shape_->angle(v.face, v.corner);
    if (v.face == g && v.corner == out) {
      const double to = v.angle + (v.in == v.corner ? out_angle : whole - out_angle);
      if (to < best) best = to, best_visit = next;
    }
    leave(v.face, v.corner, v.in == v.corner ? edge_before(v.corner) : v.corner, v.angle + whole,
          next);
  }
  if (!(best < std::numeric_limits<double>::infinity()) || !(best <= most)) return false;
  for (std::size_t i = best_visit; i != nobody; i = visits[i].before)
    way.push_back(visits[i].crossing);
  std::reverse(way.begin(), way.end());
  return true;
}

/// Is there less than pi on some other side of the bend?
template <class Real>
bool Straightener<Real>::move(const Strip& strip, const PulledStrip& pulled, const Bend& bend,
                              std::vector<Crossing>& way) const {
  // The vertex, in the triangle before the bend and in the one after.
  const Crossing& last = strip.crossings[bend.end - 1];
  const std::array<double, 3> here = exit(strip, pulled, bend.begin);
  const std::array<double, 3> there = entry(strip, pulled, bend.end);
  const std::size_t in = corner_of(here), out = corner_of(there);
  if (in == 3 || out == 3) return false;
  const Index f = strip.face(bend.begin), g = last.face;
  const std::array<double, 3> from = entry(strip, pulled, bend.begin);
  const std::array<double, 3> to = exit(strip, pulled, bend.end);
  if (from[in] >= 1 || to[out] >= 1) return false;  // no direction
  return around(f, in, shape_->angle_to(f, in, from), g, out, shape_->angle_to(g, out, to),
                std::numbers::pi - angle_worth_moving, way);
}

template <class Real>
PulledStrip Straightener<Real>::straighten(Strip& strip) const {
  trim(strip);
  PulledStrip pulled = pull(*shape_, strip);
  std::vector<Crossing> way;
  bool one_by_one = false;  // after a round that did not shorten
  std::size_t skipped = 0;
  for (std::size_t round = 0; round < most_shortenings; ++round) {
    Strip moved;
    moved.first = strip.first;
    moved.start = strip.start;
    moved.end = strip.end;
    moved.crossings.reserve(strip.crossings.size());
    std::size_t done = 0, candidates = 0;
    bool any = false;
    for (const Bend& bend : pulled.bends) {
      if (!move(strip, pulled, bend, way)) continue;
      if (one_by_one && (any || candidates++ < skipped)) continue;
      any = true;
      const auto at = [&](std::size_t i) {
        return strip.crossings.begin() + static_cast<std::ptrdiff_t>(i);
      };
      moved.crossings.insert(moved.crossings.end(), at(done), at(bend.begin));
      moved.crossings.insert(moved.crossings.end(), way.begin(), way.end());
      done = bend.end;
    }
    if (!any) break;
    moved.crossings.insert(moved.crossings.end(),
                           strip.crossings.begin() + static_cast<std::ptrdiff_t>(done),
                           strip.crossings.end());
    trim(moved);
    PulledStrip shortened = pull(*shape_, moved);
    if (shortened.length < pulled.length * shorter) {
      strip = std::move(moved);
      pulled = std::move(shortened);
      one_by_one = false;
      skipped = 0;
    } else if (!one_by_one) {
      one_by_one = true;
    } else {
      ++skipped;
    }
  }
  return pulled;
}

template class Straightener<float>;
template class Straightener<double>;

}  // namespace plexway::detail
