#include <algorithm>
#include <cmath>

#include "strings/extender.hpp"

namespace plexway::detail::strings {

// Would a string through a point, that comes and goes in these directions, be shorter through doors
// there? A problem of its own, with legs of length 1 and places that have no ends. At a row patches
// have a side.
bool Extender::gains(const Point& in, const Point& out, std::span<const Index> doors, Index before,
                     const Point& at, Index row) {
  if (doors.size() == 2) {
    const Index m = space_->medium_behind(doors[0]), after = space_->medium_behind(doors[1]);
    if (is_at_rest(*place(space_->place_of(doors[0])), slowness(before) * in,
                   *place(space_->place_of(doors[1])), slowness(after) * out, slowness(m)))
      return false;
  }
  String& s = single_;
  copies_.clear();
  copies_.reserve(doors.size());
  s.knots.assign(1, {at - in});
  s.knots[0].slowness = slowness(before);
  const Point way = in + out;
  for (const Index door : doors) {
    Knot k = knot(door, at - in + double(s.knots.size()) / double(doors.size() + 1) * way);
    copies_.push_back(*k.place);
    Place& copy = copies_.back();
    copy.end[0] = copy.end[1] = none;
    if (kind(k) != Kind::corner) {
      copy.low = -unreached;
      copy.high = unreached;
      k.t = dot(k.at - copy.origin, copy.along);
    }
    k.place = &copy;
    s.knots.push_back(k);
  }
  const double now = s.knots.front().slowness + s.knots.back().slowness;
  s.knots.push_back({at + out});
  puller_.pull(s);
  apart_.clear();
  for (std::size_t k = 1; k <= doors.size(); ++k) apart_.push_back(s.at(k));
  if (!(s.length < now * (1 - 1e-9))) return false;
  for (std::size_t k = 1; k <= doors.size(); ++k) {
    const Index q = place_of(s.knots[k]);
    if (space_->kind(q) != Kind::patch) continue;
    if (row != none) {
      if (dot(s.at(k) - at, space_->inward(q, row)) < -1e-9) return false;
      continue;
    }
    const Place& p = *s.knots[k].place;
    const Point d = at + 1e-3 * unit(s.at(k) - at) - p.origin;
    if (!space_->holds(space_->patch(q), dot(d, p.along), dot(d, p.wide), 1e-9)) return false;
  }
  return true;
}

// Places that are all at a point go where `gains` found them: there the length has a kink, which no
// pull leaves by itself.
void Extender::move_apart(Attempt& a, std::size_t begin, const Point& at) {
  auto& knots = a.string.knots;
  const std::size_t end = begin + apart_.size();
  const double scale =
      .5 * std::min({1., norm(at - knots[begin - 1].at), norm(knots[end].at - at)});
  for (std::size_t k = begin; k < end; ++k) {
    const Place& p = *knots[k].place;
    const Point d = at + scale * (apart_[k - begin] - at) - p.origin;
    knots[k].t = std::clamp(dot(d, p.along), p.low, p.high);
    knots[k].u = dot(d, p.wide);
  }
}

// A leg without length: is the string as short without it? Then it is dropped.
bool Extender::collapse(Attempt& a, std::size_t leg, bool& useless) {
  const String& s = a.string;
  const auto& knots = s.knots;
  const std::size_t n = s.bends();
  const Index own = knots[leg].medium;
  if ((leg == 0 || knots[leg - 1].medium == own) && (leg == n || knots[leg + 1].medium == own))
    return false;  // in one medium places lift off
  if (leg == 0 || leg == n) {
    // At an end another label begins or ends in the medium behind.
    if (norm(s.at(leg + 1) - s.at(leg)) > unmoved) return false;
    const Place& p = *knots[leg == 0 ? 1 : n].place;
    const std::size_t next = leg == 0 ? 1 : n - 1;
    const Point d = s.direction(next);
    const double tangent = knots[next].slowness * std::hypot(dot(d, p.along), dot(d, p.wide));
    if (tangent <= knots[leg].slowness * (1 + 1e-9) || a.splits++ > 2) useless = true;
    return false;
  }
  const Index before = knots[leg - 1].medium, after = knots[leg + 1].medium;
  const Point at = s.at(leg), in = s.direction(leg - 1), out = s.direction(leg + 1);
  if (norm(in) == 0 || norm(out) == 0) return false;
  if (kind(knots[leg]) == Kind::bend && kind(knots[leg + 1]) == Kind::bend) return false;
  const std::array<Index, 2> both = {knots[leg].door, knots[leg + 1].door};
  if (before == after) {
    if (gains(in, out, both, before, at, none) && a.splits++ < 3) {
      move_apart(a, leg, at);
      return true;
    }
    replace(a, leg, leg + 2, {}, at);
    return true;
  }
  // The place where both are.
  std::vector<Index> found;
  const auto is_at = [&](Index row) {
    const Place& p = space_->place(row);
    const double t = std::clamp(dot(at - p.origin, p.along), p.low, p.high);
    return norm(at - p.at(t)) < 1e-4;
  };
  const Index q[2] = {place_of(knots[leg]), place_of(knots[leg + 1])};
  const auto consider = [&](Index p) {
    const Index door = space_->door(p, after);
    if (door != none && space_->door(p, before) != none) found.push_back(door);
  };
  if (q[0] == q[1]) {
    if (gains(in, out, both, before, at, none) && a.splits++ < 3) {
      move_apart(a, leg, at);
      return true;
    }
    consider(q[0]);
  }
  for (const Index p : q) {
    if (space_->kind(p) == Kind::corner) consider(p);
    if (space_->kind(p) == Kind::row && is_at(p)) consider(p);
  }
  for (const Index p : q) {
    if (space_->kind(p) == Kind::patch)
      for (const Index row : space_->patch(p).rows)
        if (is_at(row)) consider(row);
    if (space_->kind(p) == Kind::row)
      for (const Index end : space_->ends(p))
        if (norm(at - space_->point(end)) < 1e-4) consider(space_->corner(end));
  }
  if (found.empty() || a.splits++ > 8) return false;
  replace(a, leg, leg + 2, std::array{found[0]}, at);
  return true;
}

// A crossing off its patch slides on to the row there.
bool Extender::leave_patch(Attempt& a, std::size_t k) {
  const Knot& knot = a.string.knots[k];
  const auto& patch = space_->patch(place_of(knot));
  if (space_->holds(patch, knot.t, knot.u, outside)) return false;
  const Place& plane = *knot.place;
  const Point d = a.string.knots[k - 1].leg.to - plane.origin;
  const Index row =
      space_->leaves(patch, {dot(d, plane.along), dot(d, plane.wide)}, {knot.t, knot.u});
  const Index door = row == none ? none : space_->door(row, knot.medium);
  if (door == none) return false;
  replace(a, k, k + 1, std::array{door}, Point(knot.at));
  return true;
}

bool Extender::lift_off_row(Attempt& a, std::size_t k) {
  const Knot &knot = a.string.knots[k], &last = a.string.knots[k - 1];
  const Index row = place_of(knot), before = last.medium, after = knot.medium;
  const Point at = knot.at, in = a.string.direction(k - 1), out = a.string.direction(k);
  if (norm(in) == 0 || norm(out) == 0) return false;
  const Point force = knot.slowness * out - last.slowness * in;
  const double least = gain * (last.slowness + knot.slowness);
  if (before == after) {
    replace(a, k, k + 1, {}, at);
    return true;
  }
  const Place& line = *knot.place;
  const auto& ends = space_->ends(row);
  const bool low = knot.t <= line.low + unmoved, high = knot.t >= line.high - unmoved;
  if ((low && dot(force, line.along) < -least) || (high && dot(force, line.along) > least)) {
    const Index door = space_->door(space_->corner(ends[low ? 0 : 1]), after);
    if (door == none) return false;
    replace(a, k, k + 1, std::array{door}, at);
    return true;
  }
  double most = least;
  Index best = none;
  for (const Index q : space_->patches_at(row)) {
    const Index door = space_->door(q, after);
    if (door == none || space_->door(q, before) == none) continue;
    const double by = dot(force, space_->inward(q, row));
    if (by > most) most = by, best = door;
  }
  if (best == none) return false;
  replace(a, k, k + 1, std::array{best}, at);
  return true;
}

bool Extender::lift_off_corner(Attempt& a, std::size_t k) {
  const Knot &knot = a.string.knots[k], &last = a.string.knots[k - 1];
  const Index before = last.medium, after = knot.medium;
  if (before == after) return false;
  const Point at = knot.at, in = a.string.direction(k - 1), out = a.string.direction(k);
  if (norm(in) == 0 || norm(out) == 0) return false;
  const Point force = knot.slowness * out - last.slowness * in;
  double most = gain * (last.slowness + knot.slowness);
  Index best = none;
  const Index point = space_->point_of_corner(place_of(knot));
  for (const Index q : space_->places_at(point)) {
    const Index door = space_->door(q, after);
    if (door == none || space_->door(q, before) == none) continue;
    const Place& p = space_->place(q);
    double by = 0;
    if (space_->kind(q) == Kind::row) {
      by = dot(force, p.along);
      const auto& ends = space_->ends(q);
      by = ends[0] == point ? by : ends[1] == point ? -by : std::abs(by);
    } else {
      const double t = dot(force, p.along), u = dot(force, p.wide);
      by = std::hypot(t, u);
      if (!(by > most)) continue;
      const Point d = at - p.origin;
      if (!space_->holds(space_->patch(q), dot(d, p.along) + 1e-3 * t / by,
                         dot(d, p.wide) + 1e-3 * u / by, 1e-9))
        continue;
    }
    if (by > most) most = by, best = door;
  }
  if (best == none) return false;
  replace(a, k, k + 1, std::array{best}, at);
  return true;
}

// Where a leg leads from a bend.
Point Extender::toward(const Attempt& a, std::size_t k, std::size_t other, Index to) const {
  const auto row = a.string.row_from(k, other);
  return row ? *row : end_of_leg(a, other, k, to) - a.string.at(k);
}

// Does the string press against the place that it bends at? It came there by a leg.
bool Extender::presses(const Attempt& a, std::size_t k, const Leg& in, const Point& from,
                       Index to) const {
  const Place& p = *a.string.knots[k].place;
  const Leg& out = a.string.knots[k].leg;
  return p.presses(from, in.from - in.to, toward(a, k, k + 1, to), out.to - out.from);
}

bool Extender::drop_lifted(Attempt& a, std::size_t k, Index to) {
  if (a.string.knots[k].place->holds() ||
      presses(a, k, a.string.knots[k - 1].leg, toward(a, k, k - 1, to), to))
    return false;
  const Point beside = end_of_leg(a, k, k - 1, to);
  replace(a, k, k + 1, {}, Point(a.string.at(k)));
  a.string.knots[k - 1].leg.to = beside;
  return true;
}

// Are the places right for the string as it is? One that is not is changed.
bool Extender::rearrange(Attempt& a, Index to, bool& useless) {
  const auto& knots = a.string.knots;
  if (!plain_ && knots.size() > 2)
    for (std::size_t leg = knots.size() - 1; leg-- > 0;) {
      if (norm(knots[leg + 1].at - knots[leg].at) > brief) continue;
      if (collapse(a, leg, useless)) return true;
      if (useless) return false;
    }
  for (std::size_t k = knots.size() - 2; k > 0; --k) {
    switch (kind(knots[k])) {
      case Kind::bend:
        if (drop_lifted(a, k, to)) return true;
        break;
      case Kind::patch:
        if (leave_patch(a, k)) return true;
        break;
      case Kind::row:
        if (lift_off_row(a, k)) return true;
        break;
      case Kind::corner:
        if (lift_off_corner(a, k)) return true;
        break;
    }
  }
  return false;
}

}  // namespace plexway::detail::strings
