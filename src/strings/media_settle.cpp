#include <algorithm>
#include <cmath>

#include "strings/media_solver.hpp"

namespace plexway::strings {

// Would a string through a point, that comes and goes in these directions, be shorter through doors
// there? A problem of its own, with legs of length 1 and places that have no ends. At a row patches
// have a side.
bool MediaSolver::gains(const Point& in, const Point& out, std::span<const Index> doors,
                        Index before, const Point& at, Index row) {
  if (doors.size() == 2) {
    const Index m = space_->medium_behind(doors[0]), after = space_->medium_behind(doors[1]);
    if (is_at_rest(*place(space_->place_of(doors[0])), slowness(before) * in,
                   *place(space_->place_of(doors[1])), slowness(after) * out, slowness(m)))
      return false;
  }
  String s;
  s.from = at - in;
  s.to = at + out;
  s.slowness.assign(1, slowness(before));
  copies_.clear();
  copies_.reserve(doors.size());
  for (std::size_t i = 0; i < doors.size(); ++i) {
    const Place* p = place(space_->place_of(doors[i]));
    copies_.push_back(*p);
    Place& copy = copies_.back();
    if (space_->kind(space_->place_of(doors[i])) != Kind::corner) {
      copy.low = -unreached;
      copy.high = unreached;
    }
    s.places.push_back(&copy);
    const Point d =
        s.from + double(i + 1) / double(doors.size() + 1) * (s.to - s.from) - copy.origin;
    s.at.push_back(copy.high > copy.low ? dot(d, copy.along) : 0);
    s.wide.push_back(dot(d, copy.wide));
    s.slowness.push_back(slowness(space_->medium_behind(doors[i])));
  }
  puller_.pull(s);
  apart_ = s.points;
  const double now = s.slowness.front() + s.slowness.back();
  if (!(s.length < now * (1 - 1e-9))) return false;
  for (std::size_t i = 0; i < doors.size(); ++i) {
    const Index q = space_->place_of(doors[i]);
    if (space_->kind(q) != Kind::patch) continue;
    if (row != none) {
      if (dot(s.points[i] - at, space_->inward(q, row)) < -1e-9) return false;
      continue;
    }
    const Point d = at + 1e-3 * unit(s.points[i] - at) - s.places[i]->origin;
    if (!space_->holds(space_->patch(q), dot(d, s.places[i]->along), dot(d, s.places[i]->wide),
                       1e-9))
      return false;
  }
  return true;
}

// Places that are all at a point go where `gains` found them: there the length has a kink, which no
// pull leaves by itself.
void MediaSolver::move_apart(Attempt& a, std::size_t begin, const Point& at) {
  String& s = a.string;
  const std::size_t end = begin + apart_.size();
  const double scale =
      .5 * std::min({1., norm(at - s.corner(begin)), norm(s.corner(end + 1) - at)});
  for (std::size_t i = begin; i < end; ++i) {
    const Place& p = *s.places[i];
    const Point d = at + scale * (apart_[i - begin] - at) - p.origin;
    s.at[i] = std::clamp(dot(d, p.along), p.low, p.high);
    s.wide[i] = dot(d, p.wide);
  }
}

// A leg without length: is the string as short without it? Then it is dropped.
bool MediaSolver::collapse(Attempt& a, std::size_t leg, bool& useless) {
  const std::size_t n = a.doors.size();
  const String& s = a.string;
  const Index own = medium_of_leg(a, leg);
  if ((leg == 0 || medium_of_leg(a, leg - 1) == own) &&
      (leg == n || medium_of_leg(a, leg + 1) == own))
    return false;  // in one medium places lift off
  if (leg == 0 || leg == n) {
    // At an end another label begins or ends in the medium behind.
    const std::size_t i = leg == 0 ? 0 : n - 1;
    if (norm(s.corner(leg + 1) - s.corner(leg)) > unmoved) return false;
    const Place& p = *s.places[i];
    const std::size_t next = leg == 0 ? 1 : n - 1;
    const Point d = unit(s.corner(next + 1) - s.corner(next));
    const double tangent = s.slow(next) * std::hypot(dot(d, p.along), dot(d, p.wide));
    if (tangent <= s.slow(leg) * (1 + 1e-9) || a.splits++ > 2) useless = true;
    return false;
  }
  const std::size_t i = leg - 1;
  const Index before = medium_of_leg(a, i), after = medium_of_leg(a, leg + 1);
  const Point at = s.points[i], in = unit(s.corner(i + 1) - s.corner(i)),
              out = unit(s.corner(leg + 2) - s.corner(leg + 1));
  if (norm(in) == 0 || norm(out) == 0) return false;
  if (space_->kind(place_of(a, i)) == Kind::bend && space_->kind(place_of(a, leg)) == Kind::bend)
    return false;
  const std::array<Index, 2> both = {a.doors[i], a.doors[leg]};
  if (before == after) {
    if (gains(in, out, both, before, at, none) && a.splits++ < 3) {
      move_apart(a, i, at);
      return true;
    }
    replace(a, i, leg + 1, {}, at);
    return true;
  }
  // The place where both are.
  std::vector<Index> found;
  const auto is_at = [&](Index row) {
    const Place& p = space_->place(row);
    const double t = std::clamp(dot(at - p.origin, p.along), p.low, p.high);
    return norm(at - p.at(t)) < 1e-4;
  };
  const Index q[2] = {place_of(a, i), place_of(a, leg)};
  const auto consider = [&](Index p) {
    const Index door = space_->door(p, after);
    if (door != none && space_->door(p, before) != none) found.push_back(door);
  };
  if (q[0] == q[1]) {
    if (gains(in, out, both, before, at, none) && a.splits++ < 3) {
      move_apart(a, i, at);
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
  replace(a, i, leg + 1, std::array{found[0]}, at);
  return true;
}

// A crossing off its patch slides on to the row there.
bool MediaSolver::leave_patch(Attempt& a, std::size_t i) {
  const Index q = place_of(a, i);
  const auto& patch = space_->patch(q);
  String& s = a.string;
  if (space_->holds(patch, s.at[i], s.wide[i], outside)) return false;
  const Place& plane = *s.places[i];
  const Point d = a.legs[i].to - plane.origin;
  Spot from = {dot(d, plane.along), dot(d, plane.wide)};
  const Index row = space_->leaves(patch, from, {s.at[i], s.wide[i]});
  const Index door = row == none ? none : space_->door(row, space_->medium_behind(a.doors[i]));
  if (door == none) return false;
  replace(a, i, i + 1, std::array{door}, s.points[i]);
  return true;
}

bool MediaSolver::lift_off_row(Attempt& a, std::size_t i) {
  String& s = a.string;
  const Index row = place_of(a, i), before = medium_of_leg(a, i), after = medium_of_leg(a, i + 1);
  const Point at = s.points[i], in = unit(at - s.corner(i)), out = unit(s.corner(i + 2) - at);
  if (norm(in) == 0 || norm(out) == 0) return false;
  const Point force = s.slow(i + 1) * out - s.slow(i) * in;
  const double least = gain * (s.slow(i) + s.slow(i + 1));
  if (before == after) {
    replace(a, i, i + 1, {}, at);
    return true;
  }
  const Place& line = *s.places[i];
  const auto& ends = space_->ends(row);
  const bool low = s.at[i] <= line.low + unmoved, high = s.at[i] >= line.high - unmoved;
  if ((low && dot(force, line.along) < -least) || (high && dot(force, line.along) > least)) {
    const Index door = space_->door(space_->corner(ends[low ? 0 : 1]), after);
    if (door == none) return false;
    replace(a, i, i + 1, std::array{door}, at);
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
  replace(a, i, i + 1, std::array{best}, at);
  return true;
}

bool MediaSolver::lift_off_corner(Attempt& a, std::size_t i) {
  String& s = a.string;
  const Index corner = place_of(a, i), before = medium_of_leg(a, i),
              after = medium_of_leg(a, i + 1);
  const Point at = s.points[i], in = unit(at - s.corner(i)), out = unit(s.corner(i + 2) - at);
  if (norm(in) == 0 || norm(out) == 0) return false;
  if (before == after) return false;
  const Point force = s.slow(i + 1) * out - s.slow(i) * in;
  double most = gain * (s.slow(i) + s.slow(i + 1));
  Index best = none;
  const Index point = space_->point_of_corner(corner);
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
  replace(a, i, i + 1, std::array{best}, at);
  return true;
}

// Where a leg leads from a bend.
Point MediaSolver::toward(const Attempt& a, std::size_t corner, std::size_t other, Index to) const {
  const auto row = a.string.row_from(corner, other);
  return row ? *row : end_of_leg(a, other, corner, to) - a.string.corner(corner);
}

bool MediaSolver::drop_lifted(Attempt& a, std::size_t i, Index to) {
  const Place& p = *a.string.places[i];
  if (p.holds()) return false;
  const Point& at = a.string.points[i];
  const Leg &in = a.legs[i], &out = a.legs[i + 1];
  const double from = p.angle_of(toward(a, i + 1, i, to), in.from - in.to),
               on = p.angle_of(toward(a, i + 1, i + 2, to), out.to - out.from);
  if (p.presses(from, on)) return false;
  const Point beside = end_of_leg(a, i + 1, i, to);
  replace(a, i, i + 1, {}, at);
  a.legs[i].to = beside;
  return true;
}

// Are the places right for the string as it is? One that is not is changed.
bool MediaSolver::rearrange(Attempt& a, Index to, bool& useless) {
  for (std::size_t leg = a.doors.size() + 1; leg-- > a.string.held;) {
    if (a.doors.empty()) break;
    if (norm(a.string.corner(leg + 1) - a.string.corner(leg)) > brief) continue;
    if (leg > a.doors.size()) continue;
    if (collapse(a, leg, useless)) return true;
    if (useless) return false;
  }
  for (std::size_t i = a.doors.size(); i-- > a.string.held;) {
    switch (space_->kind(place_of(a, i))) {
      case Kind::bend:
        if (drop_lifted(a, i, to)) return true;
        break;
      case Kind::patch:
        if (leave_patch(a, i)) return true;
        break;
      case Kind::row:
        if (lift_off_row(a, i)) return true;
        break;
      case Kind::corner:
        if (lift_off_corner(a, i)) return true;
        break;
    }
  }
  return false;
}

bool MediaSolver::is_edge(const Attempt& a) const {
  const Index m = medium_of_leg(a, a.doors.size());
  const Index p = point_of(from_);
  if (a.doors.empty()) return roots_[a.root].node == from_;
  return a.string.places.back()->vertex == p && space_->node(p, m) != none;
}

std::size_t MediaSolver::blocked(const Attempt& a, Index to) {
  const auto moved = [](const Point& p, const Point& q) {
    const Point d = p - q;
    return dot(d, d) > unmoved * unmoved;
  };
  for (std::size_t i = a.legs.size(); i-- > a.string.held;) {
    const auto& medium = space_->media()[medium_of_leg(a, i)];
    if (!medium.room) continue;
    if (i + 1 == a.legs.size() && is_edge(a)) continue;
    const Point from = end_of_leg(a, i, i + 1, to), end = end_of_leg(a, i + 1, i, to);
    const Leg& leg = a.legs[i];
    if (leg.known && !moved(from, leg.from) && !moved(end, leg.to)) continue;
    if (medium.room->sight().is_blocked(from, end)) return i;
  }
  return a.legs.size();
}

bool MediaSolver::insert_touched(Attempt& a, std::size_t n, Index to) {
  const Leg leg = a.legs[n];
  const Index m = medium_of_leg(a, n);
  const auto& medium = space_->media()[m];
  const Point from = end_of_leg(a, n, n + 1, to), end = end_of_leg(a, n + 1, n, to);
  const auto own = [&](std::size_t i) {
    const Index p = place_of(a, i);
    if (space_->kind(p) != Kind::bend || p < medium.first_bend) return none;
    return p - medium.first_bend;
  };
  const std::array<Index, 2> known = {n > 0 ? own(n - 1) : none,
                                      n < a.doors.size() ? own(n) : none};
  const bool backward = norm(leg.from - from) > norm(leg.to - end);
  const auto touch = backward ? medium.room->sight().touch(end, from, leg.from, known)
                              : medium.room->sight().touch(from, end, leg.to, known);
  if (!touch) return false;
  a.touched = true;
  const Index number = medium.first_bend + touch->place;
  const Place* place = this->place(number);
  const Point at = place->at(touch->at), beside = place->beside(touch->at, space_->aside());
  replace(a, n, n, std::array{space_->first_door(number)}, at);
  a.legs[n] = {leg.from, beside, false};
  a.legs[n + 1] = {beside, leg.to, false};
  return true;
}

MediaSolver::Outcome MediaSolver::settle(Attempt& a, Index to, double least) {
  constexpr int most = 48;
  constexpr std::size_t loose = 3;
  String& string = a.string;
  const auto hold = [&] { string.hold(std::max(string.bends(), loose) - loose); };
  hold();
  bool useless = false;
  for (int round = 0; round < most; ++round) {
    puller_.pull(string);
    if (rearrange(a, to, useless)) {
      if (string.held > 0 && string.bends() < string.held + 2) hold();
      continue;
    }
    if (useless) return Outcome::longer;
    const double length = offset(a) + string.length;
    if (!(string.length < least) || !(length < direct_) ||
        !(length * (1 + 1e-12) < limit(to, last_leg(a)))) {
      if (string.held == 0) return Outcome::longer;
      string.hold(0);  // what is held may gain
      continue;
    }
    const std::size_t leg = blocked(a, to);
    if (leg < a.legs.size()) {
      if (!insert_touched(a, leg, to)) break;
    } else if (string.held == 0) {
      return Outcome::free;
    } else {
      string.hold(0);
    }
  }
  string.hold(0);
  puller_.pull(string);
  return Outcome::stuck;
}

// Where a string is held at a vertex of the medium, the places of the shortest way around it
// instead. `i` is then beyond the end, to look again; else the first of the places there.
bool MediaSolver::past_corner(Attempt& a, Index to, Outcome& outcome, std::size_t& i) {
  const Index m = medium_of_leg(a, i);
  const auto& medium = space_->media()[m];
  const Place& place = *a.string.places[i];
  Index vertex = none;
  if (space_->kind(place_of(a, i)) == Kind::corner)
    vertex = medium.in_room(space_->node(place.vertex, m));
  else if (a.string.at[i] < place.low + unmoved)
    vertex = place.end[0];
  else if (a.string.at[i] > place.high - unmoved)
    vertex = place.end[1];
  if (vertex == none) return false;
  const Point& at = medium.room->point(vertex);
  const auto is_there = [&](std::size_t n) {
    return medium_of_leg(a, n) == m && medium_of_leg(a, n + 1) == m &&
           norm(a.string.points[n] - at) < unmoved;
  };
  std::size_t begin = i, end = i + 1;
  while (begin > 0 && is_there(begin - 1)) --begin;
  while (end < a.doors.size() && is_there(end)) ++end;
  const Point in = a.string.corner(begin) - at, out = a.string.corner(end + 1) - at;
  if (!corner_.find(*medium.room, vertex, in, out)) return false;
  const double least = outcome == Outcome::free ? a.string.length * (1 - 1e-12) : unreached,
               reach = std::min(norm(in), norm(out));
  const Point beside = end_of_leg(a, begin + 1, begin, to);
  std::vector<Index> doors;
  do {
    const auto rows = corner_.rows();
    const double half = corner_.turned() / 2;
    doors.clear();
    for (const Corner::Row& row : rows)
      doors.push_back(space_->first_door(medium.first_bend + row.place));
    other_ = a;
    other_.splits = 0;
    replace(other_, begin, end, doors, at);
    for (std::size_t n = 0; n < rows.size(); ++n) {
      const Place& p = *other_.string.places[begin + n];
      // Unfolded, a straight line across the sectors.
      const Point on =
          at + reach * std::cos(half) / std::cos(rows[n].turned - half) * rows[n].along;
      const double t = dot(on - p.origin, p.along);
      other_.string.at[begin + n] = t;
      other_.string.points[begin + n] = on;
      other_.legs[begin + n].to = other_.legs[begin + n + 1].from =
          p.holds() ? on : p.beside(t, space_->aside());
    }
    other_.legs[begin + rows.size()].to = beside;
    if (settle(other_, to, least) == Outcome::free) {
      std::swap(a, other_);
      outcome = Outcome::free;
      i = a.doors.size();
      return true;
    }
  } while (!corner_.rows().empty() && corner_.find_other(*medium.room));
  return false;
}

// A string held at the end of a place may be shorter past it, one at a row or a corner through
// another medium there.
MediaSolver::Outcome MediaSolver::improve(Attempt& a, Index to, Outcome outcome) {
  const auto tries = [&](std::size_t i, std::span<const Index> doors) {
    other_ = a;
    other_.splits = 0;
    replace(other_, i, i + 1, doors, a.string.points[i]);
    if (doors.size() > 1) move_apart(other_, i, a.string.points[i]);
    const double less = outcome == Outcome::free ? a.string.length * (1 - 1e-12) : unreached;
    if (settle(other_, to, less) != Outcome::free) return false;
    std::swap(a, other_);
    outcome = Outcome::free;
    return true;
  };
  for (std::size_t i = a.doors.size(); i-- > 0;) {
    if (i >= a.doors.size()) continue;
    const Index q = place_of(a, i);
    const Kind kind = space_->kind(q);
    const Index before = medium_of_leg(a, i), after = medium_of_leg(a, i + 1);
    if (before == after && space_->media()[before].is_solid) {
      if (past_corner(a, to, outcome, i)) continue;
    } else if (before == after && is_held(a.string, i) && tries(i, {})) {
      continue;
    }
    if (kind != Kind::row && kind != Kind::corner) continue;
    const Point at = a.string.points[i], in = unit(at - a.string.corner(i)),
                out = unit(a.string.corner(i + 2) - at);
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
    const auto through = [&] {
      for (const Index one : places)
        for (const Index two : places) {
          if (space_->door(one, before) == none) continue;
          const Index last = space_->door(two, after);
          if (last == none) continue;
          for (Index d = space_->first_door(one); d < space_->last_door(one); ++d) {
            const Index m = space_->medium_behind(d);
            if (m == before || m == after || space_->door(two, m) == none) continue;
            const std::array<Index, 2> doors = {d, last};
            if (gains(in, out, doors, before, at, kind == Kind::row ? q : none) && tries(i, doors))
              return true;
          }
        }
      return false;
    };
    through();
  }
  return outcome;
}

}  // namespace plexway::strings
