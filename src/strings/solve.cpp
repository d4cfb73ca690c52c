#include "strings/solve.hpp"

#include <algorithm>
#include <cmath>

namespace plexway::strings {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double still = 1e-9;  // an end that moved less did not move
constexpr double rounding = 1e-9;

}  // namespace

void Solver::clear() {
  sources_.clear();
  counts_ = {};
  chains_.clear();
  hints_.clear();
  if (vertices_.empty()) vertices_.resize(space_->vertices() + 1);
  for (const Index v : reached_) vertices_[v] = {};
  reached_.clear();
}

bool Solver::add(std::span<const Source> sources, const Limits& limits) {
  const std::size_t before = counts_.expansions, first = sources_.size();
  sources_.insert(sources_.end(), sources.begin(), sources.end());
  queue_.clear();
  prepared_ = false;
  for (std::size_t n = first; n < sources_.size(); ++n) seed(static_cast<Index>(n));
  while (!queue_.empty()) {
    std::pop_heap(queue_.begin(), queue_.end());
    const Offer next = queue_.back();
    queue_.pop_back();
    if (next.distance > limits.radius) break;
    const Label* found = vertices_[next.vertex].find(next.chain, next.distance);
    if (found == nullptr) continue;
    const std::size_t expansions = counts_.expansions - before;
    if (expansions >= limits.expansions) return false;
    if (limits.progress && expansions % 1024 == 0) limits.progress(expansions, next.distance);
    ++counts_.expansions;
    expand(next.vertex, Label(*found));
  }
  return true;
}

void Solver::seed(Index number) {
  const Source& source = sources_[number];
  const Index chain = chains_.root(number);
  if (source.vertex != none) {
    take(source.vertex, {source.offset, chain, {0, 0, 0}});
    return;
  }
  for (const Index v : source.corners) {
    const Point leg = space_->point(v) - source.at;
    take(v, {source.offset + norm(leg), chain, unit(leg)});
  }
}

void Solver::take(Index vertex, const Label& label) {
  const bool first = vertices_[vertex].best().chain == none;
  if (!vertices_[vertex].take(label, behind_)) return;
  if (first && vertex != space_->vertices()) reached_.push_back(vertex);
  ++counts_.labels;
  queue_.push_back({label.distance, vertex, label.chain});
  std::push_heap(queue_.begin(), queue_.end());
}

void Solver::expand(Index vertex, const Label& label) {
  prepared_ = false;
  from_ = vertex;
  for (const Index w : space_->neighbours(vertex)) offer(vertex, label, w);
}

// The string to the vertex itself, whose legs are free.
void Solver::prepare(Index vertex, const Label& label) {
  if (prepared_ && base_vertex_ == vertex && base_chain_ == label.chain) return;
  prepared_ = true;
  base_vertex_ = vertex;
  base_chain_ = label.chain;
  Attempt& a = base_;
  chains_.places(label.chain, a.places);
  const Source& source = sources_[chains_.source(label.chain)];
  a.source = chains_.source(label.chain);
  a.string.from = source.at;
  a.string.to = point(vertex);
  a.string.places.clear();
  a.string.at.resize(a.places.size());
  Index chain = label.chain;
  for (std::size_t i = a.places.size(); i-- > 0; chain = chains_[chain].parent)
    a.string.at[i] = hints_[chain];
  for (const Index p : a.places) a.string.places.push_back(place(p));
  a.string.hold(0);
  puller_.pull(a.string);
  // Pulled from elsewhere it is the same; else its legs are not known.
  const bool same =
      std::abs(source.offset + a.string.length - label.distance) < rounding * (1 + label.distance);
  a.legs.clear();
  for (std::size_t i = 0; i <= a.places.size(); ++i)
    a.legs.push_back({a.string.corner(i), a.string.corner(i + 1), true});
  for (std::size_t i = 0; i <= a.places.size(); ++i)
    a.legs[i] = {end_of_leg(a, i, i + 1, vertex), end_of_leg(a, i + 1, i, vertex), same};
}

