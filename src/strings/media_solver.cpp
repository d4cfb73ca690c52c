#include "strings/media_solver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plexway::strings {

MediaSolver::MediaSolver(const MediaSpace& space)
    : space_(&space),
      // Others may have come through other media.
      other_side_(space.media().size() == 1 ? VertexLabels::same_side : 1 - 1e-10) {
  reach_.assign(space.nodes() + 1, unreached);
  for (Index n = 0; n < space.nodes(); ++n) {
    const Index p = space.point_of(n), m = space.medium_of(n);
    if (space.nodes_at(p).size() < 2) continue;
    double longest = 0;
    for (const Index w : space.neighbours(n)) {
      const Index q = space.media()[m].points[w];
      longest = std::max(longest, norm(space.point(q) - space.point(p)));
    }
    reach_[n] = longest * slowness(m);
  }
}

bool MediaSolver::solve(std::span<const MediaSource> sources, const Limits& limits) {
  sources_ = sources;
  counts_ = {};
  seed();
  while (!queue_.empty() || go_by_edges()) {
    std::pop_heap(queue_.begin(), queue_.end());
    const Offer next = queue_.back();
    queue_.pop_back();
    if (next.distance > limits.radius) break;
    const Label* found = nodes_[next.node].find(next.chain, next.distance);
    if (found == nullptr) continue;
    if (next.distance > best_[point_of(next.node)] + reach_[next.node]) continue;
    if (counts_.expansions >= limits.expansions) return false;
    if (limits.progress && counts_.expansions % 512 == 0)
      limits.progress(counts_.expansions, next.distance);
    ++counts_.expansions;
    expand(next.node, Label(*found));
  }
  return true;
}

// What no string came to, though one came to a neighbour: along the edge. False if there is
// nothing.
bool MediaSolver::go_by_edges() {
  for (Index node = 0; node < space_->nodes(); ++node) {
    const Label label = nodes_[node].best();
    if (label.chain == none) continue;
    for (const Index other : space_->nodes_at(point_of(node)))
      for (const Index w : space_->neighbours(other)) {
        const Index to = space_->media()[medium_of(other)].first_node + w;
        if (best_[point_of(to)] < unreached) continue;
        prepared_ = false;
        from_ = node;
        go_by_corner(node, label, to);
        puller_.pull(attempt_.string);
        accept(attempt_, to);
      }
  }
  return !queue_.empty();
}

// A root for each medium that a source is in.
void MediaSolver::seed() {
  roots_.clear();
  const Point zero = {0, 0, 0};
  for (Index s = 0; s < sources_.size(); ++s) {
    const MediaSource& source = sources_[s];
    if (source.point != none)
      for (const Index n : space_->nodes_at(source.point))
        roots_.push_back({s, space_->medium_of(n), n, none, zero});
    else
      for (const Index i : source.simplices)
        roots_.push_back({s, space_->simplices()[i].medium, none, i, space_->beside(i, source.at)});
  }
  chains_.clear();
  for (Index n = 0; n < roots_.size(); ++n) chains_.root(n);
  hints_.assign(roots_.size(), {});
  nodes_.assign(space_->nodes() + 1, {});
  best_.assign(space_->points() + 1, unreached);
  queue_.clear();
  for (Index r = 0; r < roots_.size(); ++r) {
    const Root& root = roots_[r];
    const MediaSource& source = sources_[root.source];
    if (root.node != none) {
      take(root.node, {source.offset, r, zero});
      continue;
    }
    for (const Index p : space_->simplices()[root.simplex].corner) {
      if (p == none) continue;
      const Point leg = space_->point(p) - source.at;
      take(space_->node(p, root.medium),
           {source.offset + slowness(root.medium) * norm(leg), r, unit(leg)});
    }
  }
}

