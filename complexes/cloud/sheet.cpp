#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "complexes/cloud/crease.hpp"
#include "complexes/cloud/sheet.hpp"
#include "complexes/common/disjoint_sets.hpp"

namespace plexway::detail {

namespace {

using InPlane = std::array<double, 2>;

double turn(const InPlane& p, const InPlane& q) { return p[0] * q[1] - p[1] * q[0]; }

// Strictly between the sides of the wedge from p to q, which is less than half a circle.
bool inside(const InPlane& p, const InPlane& q, const InPlane& x) {
  const double way = turn(p, q) < 0 ? -1 : 1;
  return way * turn(p, x) > 0 && way * turn(x, q) > 0;
}

InPlane middle(const InPlane& p, const InPlane& q) {
  const double l = std::hypot(p[0], p[1]), m = std::hypot(q[0], q[1]);
  return {p[0] / l + q[0] / m, p[1] / l + q[1] / m};
}

struct Sides {
  Index a, b;
  InPlane pa, pb;
};

bool overlap(const Sides& s, const Sides& t) {
  if (s.a != t.a && s.a != t.b && inside(t.pa, t.pb, s.pa)) return true;
  if (s.b != t.a && s.b != t.b && inside(t.pa, t.pb, s.pb)) return true;
  if (t.a != s.a && t.a != s.b && inside(s.pa, s.pb, t.pa)) return true;
  if (t.b != s.a && t.b != s.b && inside(s.pa, s.pb, t.pb)) return true;
  return inside(t.pa, t.pb, middle(s.pa, s.pb)) || inside(s.pa, s.pb, middle(t.pa, t.pb));
}

}  // namespace

void SheetWedges::reserve(std::size_t triangles) {
  triangles_.reserve(triangles);
  wedges_.reserve(3 * triangles);
}

void SheetWedges::add(const Triangle& t) {
  const Index number = static_cast<Index>(triangles_.size());
  triangles_.push_back(t);
  for (std::size_t i = 0; i < 3; ++i) {
    wedges_.push_back({t[(i + 1) % 3], t[(i + 2) % 3], head_[t[i]], number});
    head_[t[i]] = static_cast<Index>(wedges_.size() - 1);
    unpaired_[t[i]] ^= mixed(t[(i + 1) % 3]) ^ mixed(t[(i + 2) % 3]);
  }
}

void SheetWedges::remove(Index triangle) {
  const Triangle& t = triangles_[triangle];
  for (std::size_t i = 0; i < 3; ++i) {
    Index* link = &head_[t[i]];
    while (wedges_[*link].triangle != triangle) link = &wedges_[*link].next;
    *link = wedges_[*link].next;
    unpaired_[t[i]] ^= mixed(t[(i + 1) % 3]) ^ mixed(t[(i + 2) % 3]);
  }
  triangles_[triangle] = {none, none, none};
}

double SheetWedges::angle_taken(Index place) const {
  double sum = 0;
  around(place, [&](const Wedge& w) {
    const Point3 p = minus(places_.at[w.a], places_.at[place]),
                 q = minus(places_.at[w.b], places_.at[place]);
    const Point3 n = cross(p, q);
    sum += std::atan2(std::sqrt(dot(n, n)), dot(p, q));
  });
  return sum;
}

Index SheetWedges::only_triangle(Index a, Index b) const {
  Index found = none;
  bool several = false;
  around(a, [&](const Wedge& w) {
    if (w.a != b && w.b != b) return;
    several |= found != none;
    found = w.triangle;
  });
  return several ? none : found;
}

SheetWedges::Axes SheetWedges::axes(Index place) const {
  const auto& n = frames_[place].normal;
  const Point3 normal = {n[0], n[1], n[2]};
  const Point3 x = some_perpendicular(normal);
  return {x, cross(normal, x)};
}

SheetWedges::Plane SheetWedges::flat(const Axes& axes, Index place, Index other) const {
  const Point3 q = unfolded(places_, frames_, rule_, place, other);
  return {dot(axes.x, q), dot(axes.y, q)};
}

bool SheetWedges::has_room(const Triangle& t) const {
  for (std::size_t i = 0; i < 3; ++i)
    if (!has_room(t[i], t[(i + 1) % 3], t[(i + 2) % 3])) return false;
  return true;
}

bool SheetWedges::has_room(Index place, Index a, Index b) const {
  if (!used(place)) return true;
  const Axes plane = axes(place);
  const Sides wanted = {a, b, flat(plane, place, a), flat(plane, place, b)};
  bool room = true;
  around(place, [&](const Wedge& w) {
    room = room && !overlap(wanted, {w.a, w.b, flat(plane, place, w.a), flat(plane, place, w.b)});
  });
  return room;
}

Index SheetWedges::next_around(Index place, Index u, Index w) const {
  const Axes plane = axes(place);
  const InPlane pu = flat(plane, place, u);
  const double way = turn(pu, flat(plane, place, w)) > 0 ? -1 : 1;
  Index next = none;
  double least = 3 * std::numbers::pi;
  const auto look = [&](Index x) {
    if (x == u) return;
    const InPlane p = flat(plane, place, x);
    double angle = std::atan2(way * turn(pu, p), pu[0] * p[0] + pu[1] * p[1]);
    if (angle < 0) angle += 2 * std::numbers::pi;
    if (angle < least) least = angle, next = x;
  };
  around(place, [&](const Wedge& wedge) {
    look(wedge.a);
    look(wedge.b);
  });
  return next;
}

double SheetWedges::notch(Index place, Triangle& t) const {
  constexpr double none_there = std::numeric_limits<double>::infinity();
  constexpr double least = std::numbers::pi + 0.02;  // a straight rim has none, curved or not
  if (!open(place)) return none_there;
  const Axes plane = axes(place);
  double taken = 0;
  std::vector<Index> ends;
  around(place, [&](const Wedge& w) {
    const InPlane p = flat(plane, place, w.a), q = flat(plane, place, w.b);
    taken += std::abs(std::atan2(turn(p, q), p[0] * q[0] + p[1] * q[1]));
    for (const Index end : {w.a, w.b})
      if (only_triangle(place, end) != none) ends.push_back(end);
  });
  if (ends.size() != 2 || !(taken > least) || !(taken < 2 * std::numbers::pi)) return none_there;
  if (!same_sheet(places_, frames_, rule_, ends[0], ends[1])) return none_there;
  t = {place, ends[0], ends[1]};
  std::sort(t.begin(), t.end());
  const InPlane a = flat(plane, place, ends[0]), b = flat(plane, place, ends[1]);
  if (a[0] * b[0] + a[1] * b[1] > 0) return none_there;  // the end of a slit
  return std::abs(turn(a, b)) / std::hypot(b[0] - a[0], b[1] - a[1]) /
         static_cast<double>(frames_[place].reach);
}

double SheetWedges::circle(const Triangle& t) const {
  const Point3 a = minus(places_.at[t[1]], places_.at[t[0]]);
  const Point3 b = minus(places_.at[t[2]], places_.at[t[0]]);
  const Point3 c = minus(b, a), n = cross(a, b);
  const double sides = std::sqrt(dot(a, a)) * std::sqrt(dot(b, b)) * std::sqrt(dot(c, c));
  const float reach = (frames_[t[0]].reach + frames_[t[1]].reach + frames_[t[2]].reach) / 3;
  return sides / (2 * std::sqrt(dot(n, n)) * static_cast<double>(reach));
}

namespace {

struct Pair {
  double distance_between;
  Index a, b;
  friend auto operator<=>(const Pair&, const Pair&) = default;
};

double distance_between(const Places& places, Index a, Index b) {
  const Point3 q = minus(places.at[a], places.at[b]);
  return std::sqrt(dot(q, q));
}

// Of those that share a triangle with a, the nearest to b.
Index beside(const Places& places, const SheetWedges& sheet, Index a, Index b) {
  Pair best = {std::numeric_limits<double>::infinity(), none, none};
  sheet.around(a, [&](const SheetWedges::Wedge& w) {
    for (const Index x : {w.a, w.b})
      if (x != b) best = std::min(best, {distance_between(places, x, b), x, a});
  });
  return best.a;
}

}  // namespace

CloudParts bridge_parts(const SheetRule& rule, std::span<const TangentFrame> frames, Places& places,
                        SheetWedges& sheet) {
  const std::size_t n = places.near.point_count();
  DisjointSets parts(n);
  for (const auto& [a, b, c] : sheet.triangles())
    if (a != none) parts.unite(a, b), parts.unite(b, c);

  std::vector<Index> of(n);
  bool several = false;
  for (Index i = 0; i < n; ++i) {
    of[i] = parts.find(i);
    several |= of[i] != of[0];
  }
  std::vector<Pair> pairs;
  for (Index i = 0; i < n && several; ++i) {
    bool alone = !sheet.used(i);
    for (const Index j : places.near.around(i)) {
      if (of[i] == of[j]) continue;
      if (!same_sheet(places, frames, rule, i, j)) continue;
      alone = false;
      pairs.push_back({distance_between(places, i, j), std::min(i, j), std::max(i, j)});
    }
    if (alone && !places.near.around(i).empty()) {
      const Index j = places.near.around(i)[0];
      pairs.push_back({distance_between(places, i, j), std::min(i, j), std::max(i, j)});
    }
  }
  std::sort(pairs.begin(), pairs.end());

  CloudParts result;
  for (const auto& [l, a, b] : pairs) {
    if (parts.find(a) == parts.find(b)) continue;
    parts.unite(a, b);
    ++result.bridges;
    const bool at_a = sheet.used(a), at_b = sheet.used(b);
    result.joints += at_a && at_b;
    if (!at_a && !at_b) {
      const Index halfway = static_cast<Index>(places.at.size());
      const Point3 &p = places.at[a], &q = places.at[b];
      places.at.push_back({p[0] / 2 + q[0] / 2, p[1] / 2 + q[1] / 2, p[2] / 2 + q[2] / 2});
      sheet.add_place();
      parts.add();
      parts.unite(halfway, a);
      sheet.add({a, b, halfway});
      continue;
    }
    // One triangle at each end, glued along the segment.
    const Index x = at_a ? beside(places, sheet, a, b) : none;
    const Index y = at_b ? beside(places, sheet, b, a) : none;
    if (at_a) sheet.add({a, x, b});
    if (at_b) sheet.add({b, y, a});
  }
  result.part.resize(n);
  for (Index i = 0; i < n; ++i) result.part[i] = parts.find(i);
  return result;
}

}  // namespace plexway::detail
