#include <algorithm>
#include <cmath>
#include <numbers>

#include "strings/extender.hpp"

namespace plexway::detail::strings {

namespace {

constexpr double angle_slack = 1e-6;  // of angles
constexpr double half_turn = std::numbers::pi - 1e-7;
constexpr double as_long = 1e-9;  // of two ways as long the one that passes more rows

double angle_between(const Point& p, const Point& q) {
  return std::atan2(norm(cross(p, q)), dot(p, q));
}

}  // namespace

void Corner::look(const SolidSpace& space, Index vertex) {
  const Point& at = space.point(vertex);
  sides_.clear();
  for (const auto& [v, f] : space.faces_at(vertex)) {
    const Boundary::Face& face = space.face(f);
    std::size_t k = 0;
    while (face.corner[k] != vertex) ++k;
    const Point a = space.point(face.corner[(k + 1) % 3]) - at,
                b = space.point(face.corner[(k + 2) % 3]) - at;
    const Point& n = face.normal;
    sides_.push_back({n, {unit(cross(n, a)), unit(cross(b, n))}});
  }
  for (const auto& [v, row] : space.rows_at(vertex)) {
    const Place& p = space.places()[row];
    for (const bool up : {false, true})
      if (p.end[up ? 1 : 0] != vertex)
        nodes_.push_back({row, up ? p.along : -1. * p.along, 1e300, 0, false});
  }
}

// Does the solid have the directions between two?
bool Corner::is_open(const SolidSpace& space, const Node& a, const Node& b) const {
  const auto leads_off = [&](const Node& row, const Point& direction) {
    if (row.place == none) return true;
    const Place& place = space.places()[row.place];
    const double angle = place.angle_of(direction);
    return place.holds() || (angle > -angle_slack && angle < place.angle + angle_slack);
  };
  if (!leads_off(a, b.along) || !leads_off(b, a.along)) return false;
  return std::none_of(sides_.begin(), sides_.end(), [&](const Side& side) {
    const double before = dot(side.normal, a.along), behind = dot(side.normal, b.along);
    if (!(before > -angle_slack && behind < -angle_slack)) return false;
    const double share = std::max(before, 0.) / (std::max(before, 0.) - behind);
    const Point at = a.along + share * (b.along - a.along);
    return dot(side.inward[0], at) > angle_slack && dot(side.inward[1], at) > angle_slack;
  });
}

bool Corner::find(const SolidSpace& space, Index vertex, const Point& in, const Point& out) {
  if (norm(in) == 0 || norm(out) == 0 || angle_between(in, out) >= half_turn) return false;
  nodes_.clear();
  nodes_.push_back({none, unit(in), 0, 0, false});
  nodes_.push_back({none, unit(out), 1e300, 0, false});
  look(space, vertex);
  return find_other(space);
}

bool Corner::find_other(const SolidSpace& space) {
  for (std::size_t n = 1; n < nodes_.size(); ++n) {
    nodes_[n].done = nodes_[n].left_out;
    nodes_[n].turned = 1e300;
  }
  for (std::size_t now = 0; now != 1;) {
    nodes_[now].done = true;
    for (std::size_t n = 1; n < nodes_.size(); ++n) {
      if (nodes_[n].done || nodes_[n].place == nodes_[now].place) continue;
      const double turned = nodes_[now].turned + angle_between(nodes_[now].along, nodes_[n].along);
      if (turned >= std::min(half_turn, nodes_[n].turned + as_long)) continue;
      if (!is_open(space, nodes_[now], nodes_[n])) continue;
      nodes_[n].turned = turned;
      nodes_[n].before = now;
    }
    now = 0;
    for (std::size_t n = 1; n < nodes_.size(); ++n)
      if (!nodes_[n].done && nodes_[n].turned < half_turn &&
          (now == 0 || nodes_[n].turned < nodes_[now].turned))
        now = n;
    if (now == 0) return false;
  }
  turned_ = nodes_[1].turned;
  rows_.clear();
  for (std::size_t n = nodes_[1].before; n != 0; n = nodes_[n].before) {
    rows_.push_back({nodes_[n].place, nodes_[n].along, nodes_[n].turned});
    if (nodes_[n].before == 0) nodes_[n].left_out = true;
  }
  std::reverse(rows_.begin(), rows_.end());
  return true;
}

void Extender::expand(Index node, const Label& label, Offers& offers) {
  // Pulled anew, whoever took it on before: so that threads do not matter.
  base_node_ = none;
  const Index first = space_->media()[state_->medium_of(node)].first_node;
  for (const Index w : space_->neighbours(node)) extend(node, label, first + w, offers);
  for (const Index other : space_->nodes_at(state_->point_of(node))) {
    if (other == node) continue;
    const auto& medium = space_->media()[state_->medium_of(other)];
    for (const Index w : space_->neighbours(other))
      extend(node, label, medium.first_node + w, offers);
  }
  base_node_ = none;
}

void Extender::extend(Index node, const Label& label, Index to, Offers& offers) {
  from_ = node;
  found_ = unreached;
  const bool through = state_->medium_of(node) != state_->medium_of(to);
  const Outcome outcome =
      through ? offer_through(node, label, to, offers) : offer(node, label, to, none, offers);
  if (outcome != Outcome::longer) offer_edge(node, label, to, offers);
  if (found_ == unreached && state_->is_shorter(node, label, to))
    offers.left.emplace_back(node, to);
}

// Into another medium, through each place at the point.
Extender::Outcome Extender::offer_through(Index node, const Label& label, Index to,
                                          Offers& offers) {
  const Index m = state_->medium_of(node), n = state_->medium_of(to);
  const auto& media = space_->media();
  for (const Index q : space_->places_at(state_->point_of(node))) {
    if (space_->door(q, m) == none) continue;
    const Index door = space_->door(q, n);
    if (door == none) continue;
    // Between two solids a row is the border of a patch, on to which strings slide.
    if (space_->kind(q) == Kind::row && media[m].is_solid && media[n].is_solid &&
        !space_->patches_at(q).empty() && space_->last_door(q) - space_->first_door(q) < 3)
      continue;
    offer(node, label, to, door, offers);
  }
  return Outcome::stuck;  // the edge may do
}

// Along the edge, if that is shorter than what was found: from the point itself, or over a row.
void Extender::offer_edge(Index node, const Label& label, Index to, Offers& offers) {
  const double length = state_->direct(node, label, to);
  if (found_ < length * (1 + rounding)) return;
  direct_ = length * (1 + rounding);
  // In its own medium it may turn about a bend on the way and be shorter.
  const Index m = state_->medium_of(node);
  const auto& own = space_->media()[m];
  const bool may_gain = m == state_->medium_of(to) && own.room && !own.room->places().empty();
  const bool shorter = length < state_->distance(state_->point_of(to)) * (1 - rounding);
  if (may_gain ||
      (shorter &&
       length < state_->limit(to, label.source, label.media | state_->bit(state_->medium_of(to)),
                              {0, 0, 0}, length)))
    if (attempt_corner(node, label, to) == Outcome::free) accept(attempt_, to, offers);
}

// The string to the node itself, whose legs are free.
void Extender::prepare(Index node, const Label& label) {
  if (base_node_ == node && base_chain_ == label.chain) return;
  base_node_ = node;
  base_chain_ = label.chain;
  Attempt& a = base_;
  std::size_t n = 0;
  const Chains& chains = state_->chains;
  root_chain_ = label.chain;
  for (; !chains.is_root(root_chain_); root_chain_ = chains[root_chain_].parent) ++n;
  a.root = chains[root_chain_].place;
  const State::Root& root = state_->roots[a.root];
  auto& knots = a.string.knots;
  knots.assign(n + 2, {});
  Index chain = label.chain;
  for (std::size_t k = n; k > 0; --k, chain = chains[chain].parent) {
    knots[k].door = chains[chain].place;
    knots[k].place = place(space_->place_of(knots[k].door));
    knots[k].t = state_->hints[chain][0];
    knots[k].u = state_->hints[chain][1];
    knots[k].medium = space_->medium_behind(knots[k].door);
    knots[k].slowness = slowness(knots[k].medium);
  }
  knots[0].at = state_->sources[root.source].at;
  knots[0].medium = root.medium;
  knots[0].slowness = slowness(root.medium);
  knots[n + 1].at = at(node);
  puller_.pull(a.string);
  // Pulled from elsewhere it is the same; else its legs are not known.
  const bool same = std::abs(length(a) - label.distance) < rounding * (1 + label.distance);
  for (std::size_t k = 0; k <= n; ++k) knots[k].leg = {knots[k].at, knots[k + 1].at, true};
  // Then ends know the sides of cracks in patches from each other.
  for (const bool again : {false, true})
    for (std::size_t k = 0; k <= n && (!again || !plain_); ++k)
      knots[k].leg = {end_of_leg(a, k, k + 1, node), end_of_leg(a, k + 1, k, node), same};
}

// What a string that goes on through a place at the end of another one is at least as long as.
double Extender::bound(Index from, const Label& label, Index to, Index door) const {
  const Point way = at(to) - at(from);
  const Point slope = slowness(state_->medium_of(from)) * label.last;
  const Place& q = space_->place(space_->place_of(door));
  double along = dot(slope, q.along), wide = dot(slope, q.wide);
  const double s = slowness(space_->medium_behind(door)),
               rest = s * s - along * along - wide * wide;
  if (rest <= 0) return -unreached;
  const double wa = dot(way, q.along), ww = dot(way, q.wide);
  const Point off = way - wa * q.along - ww * q.wide;
  return label.distance + along * wa + wide * ww + std::sqrt(rest) * norm(off);
}

Extender::Outcome Extender::offer(Index from, const Label& label, Index to, Index door,
                                  Offers& offers) {
  const VertexLabels& known = state_->nodes[to];
  if (door == none) {
    if (known.knows(label.chain)) return Outcome::longer;
    // The length of a chain is convex in where it ends.
    const double slope = slowness(state_->medium_of(from)) * dot(label.last, at(to) - at(from));
    const double least = label.distance + slope;
    if (least >= state_->limit(to, label.source, label.media, label.last, least))
      return Outcome::longer;
  } else {
    const double least = bound(from, label, to, door);
    if (least >= state_->limit(to, label.source,
                               label.media | state_->bit(space_->medium_behind(door)), {0, 0, 0},
                               least))
      return Outcome::longer;
    if (const Index chain = state_->chains.find(label.chain, door);
        chain != none && known.knows(chain))
      return Outcome::longer;
  }
  direct_ = state_->direct(from, label, to) * (1 + rounding);
  const Outcome outcome = attempt(from, label, to, door);
  if (outcome == Outcome::free) accept(attempt_, to, offers);
  // Where it was blocked it may come past on another side from another node.
  if (outcome != Outcome::stuck && !attempt_.touched &&
      (outcome == Outcome::free || !known.empty())) {
    if (door != none) offers.bends.push_back({door, {}});
    offers.strings.push_back({to, offers.bends.size(), {unreached, label.chain}});
  }
  // One that is longer than the edge is no reason not to go there.
  return outcome == Outcome::longer && !(length(attempt_) < direct_) ? Outcome::stuck : outcome;
}

Extender::Outcome Extender::attempt(Index from, const Label& label, Index to, Index door) {
  prepare(from, label);
  start(to);
  if (door != none) append(attempt_, door, at(to));
  const Outcome outcome = settle(attempt_, to, unreached);
  return outcome == Outcome::longer ? outcome : improve(attempt_, to, outcome);
}

// Straight on from the point itself, along the edge.
void Extender::go_by_corner(Index from, const Label& label, Index to) {
  const Index p = state_->point_of(from),
              door = space_->door(space_->corner(p), state_->medium_of(to));
  prepare(from, label);
  start(to);
  append(attempt_, door, space_->point(p));
}

// And what is shorter past it.
Extender::Outcome Extender::attempt_corner(Index from, const Label& label, Index to) {
  go_by_corner(from, label, to);
  return improve(attempt_, to, settle(attempt_, to, unreached));
}

void Extender::go_by_edge(Index node, const Label& label, Index to, Offers& offers) {
  from_ = node;
  go_by_corner(node, label, to);
  puller_.pull(attempt_.string);
  accept(attempt_, to, offers);
}

double Extender::moved(Index node, const Label& label, Index to) {
  direct_ = unreached;
  from_ = node;
  const bool free = attempt(node, label, to, none) == Outcome::free ||
                    attempt_corner(node, label, to) == Outcome::free;
  return free ? length(attempt_) : unreached;
}

const Place* Extender::place(Index number) {
  if (space_->kind(number) != Kind::corner) return &space_->place(number);
  const Index p = space_->point_of_corner(number);
  const Point zero = {0, 0, 0};
  return &corners_.try_emplace(p, Place{space_->point(p), zero, 0, 0, zero, zero, zero, 0, p})
              .first->second;
}

std::uint64_t Extender::media_of(const Attempt& a) const {
  std::uint64_t media = 0;
  const auto& knots = a.string.knots;
  for (std::size_t k = 0; k + 1 < knots.size(); ++k) media |= state_->bit(knots[k].medium);
  return media;
}

void Extender::accept(const Attempt& a, Index to, Offers& offers) {
  const auto& knots = a.string.knots;
  for (std::size_t k = 1; k + 1 < knots.size(); ++k)
    offers.bends.push_back({knots[k].door, {knots[k].t, knots[k].u}});
  const std::size_t last = a.string.bends();
  found_ = std::min(found_, length(a));
  offers.strings.push_back(
      {to,
       offers.bends.size(),
       {length(a), root_chain_, source_of(a), last_leg(a),
        knots[last].slowness * norm(knots[last + 1].at - knots[last].at), media_of(a)}});
}

}  // namespace plexway::detail::strings