void MediaSolver::take(Index node, const Label& label) {
  if (!nodes_[node].take(label, behind_ * slowness(medium_of(node)), other_side_)) return;
  ++counts_.labels;
  double& best = best_[point_of(node)];
  best = std::min(best, label.distance);
  queue_.push_back({label.distance, node, label.chain});
  std::push_heap(queue_.begin(), queue_.end());
}

double MediaSolver::limit(Index node, const Point& last) const {
  return std::min(nodes_[node].limit(behind_ * slowness(medium_of(node)), last, other_side_),
                  best_[point_of(node)] + reach_[node]);
}

void MediaSolver::expand(Index node, const Label& label) {
  prepared_ = false;
  from_ = node;
  const auto& own = space_->media()[medium_of(node)];
  for (const Index w : space_->neighbours(node)) {
    const Index to = own.first_node + w;
    const Outcome outcome = offer(node, label, to, none);
    if (outcome == Outcome::longer) continue;
    offer_edge(node, label, to,
               outcome == Outcome::free ? offset(attempt_) + attempt_.string.length : unreached);
  }
  for (const Index other : space_->nodes_at(point_of(node))) {
    if (other == node) continue;
    const auto& medium = space_->media()[medium_of(other)];
    for (const Index w : space_->neighbours(other))
      offer_through(node, label, medium.first_node + w);
  }
}

// Into another medium, through each place at the point.
void MediaSolver::offer_through(Index node, const Label& label, Index to) {
  const Index m = medium_of(node), n = medium_of(to);
  const auto& media = space_->media();
  double found = unreached;
  for (const Index q : space_->places_at(point_of(node))) {
    if (space_->door(q, m) == none) continue;
    const Index door = space_->door(q, n);
    if (door == none) continue;
    // Between two solids a row is the border of a patch, on to which strings slide.
    if (space_->kind(q) == Kind::row && media[m].is_solid && media[n].is_solid &&
        !space_->patches_at(q).empty() && space_->last_door(q) - space_->first_door(q) < 3)
      continue;
    if (offer(node, label, to, door) == Outcome::free)
      found = std::min(found, offset(attempt_) + attempt_.string.length);
  }
  offer_edge(node, label, to, found);
}

// Along the edge, if that is shorter than what was found: from the point itself, or over a row.
void MediaSolver::offer_edge(Index node, const Label& label, Index to, double found) {
  const double length = direct(node, label, to);
  if (found < length * (1 + rounding)) return;
  direct_ = length * (1 + rounding);
  // In its own medium it may turn about a bend on the way and be shorter.
  const auto& own = space_->media()[medium_of(node)];
  const bool may_gain = medium_of(node) == medium_of(to) && own.room && !own.room->places().empty();
  if (may_gain || (length < limit(to, {0, 0, 0}) && length < best_[point_of(to)] * (1 - rounding)))
    offer_corner(node, label, to);
}

// The string to the node itself, whose legs are free.
void MediaSolver::prepare(Index node, const Label& label) {
  if (prepared_) return;
  prepared_ = true;
  Attempt& a = base_;
  chains_.places(label.chain, a.doors);
  a.root = chains_.source(label.chain);
  a.splits = 0;
  a.touched = false;
  const std::size_t n = a.doors.size();
  a.string.from = sources_[roots_[a.root].source].at;
  a.string.to = at(node);
  a.string.places.clear();
  a.string.at.resize(n);
  a.string.wide.resize(n);
  Index chain = label.chain;
  for (std::size_t i = n; i-- > 0; chain = chains_[chain].parent) {
    a.string.at[i] = hints_[chain][0];
    a.string.wide[i] = hints_[chain][1];
  }
  a.string.slowness.assign(1, slowness(roots_[a.root].medium));
  for (const Index d : a.doors) {
    a.string.places.push_back(place(space_->place_of(d)));
    a.string.slowness.push_back(slowness(space_->medium_behind(d)));
  }
  a.string.hold(0);
  puller_.pull(a.string);
  // Pulled from elsewhere it is the same; else its legs are not known.
  const bool same =
      std::abs(offset(a) + a.string.length - label.distance) < 1e-9 * (1 + label.distance);
  a.legs.clear();
  for (std::size_t i = 0; i <= n; ++i)
    a.legs.push_back({a.string.corner(i), a.string.corner(i + 1), true});
  for (const bool again : {false, true})  // then ends know the sides of cracks from each other
    for (std::size_t i = 0; i <= n && (!again || n > 0); ++i)
      a.legs[i] = {end_of_leg(a, i, i + 1, node), end_of_leg(a, i + 1, i, node), same};
}