void Solver::offer(Index from, const Label& label, Index to) {
  VertexLabels& at = vertices_[to];
  if (at.knows(label.chain)) return;
  // The length of a chain is convex in where it ends.
  const Point way = point(to) - point(from);
  if (label.distance + dot(label.last, way) >= at.limit(behind_, label.last)) return;
  direct_ = (label.distance + norm(way)) * (1 + rounding);
  const Outcome outcome = attempt(from, label, to);
  if (outcome == Outcome::free) accept(attempt_, to);
  // Where it was blocked it may come past on another side from another vertex.
  if (outcome != Outcome::stuck && !attempt_.touched && at.best().chain != none)
    at.remember(label.chain);
  if (outcome != Outcome::stuck &&
      sources_[attempt_.source].offset + attempt_.string.length < direct_)
    return;
  if (attempt_corner(from, label, to) == Outcome::free) accept(attempt_, to);
}

// A vertex' string, pulled to another one.
Solver::Outcome Solver::attempt(Index from, const Label& label, Index to) {
  prepare(from, label);
  attempt_ = base_;
  attempt_.touched = false;
  attempt_.string.to = point(to);
  const Outcome outcome = settle(attempt_, to, infinity);
  return outcome == Outcome::longer ? outcome : past_corners(attempt_, to, outcome);
}

// On from the vertex itself along the edge, and what is shorter past it.
Solver::Outcome Solver::attempt_corner(Index from, const Label& label, Index to) {
  prepare(from, label);
  attempt_ = base_;
  attempt_.string.to = point(to);
  const Point& at = space_->point(from);
  insert(attempt_, attempt_.places.size(), static_cast<Index>(space_->places().size()) + from, at,
         at);
  const Outcome outcome = settle(attempt_, to, infinity);
  return past_corners(attempt_, to, outcome);
}

const Place* Solver::place(Index number) {
  if (number < space_->places().size()) return &space_->places()[number];
  const Index vertex = number - static_cast<Index>(space_->places().size());
  const Point zero = {0, 0, 0};
  return &corners_
              .try_emplace(vertex,
                           Place{space_->point(vertex), zero, 0, 0, zero, zero, zero, 0, vertex})
              .first->second;
}

// Where a leg between two corners of a string ends, off the boundary.
Point Solver::end_of_leg(const Attempt& a, std::size_t corner, std::size_t other, Index to) const {
  const Point &toward = a.string.corner(other),
              &free = other > corner ? a.legs[corner].to : a.legs[other].from;
  // The new end is seen from where the old one was: an edge of the mesh is between.
  if (corner > a.places.size())
    return to == space_->vertices() ? attached_beside_
                                    : space_->beside(to, toward, a.legs.back().to);
  if (corner == 0) {
    const Source& source = sources_[a.source];
    return source.vertex != none ? space_->beside(source.vertex, toward, free) : source.beside;
  }
  const Place& place = *a.string.places[corner - 1];
  if (place.vertex != none) return space_->beside(place.vertex, toward, free);
  const double t = a.string.at[corner - 1];
  if (place.holds()) return space_->beside(place, t, toward, free);
  return place.beside(t, space_->aside());
}

// Where a leg leads from a bend.
Point Solver::toward(const Attempt& a, std::size_t corner, std::size_t other, Index to) const {
  const auto row = a.string.row_from(corner, other);
  return row ? *row : end_of_leg(a, other, corner, to) - a.string.corner(corner);
}

bool Solver::drop_lifted(Attempt& a, Index to) {
  for (std::size_t i = a.places.size(); i-- > a.string.held;) {
    const Place& place = *a.string.places[i];
    if (place.holds()) continue;
    const Leg &in = a.legs[i], &out = a.legs[i + 1];
    const double from = place.angle_of(toward(a, i + 1, i, to), in.from - in.to),
                 on = place.angle_of(toward(a, i + 1, i + 2, to), out.to - out.from);
    if (place.presses(from, on)) continue;
    drop(a, i, end_of_leg(a, i + 1, i, to));
    return true;
  }
  return false;
}

// Without a place; the leg that is left was free to there.
void Solver::drop(Attempt& a, std::size_t n, const Point& beside) {
  const auto at = static_cast<std::ptrdiff_t>(n);
  a.legs[n] = {a.legs[n].from, beside, false};
  a.legs.erase(a.legs.begin() + at + 1);
  a.places.erase(a.places.begin() + at);
  a.string.places.erase(a.string.places.begin() + at);
  a.string.at.erase(a.string.at.begin() + at);
  a.string.points.erase(a.string.points.begin() + at);
}

