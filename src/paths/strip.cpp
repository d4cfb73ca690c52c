#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <numbers>
#include <optional>

#include "paths/strip.hpp"

namespace plexway::detail {

namespace {

struct Portal {
  Vector2 left, right;
  bool new_left;    // which end the crossing before did not have
  bool first_left;  // the edge's first corner, in the triangle beyond, is on the left
};

/// The crossings' edges in the plane; the strip goes "up" through them.
template <class Real>
std::vector<Portal> unfold(const SurfaceShape<Real>& shape, const Strip& strip, Vector2& start,
                           Vector2& end) {
  std::vector<Portal> portals(strip.crossings.size());
  // Corners of the present triangle in the plane.
  Vector2 corner[3] = {{0, 0}, {shape.length(strip.first, 0), 0}, shape.apex(strip.first, 0)};
  bool mirrored = false;
  const auto point = [&](const std::array<double, 3>& b) {
    return b[0] * corner[0] + b[1] * corner[1] + b[2] * corner[2];
  };
  start = point(strip.start);
  Vector2 along = {1, 0};  // from left to right
  for (std::size_t i = 0; i < portals.size(); ++i) {
    const Crossing& c = strip.crossings[i];
    Portal& portal = portals[i];
    const Vector2 here[2] = {corner[c.from], corner[edge_after(c.from)]};
    portal.left = here[mirrored ? 0 : 1];
    portal.right = here[mirrored ? 1 : 0];
    if (i > 0) {
      // The new end is the apex over the edge it came in by.
      const std::size_t apex = edge_before(strip.crossings[i - 1].edge);
      const std::size_t left = mirrored ? c.from : edge_after(c.from);
      portal.new_left = left == apex;
    } else {
      portal.new_left = true;
    }
    mirrored = mirrored != c.flip;
    portal.first_left = !mirrored;
    const Vector2 w = portal.right - portal.left;
    const double width = norm(w);
    if (width > 0) along = 1 / width * w;
    const Vector2 up = {-along.y, along.x};
    const Vector2 apex = shape.apex(c.face, c.edge);
    const Vector2 first = mirrored ? portal.right : portal.left;
    const double way = mirrored ? -apex.x : apex.x;
    corner[c.edge] = first;
    corner[edge_after(c.edge)] = mirrored ? portal.left : portal.right;
    corner[edge_before(c.edge)] = first + way * along + apex.y * up;
  }
  end = point(strip.end);
  return portals;
}

/// One point of the funnel, and the crossing at which it first appeared.
struct Peg {
  Vector2 at;
  std::size_t crossing;
  bool left;
};

/// A point on the edge that is crossed, in the triangle beyond; nothing if it is not on the edge.
/// What is less than rounding off it is on it: pulled, the point and the ends of the edge would
/// turn either way.
std::optional<std::array<double, 3>> beyond(const Crossing& c, const std::array<double, 3>& b) {
  constexpr double rounding = 1e-14;
  if (b[edge_before(c.from)] > rounding) return std::nullopt;
  const double first = b[c.from], second = b[edge_after(c.from)];
  std::array<double, 3> there = {};
  there[carried(c, c.from)] = first / (first + second);
  there[carried(c, edge_after(c.from))] = second / (first + second);
  return there;
}

/// Where the segment passes a portal, 0 at its left end. As near to an end as rounding leaves it,
/// it passes there: the edges of a vertex that it goes through are then crossed at one point.
double passing(const Portal& portal, const Vector2& a, const Vector2& b) {
  constexpr double rounding = 1e-12;
  const Vector2 d = b - a, w = portal.right - portal.left;
  const double left = cross(d, portal.left - a), right = -cross(d, portal.right - a);
  const double sum = left + right;
  if (!(std::max(std::abs(left), std::abs(right)) > rounding * norm(d) * norm(w)) || !(sum > 0)) {
    // It runs along the edge, or has no length: where it comes to it.
    const double w2 = dot(w, w);
    return w2 > 0 ? std::clamp(dot(a - portal.left, w) / w2, 0., 1.) : 0.;
  }
  const double at = left / sum;
  return at < rounding ? 0 : at > 1 - rounding ? 1 : at;
}

}  // namespace

void trim(Strip& strip) {
  std::vector<Crossing>& all = strip.crossings;
  // In and out over one edge: go on from the triangle before.
  std::vector<Crossing> kept;
  kept.reserve(all.size());
  for (const Crossing& c : all) {
    if (kept.empty() || kept.back().edge != c.from) {
      kept.push_back(c);
      continue;
    }
    const Crossing in = kept.back();
    kept.pop_back();
    const Index before = kept.empty() ? strip.first : kept.back().face;
    if (before == c.face && in.from == c.edge) continue;
    kept.push_back({c.face, in.from, c.edge, in.flip == c.flip});
  }
  all.swap(kept);
  // Over edges that it starts or ends on, and so around the vertex if it starts or ends at one.
  std::size_t begin = 0, end = all.size();
  for (; begin < end; ++begin) {
    const auto start = beyond(all[begin], strip.start);
    if (!start) break;
    strip.first = all[begin].face;
    strip.start = *start;
  }
  for (; end > begin; --end) {
    const auto back = beyond(reverse(all[end - 1], none), strip.end);
    if (!back) break;
    strip.end = *back;
  }
  all.erase(all.begin() + static_cast<std::ptrdiff_t>(end), all.end());
  all.erase(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(begin));
}

template <class Real>
PulledStrip pull(const SurfaceShape<Real>& shape, const Strip& strip) {
  Vector2 start, end;
  const std::vector<Portal> portals = unfold(shape, strip, start, end);
  const std::size_t n = portals.size();

  // The funnel: from its tip two chains lead to the ends of the portal. What the tip leaves behind
  // is the way.
  std::vector<Peg> bends;
  std::deque<Peg> left, right;  // without the tip
  Vector2 tip = start;
  const auto enter = [&](const Peg& peg, std::deque<Peg>& own, std::deque<Peg>& other,
                         double turn) {
    while (!own.empty()) {
      const Vector2 before = own.size() > 1 ? own[own.size() - 2].at : tip;
      if (turn * cross(own.back().at - before, peg.at - before) > 0) break;
      own.pop_back();
    }
    if (own.empty())
      while (!other.empty() && turn * cross(other.front().at - tip, peg.at - tip) < 0) {
        bends.push_back(other.front());
        tip = other.front().at;
        other.pop_front();
      }
    own.push_back(peg);
  };
  for (std::size_t i = 0; i < n; ++i) {
    if (i == 0 || portals[i].new_left) enter({portals[i].left, i, true}, left, right, 1);
    if (i == 0 || !portals[i].new_left) enter({portals[i].right, i, false}, right, left, -1);
  }
  enter({end, n, true}, left, right, 1);
  left.pop_back();
  bends.insert(bends.end(), left.begin(), left.end());

  PulledStrip pulled;
  pulled.along.resize(n);
  std::size_t done = 0;  // crossings before have their place
  Vector2 from = start;
  const auto go_to = [&](const Vector2& to, std::size_t until) {
    for (; done < until; ++done) {
      const double at = passing(portals[done], from, to);
      pulled.along[done] = portals[done].first_left ? at : 1 - at;
    }
    pulled.length += norm(to - from);
    from = to;
  };
  for (const Peg& peg : bends) {
    go_to(peg.at, std::min(peg.crossing, n));
    std::size_t last = peg.crossing;
    while (last + 1 < n && portals[last + 1].new_left != peg.left) ++last;
    if (last + 1 <= done) continue;  // the end of an edge that the way ran along
    pulled.bends.push_back({std::max(done, peg.crossing), last + 1, peg.left, peg.at});
    for (; done <= last; ++done)
      pulled.along[done] = portals[done].first_left == peg.left ? 0. : 1.;
  }
  go_to(end, n);
  return pulled;
}

std::array<double, 3> entry(const Strip& strip, const PulledStrip& pulled, std::size_t i) {
  if (i == 0) return strip.start;
  const Crossing& c = strip.crossings[i - 1];
  std::array<double, 3> b = {};
  b[c.edge] = 1 - pulled.along[i - 1];
  b[edge_after(c.edge)] = pulled.along[i - 1];
  return b;
}

std::array<double, 3> exit(const Strip& strip, const PulledStrip& pulled, std::size_t i) {
  if (i == strip.crossings.size()) return strip.end;
  const Crossing& c = strip.crossings[i];
  const double along = c.flip ? pulled.along[i] : 1 - pulled.along[i];
  std::array<double, 3> b = {};
  b[c.from] = 1 - along;
  b[edge_after(c.from)] = along;
  return b;
}

template PulledStrip pull(const SurfaceShape<float>&, const Strip&);
template PulledStrip pull(const SurfaceShape<double>&, const Strip&);

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