// What a string that goes on through a place at the end of another one is at least as long as.
double MediaSolver::bound(Index from, const Label& label, Index to, Index door) const {
  const Point way = at(to) - at(from);
  const Point slope = slowness(medium_of(from)) * label.last;
  if (door == none) return label.distance + dot(slope, way);
  const Place& q = space_->place(space_->place_of(door));
  double along = dot(slope, q.along), wide = dot(slope, q.wide);
  const double s = slowness(space_->medium_behind(door)),
               rest = s * s - along * along - wide * wide;
  if (rest <= 0) return -unreached;
  const double wa = dot(way, q.along), ww = dot(way, q.wide);
  const Point off = way - wa * q.along - ww * q.wide;
  return label.distance + along * wa + wide * ww + std::sqrt(rest) * norm(off);
}

MediaSolver::Outcome MediaSolver::offer(Index from, const Label& label, Index to, Index door) {
  // The length of a chain is convex in where it ends.
  const double least = bound(from, label, to, door);
  if (least >= (door == none ? limit(to, label.last) : limit(to, {0, 0, 0})))
    return Outcome::longer;
  VertexLabels& at = nodes_[to];
  Index chain = label.chain;
  if (door != none) {
    chain = chains_.with(chain, door);
    hints_.resize(chains_.size(), {});
  }
  if (at.knows(chain)) return Outcome::longer;
  direct_ = direct(from, label, to) * (1 + rounding);
  const Outcome outcome = attempt(from, label, to, door);
  // Where it was blocked it may come past on another side from another node.
  if (outcome != Outcome::stuck && !attempt_.touched) at.remember(chain);
  // One that is longer than the edge is no reason not to go there.
  const bool by_edge = !(offset(attempt_) + attempt_.string.length < direct_);
  return outcome == Outcome::longer && by_edge ? Outcome::stuck : outcome;
}

MediaSolver::Outcome MediaSolver::attempt(Index from, const Label& label, Index to, Index door) {
  prepare(from, label);
  attempt_ = base_;
  Attempt& a = attempt_;
  a.string.to = at(to);
  if (door != none) append(a, door, a.string.to);
  Outcome outcome = settle(a, to, unreached);
  if (outcome != Outcome::longer) outcome = improve(a, to, outcome);
  if (outcome == Outcome::free) accept(a, to);
  return outcome;
}

// Straight on from the point itself, along the edge.
void MediaSolver::go_by_corner(Index from, const Label& label, Index to) {
  const Index p = point_of(from), door = space_->door(space_->corner(p), medium_of(to));
  prepare(from, label);
  attempt_ = base_;
  attempt_.string.to = at(to);
  append(attempt_, door, space_->point(p));
}

// And what is shorter past it.
void MediaSolver::offer_corner(Index from, const Label& label, Index to) {
  go_by_corner(from, label, to);
  const Outcome outcome = settle(attempt_, to, unreached);
  if (improve(attempt_, to, outcome) == Outcome::free) accept(attempt_, to);
}

