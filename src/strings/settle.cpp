#include "strings/solver.hpp"

#include <algorithm>
#include <cmath>

namespace plexway::strings {

// Would a string through a point, that comes and goes in these directions, be shorter through doors
// there? A problem of its own, with legs of length 1 and places that have no ends. At a row patches
// have a side.
bool Solver::gains(const Point& in, const Point& out, std::span<const Index> doors, Index before,
                   const Point& at, Index row) {
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
void Solver::move_apart(Attempt& a, std::size_t begin, const Point& at) {
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
bool Solver::collapse(Attempt& a, std::size_t leg, bool& useless) {
  const String& s = a.string;
  const auto& knots = s.knots;
  const std::size_t n = s.bends();
  const Index own = knots[leg].medium;
  if ((leg == 0 || knots[leg - 1].medium == own) && (leg == n || knots[leg + 1].medium == own))
    return false;  // in one medium places lift off
  if (leg == 0 && a.held > 0) {
    release(a, a.held);
    return true;
  }
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
bool Solver::leave_patch(Attempt& a, std::size_t k) {
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

bool Solver::lift_off_row(Attempt& a, std::size_t k) {
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

bool Solver::lift_off_corner(Attempt& a, std::size_t k) {
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
Point Solver::toward(const Attempt& a, std::size_t k, std::size_t other, Index to) const {
  const auto row = a.string.row_from(k, other);
  return row ? *row : end_of_leg(a, other, k, to) - a.string.at(k);
}

// Does the string press against the place that it bends at? It came there by a leg.
bool Solver::presses(const Attempt& a, std::size_t k, const Leg& in, const Point& from,
                     Index to) const {
  const Place& p = *a.string.knots[k].place;
  const Leg& out = a.string.knots[k].leg;
  return p.presses(p.angle_of(from, in.from - in.to),
                   p.angle_of(toward(a, k, k + 1, to), out.to - out.from));
}

bool Solver::drop_lifted(Attempt& a, std::size_t k, Index to) {
  if (a.string.knots[k].place->holds() ||
      presses(a, k, a.string.knots[k - 1].leg, toward(a, k, k - 1, to), to))
    return false;
  const Point beside = end_of_leg(a, k, k - 1, to);
  replace(a, k, k + 1, {}, Point(a.string.at(k)));
  a.string.knots[k - 1].leg.to = beside;
  return true;
}

// Does the string go on in another direction from the last of the places that are held?
bool Solver::turns_at_held(const Attempt& a) const {
  if (a.held == 0) return false;
  const Point moved = a.string.at(1) - base_.string.at(a.held + 1);
  return dot(moved, moved) > unmoved * unmoved;
}

// And does it lift off there?
bool Solver::lifts_off_held(const Attempt& a, Index to) const {
  const Knot& first = a.string.knots[0];
  if (!turns_at_held(a) || first.place->holds() || kind(first) != Kind::bend) return false;
  const Leg& in = leg_before(a, 0);
  const auto row = base_.string.row_from(a.held, a.held - 1);
  return !presses(a, 0, in, row ? *row : in.from - first.at, to);
}

// Are the places right for the string as it is? One that is not is changed.
bool Solver::rearrange(Attempt& a, Index to, bool& useless) {
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
  if (!lifts_off_held(a, to)) return false;
  release(a, a.held);
  return true;
}

Point Solver::end_of_leg(const Attempt& a, std::size_t k, std::size_t other, Index to) const {
  const auto& knots = a.string.knots;
  const Knot &knot = knots[k], &behind = knots[std::min(k, other)];
  const auto& medium = space_->media()[behind.medium];
  if (!medium.room) return knot.at;
  const Point &toward = knots[other].at, &free = other > k ? behind.leg.to : behind.leg.from;
  if (k + 1 == knots.size())
    return to == space_->nodes() ? attached_beside_
                                 : medium.room->beside(medium.in_room(to), toward, behind.leg.to);
  if (knot.place == nullptr) {
    const Root& root = roots_[a.root];
    return root.node != none ? medium.room->beside(medium.in_room(root.node), toward, free)
                             : root.beside;
  }
  const Index q = place_of(knot);
  if (space_->kind(q) != Kind::patch)
    return space_->beside(q, behind.medium, knot.at, toward, free);
  // On one side of a crack through the plane, for both legs.
  const Point side = knot.at + (leg_before(a, k).from - knot.at) + (knot.leg.to - knot.at);
  return space_->beside(q, behind.medium, knot.at, toward, side);
}

// At or near to a point.
Knot Solver::knot(Index door, const Point& at) {
  Knot knot{at, place(space_->place_of(door))};
  const Place& p = *knot.place;
  const Point d = at - p.origin;
  knot.t = std::clamp(dot(d, p.along), p.low, p.high);
  knot.u = dot(d, p.wide);
  knot.door = door;
  knot.medium = space_->medium_behind(door);
  knot.slowness = slowness(knot.medium);
  knot.leg = {at, at, false};
  return knot;
}

// Between the end of the string as it was and a point on the way to the new one.
void Solver::append(Attempt& a, Index door, const Point& toward) {
  auto& knots = a.string.knots;
  const Point& from = at(from_);
  Knot last = knot(door, .5 * (from + toward));
  // From where it is free: in that medium beside the point, which tells the side of a crack.
  const Index n = space_->node(point_of(from_), last.medium);
  const auto& medium = space_->media()[last.medium];
  const Point beside =
      medium.room && n != none ? medium.room->beside(medium.in_room(n), toward, toward) : from;
  last.leg = {beside, beside, false};
  knots.insert(knots.end() - 1, last);
}

// Instead of the places of some knots others, at a point.
void Solver::replace(Attempt& a, std::size_t begin, std::size_t end, std::span<const Index> doors,
                     const Point& at) {
  auto& knots = a.string.knots;
  const Point to = knots[end - 1].leg.to;
  const auto b = knots.begin() + static_cast<std::ptrdiff_t>(begin);
  if (doors.size() < end - begin)
    knots.erase(b, b + static_cast<std::ptrdiff_t>(end - begin - doors.size()));
  else
    knots.insert(b, doors.size() - (end - begin), Knot{});
  for (std::size_t n = 0; n < doors.size(); ++n) knots[begin + n] = knot(doors[n], at);
  Leg& first = knots[begin - 1].leg;
  first = {first.from, at, false};
  knots[begin + doors.size() - 1].leg.to = to;
}

// The string of the node that offers, to another end.
void Solver::start(Index to) {
  constexpr std::size_t loose = 3;
  const auto& base = base_.string.knots;
  Attempt& a = attempt_;
  a.held = std::max(base.size(), loose + 2) - (loose + 2);
  a.string.knots.assign(base.begin() + static_cast<std::ptrdiff_t>(a.held), base.end());
  a.string.knots.back().at = at(to);
  a.string.before = base[a.held].before;
  a.root = base_.root;
  a.touched = false;
  a.splits = 0;
}

// So many of the knots that are held are no longer.
void Solver::release(Attempt& a, std::size_t count) {
  const auto& base = base_.string.knots;
  const auto end = base.begin() + static_cast<std::ptrdiff_t>(a.held);
  a.held -= std::min(count, a.held);
  a.string.knots.insert(a.string.knots.begin(), base.begin() + static_cast<std::ptrdiff_t>(a.held),
                        end);
  a.string.before = base[a.held].before;
}

bool Solver::is_edge(const Attempt& a) const {
  const Knot& knot = a.string.knots[a.string.bends()];
  if (knot.place == nullptr) return roots_[a.root].node == from_;
  const Index p = point_of(from_);
  return knot.place->vertex == p && space_->node(p, knot.medium) != none;
}

// The last leg that leaves its medium; as many as there are legs: none does.
std::size_t Solver::blocked(const Attempt& a, Index to) {
  const auto moved = [](const Point& p, const Point& q) {
    const Point d = p - q;
    return dot(d, d) > unmoved * unmoved;
  };
  const auto& knots = a.string.knots;
  const std::size_t legs = knots.size() - 1;
  for (std::size_t k = legs; k-- > 0;) {
    const auto& medium = space_->media()[knots[k].medium];
    if (!medium.room) continue;
    if (k + 1 == legs && is_edge(a)) continue;
    const Point from = end_of_leg(a, k, k + 1, to), end = end_of_leg(a, k + 1, k, to);
    const Leg& leg = knots[k].leg;
    if (leg.known && !moved(from, leg.from) && !moved(end, leg.to)) continue;
    if (medium.room->sight().is_blocked(from, end)) return k;
  }
  return legs;
}

bool Solver::insert_touched(Attempt& a, std::size_t k, Index to) {
  const auto& knots = a.string.knots;
  const Leg leg = knots[k].leg;
  const auto& medium = space_->media()[knots[k].medium];
  const Point from = end_of_leg(a, k, k + 1, to), end = end_of_leg(a, k + 1, k, to);
  const auto own = [&](const Knot& knot) {
    const Index p = knot.place == nullptr ? none : place_of(knot);
    return p == none || space_->kind(p) != Kind::bend || p < medium.first_bend
               ? none
               : p - medium.first_bend;
  };
  const std::array<Index, 2> known = {own(knots[k]), own(knots[k + 1])};
  // It turns about the end that moved less.
  const bool backward = norm(leg.from - from) > norm(leg.to - end);
  const auto touch = backward ? medium.room->sight().touch(end, from, leg.from, known)
                              : medium.room->sight().touch(from, end, leg.to, known);
  if (!touch) return false;
  a.touched = true;
  const Index number = medium.first_bend + touch->place;
  const Place& place = space_->place(number);
  const Point at = place.at(touch->at), beside = place.beside(touch->at, space_->aside());
  replace(a, k + 1, k + 1, std::array{space_->first_door(number)}, at);
  a.string.knots[k].leg = {leg.from, beside, false};
  a.string.knots[k + 1].leg = {beside, leg.to, false};
  return true;
}

// Has a node had a string along these places, or tried it?
bool Solver::is_known(const Attempt& a, Index to) const {
  const auto& knots = a.string.knots;
  Index chain = knots[0].chain;
  for (std::size_t k = 1; k + 1 < knots.size() && chain != none; ++k)
    chain = chains_.find(chain, knots[k].door);
  return chain != none && nodes_[to].knows(chain);
}

// Pulled, places dropped and put in until all legs are free; no further if it is of no use, or
// as long as `least`. Of a long string its end first, the rest held as it is.
Solver::Outcome Solver::settle(Attempt& a, Index to, double least) {
  constexpr int most = 48;
  constexpr double exact = 1e-14;
  String& string = a.string;
  bool useless = false;
  for (int round = 0; round < most; ++round) {
    puller_.pull(string);
    if (rearrange(a, to, useless)) {
      if (string.bends() < 2) release(a, 3 - string.bends());
      if (is_known(a, to)) return Outcome::longer;
      continue;
    }
    if (useless) return Outcome::longer;
    const auto is_useful = [&](double length) {
      return length < least + offset(a) && length < direct_ &&
             length * (1 + 1e-12) < limit(to, last_leg(a));
    };
    double more = 0;
    if (a.held > 0) {
      const Knot& before = base_.string.knots[a.held - 1];
      more = slack(string, base_.string.direction(a.held - 1), before.slowness);
    }
    if (!is_useful(length(a) - more)) return Outcome::longer;
    const std::size_t leg =
        more > 0 && !is_useful(length(a)) ? string.knots.size() : blocked(a, to);
    if (leg + 1 < string.knots.size()) {
      if (!insert_touched(a, leg, to)) break;
      if (is_known(a, to)) return Outcome::longer;
    } else if (leg + 1 == string.knots.size() && more <= exact * string.length) {
      return Outcome::free;
    } else {
      release(a, a.held);
    }
  }
  release(a, a.held);
  puller_.pull(string);
  return Outcome::stuck;
}

// Where a string is held at a vertex it may be shorter past it.
void Solver::past_corners(Attempt& a, Index to, Outcome& outcome) {
  const auto is_at_end = [](const Knot& k) {
    return k.t < k.place->low + unmoved || k.t > k.place->high - unmoved;
  };
  if (turns_at_held(a) && is_at_end(a.string.knots[0])) release(a, a.held);
  for (std::size_t k = a.string.bends(); k > 0 && k <= a.string.bends(); --k) {
    const Index vertex = vertex_of(a, k);
    if (vertex == none) continue;
    const Index m = a.string.knots[k].medium;
    const Point& at = space_->media()[m].room->point(vertex);
    const auto is_there = [&](std::size_t n) {
      return n > 0 && n <= a.string.bends() && a.string.knots[n - 1].medium == m &&
             a.string.knots[n].medium == m && norm(a.string.at(n) - at) < unmoved;
    };
    std::size_t begin = k, end = k + 1;
    while (is_there(begin - 1)) --begin;
    while (is_there(end)) ++end;
    // Shorter now: from the end again.
    k = past_corner(a, to, outcome, begin, end, vertex) ? a.string.bends() + 1 : begin;
  }
}

// Of the medium, that a bend inside it is held at.
Index Solver::vertex_of(const Attempt& a, std::size_t k) const {
  const Knot& knot = a.string.knots[k];
  const Index m = knot.medium;
  const auto& medium = space_->media()[m];
  if (!medium.is_solid || a.string.knots[k - 1].medium != m) return none;
  const Place& p = *knot.place;
  if (p.vertex != none) return medium.in_room(space_->node(p.vertex, m));
  return knot.t < p.low + unmoved ? p.end[0] : knot.t > p.high - unmoved ? p.end[1] : none;
}

// The knots from `begin` to `end` are all at one vertex: the places of the shortest way around it
// instead.
bool Solver::past_corner(Attempt& a, Index to, Outcome& outcome, std::size_t begin, std::size_t end,
                         Index vertex) {
  const auto& medium = space_->media()[a.string.knots[begin].medium];
  const Point &at = medium.room->point(vertex), in = a.string.at(begin - 1) - at,
              out = a.string.at(end) - at;
  if (!corner_.find(*medium.room, vertex, in, out)) return false;
  const double least = outcome == Outcome::free ? a.string.length * (1 - 1e-12) : unreached,
               reach = std::min(norm(in), norm(out));
  const Point beside = end_of_leg(a, begin, begin - 1, to);
  do {
    const auto rows = corner_.rows();
    const double half = corner_.turned() / 2;
    doors_.clear();
    for (const Corner::Row& row : rows)
      doors_.push_back(space_->first_door(medium.first_bend + row.place));
    other_ = a;
    other_.splits = 0;
    replace(other_, begin, end, doors_, at);
    for (std::size_t n = 0; n < rows.size(); ++n) {
      Knot& knot = other_.string.knots[begin + n];
      const Place& p = *knot.place;
      // Unfolded, a straight line across the sectors.
      knot.at = at + reach * std::cos(half) / std::cos(rows[n].turned - half) * rows[n].along;
      knot.t = dot(knot.at - p.origin, p.along);
      knot.leg.from = p.holds() ? knot.at : p.beside(knot.t, space_->aside());
      other_.string.knots[begin + n - 1].leg.to = knot.leg.from;
    }
    other_.string.knots[begin + rows.size() - 1].leg.to = beside;
    if (settle(other_, to, least) == Outcome::free) {
      std::swap(a, other_);
      outcome = Outcome::free;
      return true;
    }
  } while (!corner_.rows().empty() && corner_.find_other(*medium.room));
  return false;
}

// Other doors instead of that of a knot, if the string is shorter then.
bool Solver::instead(Attempt& a, Index to, Outcome& outcome, std::size_t k,
                     std::span<const Index> doors) {
  other_ = a;
  other_.splits = 0;
  const Point at = a.string.at(k);
  replace(other_, k, k + 1, doors, at);
  if (doors.size() > 1) move_apart(other_, k, at);
  const double less = outcome == Outcome::free ? a.string.length * (1 - 1e-12) : unreached;
  if (settle(other_, to, less) != Outcome::free) return false;
  std::swap(a, other_);
  outcome = Outcome::free;
  return true;
}

// A string held at the end of a row in a sheet may be shorter past it, one at a row or a corner
// through another medium there.
bool Solver::past_media(Attempt& a, Index to, Outcome& outcome) {
  for (std::size_t k = a.string.bends(); k > 0; --k) {
    const Knot& knot = a.string.knots[k];
    const Index q = place_of(knot);
    const Kind kind = space_->kind(q);
    const Index before = a.string.knots[k - 1].medium, after = knot.medium;
    if (before == after && !space_->media()[before].is_solid && is_held(a.string, k) &&
        instead(a, to, outcome, k, {}))
      return true;
    if (kind != Kind::row && kind != Kind::corner) continue;
    const Point at = a.string.at(k), in = a.string.direction(k - 1), out = a.string.direction(k);
    if (norm(in) == 0 || norm(out) == 0) continue;
    std::vector<Index> places;
    if (kind == Kind::row) {
      const auto patches = space_->patches_at(q);
      places.assign(patches.begin(), patches.end());
      places.push_back(q);
    } else {
      const auto all = space_->places_at(space_->point_of_corner(q));
      places.assign(all.begin(), all.end());
    }
    for (const Index one : places)
      for (const Index two : places) {
        if (space_->door(one, before) == none) continue;
        const Index last = space_->door(two, after);
        if (last == none) continue;
        for (Index d = space_->first_door(one); d < space_->last_door(one); ++d) {
          const Index m = space_->medium_behind(d);
          if (m == before || m == after || space_->door(two, m) == none) continue;
          const std::array<Index, 2> doors = {d, last};
          if (gains(in, out, doors, before, at, kind == Kind::row ? q : none) &&
              instead(a, to, outcome, k, doors))
            return true;
        }
      }
  }
  return false;
}

// What is shorter past where a string is held.
Solver::Outcome Solver::improve(Attempt& a, Index to, Outcome outcome) {
  do {
    past_corners(a, to, outcome);
  } while (!plain_ && past_media(a, to, outcome));
  return outcome;
}

}  // namespace plexway::strings
