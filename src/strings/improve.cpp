#include <algorithm>
#include <cmath>

#include "strings/extender.hpp"

namespace plexway::detail::strings {

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