// Between the end of the string as it was and a point on the way to the new one.
void MediaSolver::append(Attempt& a, Index door, const Point& toward) {
  const Place* p = place(space_->place_of(door));
  const Point &from = at(from_), middle = .5 * (from + toward);
  const Point d = middle - p->origin;
  a.doors.push_back(door);
  a.string.places.push_back(p);
  a.string.at.push_back(std::clamp(dot(d, p->along), p->low, p->high));
  a.string.wide.push_back(dot(d, p->wide));
  a.string.slowness.push_back(slowness(space_->medium_behind(door)));
  // From where it is free: in that medium beside the point, which tells the side of a crack.
  const Index m = space_->medium_behind(door), n = space_->node(point_of(from_), m);
  const auto& room = space_->media()[m].room;
  const Point beside =
      room && n != none ? room->beside(space_->media()[m].in_room(n), toward, toward) : from;
  a.legs.push_back({beside, beside, false});
}

const Place* MediaSolver::place(Index number) {
  if (space_->kind(number) != Kind::corner) return &space_->place(number);
  const Index p = space_->point_of_corner(number);
  const Point zero = {0, 0, 0};
  return &corners_.try_emplace(p, Place{space_->point(p), zero, 0, 0, zero, zero, zero, 0, p})
              .first->second;
}

Point MediaSolver::end_of_leg(const Attempt& a, std::size_t corner, std::size_t other,
                              Index to) const {
  const Point &toward = a.string.corner(other),
              &free = other > corner ? a.legs[corner].to : a.legs[other].from;
  const Index m = medium_of_leg(a, std::min(corner, other));
  const auto& medium = space_->media()[m];
  if (!medium.room) return a.string.corner(corner);
  if (corner > a.doors.size())
    return to == space_->nodes()
               ? attached_beside_
               : medium.room->beside(medium.in_room(to), toward, a.legs.back().to);
  if (corner == 0) {
    const Root& root = roots_[a.root];
    return root.node != none ? medium.room->beside(medium.in_room(root.node), toward, free)
                             : root.beside;
  }
  const Index q = place_of(a, corner - 1);
  const Point& at = a.string.points[corner - 1];
  if (space_->kind(q) != Kind::patch) return space_->beside(q, m, at, toward, free);
  // On one side of a crack through the plane, for both legs.
  const Point side = at + (a.legs[corner - 1].from - at) + (a.legs[corner].to - at);
  return space_->beside(q, m, at, toward, side);
}

// Instead of places from `begin` to `end` others, at a point.
void MediaSolver::replace(Attempt& a, std::size_t begin, std::size_t end,
                          std::span<const Index> doors, const Point& at) {
  String& s = a.string;
  const auto b = static_cast<std::ptrdiff_t>(begin), e = static_cast<std::ptrdiff_t>(end);
  const Leg first = a.legs[begin], last = a.legs[end];
  a.doors.erase(a.doors.begin() + b, a.doors.begin() + e);
  s.places.erase(s.places.begin() + b, s.places.begin() + e);
  s.at.erase(s.at.begin() + b, s.at.begin() + e);
  s.wide.erase(s.wide.begin() + b, s.wide.begin() + e);
  s.points.erase(s.points.begin() + b, s.points.begin() + e);
  s.slowness.erase(s.slowness.begin() + b + 1, s.slowness.begin() + e + 1);
  a.legs.erase(a.legs.begin() + b, a.legs.begin() + e);
  a.doors.insert(a.doors.begin() + b, doors.begin(), doors.end());
  s.points.insert(s.points.begin() + b, doors.size(), at);
  s.places.insert(s.places.begin() + b, doors.size(), nullptr);
  s.at.insert(s.at.begin() + b, doors.size(), 0);
  s.wide.insert(s.wide.begin() + b, doors.size(), 0);
  s.slowness.insert(s.slowness.begin() + b + 1, doors.size(), 0);
  a.legs.insert(a.legs.begin() + b, doors.size(), {at, at, false});
  for (std::size_t i = begin; i < begin + doors.size(); ++i) {
    const Place* p = place(space_->place_of(a.doors[i]));
    s.places[i] = p;
    s.at[i] = std::clamp(dot(at - p->origin, p->along), p->low, p->high);
    s.wide[i] = dot(at - p->origin, p->wide);
    s.slowness[i + 1] = slowness(space_->medium_behind(a.doors[i]));
  }
  a.legs[begin].from = first.from;
  a.legs[begin + doors.size()].to = last.to;
  a.legs[begin].known = a.legs[begin + doors.size()].known = false;
  if (doors.empty()) a.legs[begin] = {first.from, first.to, false};
}