// Is the last leg an edge of the mesh?
bool Solver::is_edge(const Attempt& a) const {
  return (a.places.empty() ? sources_[a.source].vertex : a.string.places.back()->vertex) == from_;
}

// The last leg that leaves the solid; as many as there are legs: none does.
std::size_t Solver::blocked(const Attempt& a, Index to) {
  const auto moved = [](const Point& p, const Point& q) {
    const Point d = p - q;
    return dot(d, d) > still * still;
  };
  for (std::size_t i = a.legs.size(); i-- > a.string.held;) {
    if (i + 1 == a.legs.size() && is_edge(a)) continue;
    const Point from = end_of_leg(a, i, i + 1, to), end = end_of_leg(a, i + 1, i, to);
    const Leg& leg = a.legs[i];
    if (leg.known && !moved(from, leg.from) && !moved(end, leg.to)) continue;
    if (space_->sight().is_blocked(from, end)) return i;
  }
  return a.legs.size();
}

bool Solver::insert_touched(Attempt& a, std::size_t n, Index to) {
  const Leg leg = a.legs[n];
  const Point from = end_of_leg(a, n, n + 1, to), end = end_of_leg(a, n + 1, n, to);
  const std::array<Index, 2> known = {n > 0 ? a.places[n - 1] : none,
                                      n < a.places.size() ? a.places[n] : none};
  // It turns about the end that moved less.
  const bool backward = norm(leg.from - from) > norm(leg.to - end);
  const auto touch = backward ? space_->sight().touch(end, from, leg.from, known)
                              : space_->sight().touch(from, end, leg.to, known);
  if (!touch) return false;
  a.touched = true;
  const Place* place = this->place(touch->place);
  insert(a, n, touch->place, place->at(touch->at), place->beside(touch->at, space_->aside()));
  return true;
}

// One more place, `at` or near to a point.
void Solver::insert(Attempt& a, std::size_t n, Index number, const Point& at, const Point& beside) {
  const Place* place = this->place(number);
  const auto before = static_cast<std::ptrdiff_t>(n);
  const Leg leg = a.legs[n];
  a.legs[n] = {leg.from, beside, false};
  a.legs.insert(a.legs.begin() + before + 1, {beside, leg.to, false});
  a.places.insert(a.places.begin() + before, number);
  a.string.places.insert(a.string.places.begin() + before, place);
  a.string.at.insert(a.string.at.begin() + before, dot(at - place->origin, place->along));
  a.string.points.insert(a.string.points.begin() + before, at);
}

