#include <algorithm>
#include <cmath>

#include "strings/extender.hpp"

namespace plexway::detail::strings {

Point Extender::end_of_leg(const Attempt& a, std::size_t k, std::size_t other, Index to) const {
  const auto& knots = a.string.knots;
  const Knot &knot = knots[k], &behind = knots[std::min(k, other)];
  const auto& medium = space_->media()[behind.medium];
  if (!medium.room) return knot.at;
  const Point &toward = knots[other].at, &free = other > k ? behind.leg.to : behind.leg.from;
  if (k + 1 == knots.size())
    return to == space_->nodes() ? state_->attached_beside
                                 : medium.room->beside(medium.in_room(to), toward, behind.leg.to);
  if (knot.place == nullptr) {
    const State::Root& root = state_->roots[a.root];
    return root.node != none ? medium.room->beside(medium.in_room(root.node), toward, free)
                             : root.beside;
  }
  const Index q = place_of(knot);
  if (space_->kind(q) != Kind::patch)
    return space_->beside(q, behind.medium, knot.at, toward, free);
  // On one side of a crack through the plane, for both legs.
  const Point side = knot.at + (knots[k - 1].leg.from - knot.at) + (knot.leg.to - knot.at);
  return space_->beside(q, behind.medium, knot.at, toward, side);
}

// At or near to a point.
Knot Extender::knot(Index door, const Point& at) {
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
void Extender::append(Attempt& a, Index door, const Point& toward) {
  auto& knots = a.string.knots;
  const Point& from = at(from_);
  Knot last = knot(door, .5 * (from + toward));
  // From where it is free: in that medium beside the point, which tells the side of a crack.
  const Index n = space_->node(state_->point_of(from_), last.medium);
  const auto& medium = space_->media()[last.medium];
  const Point beside =
      medium.room && n != none ? medium.room->beside(medium.in_room(n), toward, toward) : from;
  last.leg = {beside, beside, false};
  knots.insert(knots.end() - 1, last);
}

// Instead of the places of some knots others, at a point.
void Extender::replace(Attempt& a, std::size_t begin, std::size_t end, std::span<const Index> doors,
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
  first.known = false;
  if (doors.empty()) return;
  first.to = at;
  knots[begin + doors.size() - 1].leg.to = to;
}

// The string of the node that offers, to another end.
void Extender::start(Index to) {
  attempt_.string.knots = base_.string.knots;
  attempt_.string.knots.back().at = at(to);
  attempt_.root = base_.root;
  attempt_.touched = false;
  attempt_.splits = 0;
}

bool Extender::is_edge(const Attempt& a) const {
  const Knot& knot = a.string.knots[a.string.bends()];
  if (knot.place == nullptr) return state_->roots[a.root].node == from_;
  const Index p = state_->point_of(from_);
  return knot.place->vertex == p && space_->node(p, knot.medium) != none;
}

// The last leg that leaves its medium; as many as there are legs: none does.
std::size_t Extender::blocked(const Attempt& a, Index to) {
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
    if (k > 0 && k + 1 < legs && kind(knots[k]) == Kind::bend && kind(knots[k + 1]) == Kind::bend &&
        medium.room->are_on_face(place_of(knots[k]) - medium.first_bend, knots[k].at,
                                 place_of(knots[k + 1]) - medium.first_bend, knots[k + 1].at))
      continue;
    const Point from = end_of_leg(a, k, k + 1, to), end = end_of_leg(a, k + 1, k, to);
    const Leg& leg = knots[k].leg;
    if (leg.known && !moved(from, leg.from) && !moved(end, leg.to)) continue;
    if (medium.room->sight().is_blocked(from, end)) return k;
  }
  return legs;
}

bool Extender::insert_touched(Attempt& a, std::size_t k, Index to) {
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

// Pulled, places dropped and put in until all legs are free; no further if it is of no use, or
// as long as `least`.
Extender::Outcome Extender::settle(Attempt& a, Index to, double least) {
  constexpr int most = 48;
  bool useless = false;
  for (int round = 0; round < most; ++round) {
    puller_.pull(a.string);
    if (rearrange(a, to, useless)) continue;
    const double found = length(a);
    if (useless ||
        !(found < least + offset(a) && found < direct_ &&
          found * (1 + 1e-12) < state_->limit(to, source_of(a), media_of(a), last_leg(a), found)))
      return Outcome::longer;
    const std::size_t leg = blocked(a, to);
    if (leg + 1 == a.string.knots.size()) return Outcome::free;
    if (!insert_touched(a, leg, to)) break;
  }
  puller_.pull(a.string);
  return Outcome::stuck;
}

// Where a string is held at a vertex it may be shorter past it.
void Extender::past_corners(Attempt& a, Index to, Outcome& outcome) {
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
Index Extender::vertex_of(const Attempt& a, std::size_t k) const {
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
bool Extender::past_corner(Attempt& a, Index to, Outcome& outcome, std::size_t begin,
                           std::size_t end, Index vertex) {
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
bool Extender::instead(Attempt& a, Index to, Outcome& outcome, std::size_t k,
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
void Extender::past_media(Attempt& a, Index to, Outcome& outcome) {
  for (std::size_t k = a.string.bends(); k > 0; --k) {
    if (k > a.string.bends()) continue;
    const Knot& knot = a.string.knots[k];
    const Index q = place_of(knot), before = a.string.knots[k - 1].medium;
    if (before == knot.medium && !space_->media()[before].is_solid && is_held(a.string, k) &&
        instead(a, to, outcome, k, {}))
      continue;
    if (space_->kind(q) == Kind::row) {
      const auto patches = space_->patches_at(q);
      places_.assign(patches.begin(), patches.end());
      places_.push_back(q);
    } else if (space_->kind(q) == Kind::corner) {
      const auto all = space_->places_at(space_->point_of_corner(q));
      places_.assign(all.begin(), all.end());
    } else {
      continue;
    }
    past_row(a, to, outcome, k);
  }
}

// The same by two doors of `places_`, through a medium that a knot does not touch.
void Extender::past_row(Attempt& a, Index to, Outcome& outcome, std::size_t k) {
  const Index before = a.string.knots[k - 1].medium, after = a.string.knots[k].medium;
  const Index q = place_of(a.string.knots[k]), row = space_->kind(q) == Kind::row ? q : none;
  const Point at = a.string.at(k), in = a.string.direction(k - 1), out = a.string.direction(k);
  if (norm(in) == 0 || norm(out) == 0) return;
  for (const Index one : places_)
    for (const Index two : places_) {
      if (space_->door(one, before) == none) continue;
      const Index last = space_->door(two, after);
      if (last == none) continue;
      for (Index d = space_->first_door(one); d < space_->last_door(one); ++d) {
        const Index m = space_->medium_behind(d);
        if (m == before || m == after || space_->door(two, m) == none) continue;
        const std::array<Index, 2> doors = {d, last};
        if (gains(in, out, doors, before, at, row) && instead(a, to, outcome, k, doors)) return;
      }
    }
}

// What is shorter past where a string is held.
Extender::Outcome Extender::improve(Attempt& a, Index to, Outcome outcome) {
  past_corners(a, to, outcome);
  if (!plain_) past_media(a, to, outcome);
  return outcome;
}

}  // namespace plexway::detail::strings