void MediaSolver::accept(const Attempt& a, Index to) {
  Index chain = a.root;
  for (std::size_t i = 0; i < a.doors.size(); ++i) {
    chain = chains_.with(chain, a.doors[i]);
    hints_.resize(chains_.size(), {});
    hints_[chain] = {a.string.at[i], a.string.wide[i]};
  }
  nodes_[to].remember(chain);
  take(to, {offset(a) + a.string.length, chain, last_leg(a)});
}

std::pair<Index, const Label*> MediaSolver::best(Index point) const {
  std::pair<Index, const Label*> best = {none, nullptr};
  const auto consider = [&](Index node) {
    const Label& l = nodes_[node].best();
    if (l.chain == none || (best.second != nullptr && !(l.distance < best.second->distance)))
      return;
    best = {node, &l};
  };
  if (point == space_->points())
    consider(static_cast<Index>(space_->nodes()));
  else
    for (const Index n : space_->nodes_at(point)) consider(n);
  return best;
}

void MediaSolver::attach(const Point& at, std::span<const Index> simplices) {
  const auto number = static_cast<Index>(space_->nodes());
  attached_ = at;
  nodes_[number] = {};
  best_[space_->points()] = unreached;
  Index medium = none;
  VertexLabels shortest;
  for (const Index s : simplices) {
    const auto& simplex = space_->simplices()[s];
    attached_medium_ = simplex.medium;
    attached_beside_ = space_->beside(s, at);
    for (Index r = 0; r < roots_.size(); ++r) {
      if (roots_[r].simplex != s) continue;
      const Point leg = at - sources_[roots_[r].source].at;
      take(number, {sources_[roots_[r].source].offset + slowness(simplex.medium) * norm(leg), r,
                    unit(leg)});
    }
    for (const Index p : simplex.corner) {
      if (p == none) continue;
      for (const Index n : space_->nodes_at(p)) {
        from_ = n;
        for (const Label& label : VertexLabels(nodes_[n]).labels) {
          if (label.chain == none) continue;
          prepared_ = false;
          if (medium_of(n) != simplex.medium) {
            offer_through(n, label, number);
          } else if (const Outcome o = offer(n, label, number, none); o != Outcome::longer) {
            offer_edge(n, label, number,
                       o == Outcome::free ? offset(attempt_) + attempt_.string.length : unreached);
          }
        }
      }
    }
    if (nodes_[number].best().distance < shortest.best().distance) {
      shortest = nodes_[number];
      medium = simplex.medium;
    }
    nodes_[number] = {};
  }
  nodes_[number] = shortest;
  attached_medium_ = medium;
  best_[space_->points()] = shortest.best().distance;
  queue_.clear();
}

MediaSolver::Path MediaSolver::path(Index point) {
  const auto [node, label] = best(point);
  if (label == nullptr) return {};
  prepared_ = false;
  const Label copy = *label;
  prepare(node, copy);
  Path path;
  for (std::size_t n = 0; n < base_.doors.size() + 2; ++n) {
    path.points.push_back(base_.string.corner(n));
    if (n > 0) path.media.push_back(medium_of_leg(base_, n - 1));
  }
  return path;
}

std::size_t MediaSolver::bytes() const {
  return chains_.bytes() + hints_.capacity() * sizeof(Spot) +
         nodes_.capacity() * sizeof(VertexLabels) + best_.capacity() * sizeof(double) +
         reach_.capacity() * sizeof(double) + queue_.capacity() * sizeof(Offer);
}

}  // namespace plexway::strings