// Pulled, places dropped and put in until all legs are free; no further if it is of no use, or
// as long as `least`. Of a long string its end first, the rest held as it is.
Solver::Outcome Solver::settle(Attempt& a, Index to, double least) {
  constexpr int most = 32;
  constexpr std::size_t loose = 3;
  String& string = a.string;
  const auto hold = [&] { string.hold(std::max(string.bends(), loose) - loose); };
  const double offset = sources_[a.source].offset;
  hold();
  for (int round = 0; round < most; ++round) {
    puller_.pull(string);
    if (drop_lifted(a, to)) {
      if (string.held > 0 && string.bends() < string.held + 2) hold();
      continue;
    }
    // What is held may gain a little.
    const double gain = string.held > 0 ? 1e-3 : 0;
    const double length = offset + string.length - gain;
    if (!(string.length < least) || !(length < direct_) ||
        !(length < vertices_[to].limit(behind_, last_leg(a))))
      return Outcome::longer;
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

// Where a string is held at the end of a row it may be shorter past the vertex there.
Solver::Outcome Solver::past_corners(Attempt& a, Index to, Outcome outcome) {
  const auto vertex_of = [&](std::size_t i) {
    const Place& p = *a.string.places[i];
    if (p.vertex != none) return p.vertex;
    return a.string.at[i] < p.low + still    ? p.end[0]
           : a.string.at[i] > p.high - still ? p.end[1]
                                             : none;
  };
  for (std::size_t i = a.places.size(); i-- > 0;) {
    if (i >= a.places.size()) continue;
    const Index corner = vertex_of(i);
    if (corner == none) continue;
    const auto is_there = [&](std::size_t n) {
      return norm(a.string.points[n] - space_->point(corner)) < still;
    };
    std::size_t begin = i, end = i + 1;
    while (begin > 0 && is_there(begin - 1)) --begin;
    while (end < a.places.size() && is_there(end)) ++end;
    // Shorter now: from the end again.
    i = past_corner(a, to, outcome, begin, end, corner) ? a.places.size() : begin;
  }
  return outcome;
}

// The places from `begin` to `end` are all at one vertex: those of the shortest way around it
// instead.
bool Solver::past_corner(Attempt& a, Index to, Outcome& outcome, std::size_t begin, std::size_t end,
                         Index vertex) {
  const Point &at = space_->point(vertex), in = a.string.corner(begin) - at,
              out = a.string.corner(end + 1) - at;
  if (!corner_.find(*space_, vertex, in, out)) return false;
  const double least = outcome == Outcome::free ? a.string.length * (1 - 1e-12) : infinity,
               reach = std::min(norm(in), norm(out));
  const Point beside = end_of_leg(a, begin + 1, begin, to);
  do {
    const double half = corner_.turned() / 2;
    other_ = a;
    for (std::size_t n = end; n-- > begin;) drop(other_, n, beside);
    for (std::size_t n = 0; n < corner_.rows().size(); ++n) {
      const Corner::Row& row = corner_.rows()[n];
      const Place& p = *place(row.place);
      // Unfolded, a straight line across the sectors.
      const Point on = at + reach * std::cos(half) / std::cos(row.turned - half) * row.along;
      insert(other_, begin + n, row.place, on,
             p.holds() ? on : p.beside(dot(on - p.origin, p.along), space_->aside()));
    }
    if (settle(other_, to, least) == Outcome::free) {
      std::swap(a, other_);
      outcome = Outcome::free;
      return true;
    }
  } while (!corner_.rows().empty() && corner_.find_other(*space_));
  return false;
}

void Solver::accept(const Attempt& a, Index to) {
  Index chain = chains_.root(a.source);
  for (std::size_t i = 0; i < a.places.size(); ++i) {
    chain = chains_.with(chain, a.places[i]);
    hints_.resize(chains_.size(), 0);
    hints_[chain] = a.string.at[i];
  }
  vertices_[to].remember(chain);
  take(to, {sources_[a.source].offset + a.string.length, chain, last_leg(a)});
}

void Solver::attach(const Point& at, const std::array<Index, 4>& corners,
                    std::span<const Index> sources) {
  const auto number = static_cast<Index>(space_->vertices());
  Point middle = {0, 0, 0};
  for (const Index v : corners) middle = middle + .25 * space_->point(v);
  attached_ = at;
  attached_beside_ = at + space_->aside() * unit(middle - at);
  vertices_[number] = {};
  for (const Index n : sources) {
    const Point leg = at - sources_[n].at;
    take(number, {sources_[n].offset + norm(leg), chains_.root(n), unit(leg)});
  }
  for (const Index v : corners) {
    from_ = v;
    for (const Label& label : VertexLabels(vertices_[v]).labels) {
      if (label.chain != none) offer(v, label, number);
    }
  }
  queue_.clear();
}

double Solver::moved(Index vertex, const Label& label, const Point& at, const Point& beside) {
  const Source& root = sources_[source_of(label)];
  if (chains_.is_root(label.chain)) {
    const Point from =
        root.vertex == none ? root.beside : space_->beside(root.vertex, at, point(vertex));
    if (!space_->sight().is_blocked(from, beside)) return root.offset + norm(at - root.at);
  }
  const auto number = static_cast<Index>(space_->vertices());
  vertices_[number] = {};
  attached_ = at;
  attached_beside_ = beside;
  direct_ = infinity;
  from_ = vertex;
  const bool free = attempt(vertex, label, number) == Outcome::free ||
                    attempt_corner(vertex, label, number) == Outcome::free;
  return free ? root.offset + attempt_.string.length : infinity;
}

std::vector<Point> Solver::path(Index vertex) {
  const Label label = vertices_[vertex].best();
  if (label.chain == none) return {};
  prepared_ = false;
  prepare(vertex, label);
  std::vector<Point> points;
  for (std::size_t n = 0; n < base_.places.size() + 2; ++n)
    points.push_back(base_.string.corner(n));
  return points;
}

std::size_t Solver::bytes() const {
  return chains_.bytes() + hints_.capacity() * sizeof(double) +
         vertices_.capacity() * sizeof(VertexLabels) + reached_.capacity() * sizeof(Index) +
         queue_.capacity() * sizeof(Offer);
}

}  // namespace plexway::strings
