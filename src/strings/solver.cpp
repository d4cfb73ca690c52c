#include "strings/solver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plexway::strings {

Solver::Solver(const MediaSpace& space) : space_(&space), plain_(space.is_plain()) {
  // Others may have come through other media.
  if (space.media().size() > 1) other_side_ = 1 - 1e-10;
  if (!plain_) measure_reach();
}

void Solver::measure_reach() {
  reach_.assign(space_->nodes() + 1, 0);
  for (Index n = 0; n < space_->nodes(); ++n) {
    const Index p = space_->point_of(n), m = space_->medium_of(n);
    double longest = 0;
    for (const Index w : space_->neighbours(n)) {
      const Index q = plain_ ? w : space_->media()[m].points[w];
      longest = std::max(longest, norm(space_->point(q) - space_->point(p)));
    }
    reach_[n] = longest * slowness(m);
  }
  reach_.back() = *std::max_element(reach_.begin(), reach_.end());
}

void Solver::keep_near(double share) {
  measure_reach();
  for (double& reach : reach_) reach *= share;
}

void Solver::clear() {
  sources_.clear();
  roots_.clear();
  counts_ = {};
  chains_.clear();
  hints_.clear();
  if (nodes_.empty()) {
    nodes_.resize(space_->nodes() + 1);
    if (!plain_) best_.assign(space_->points() + 1, unreached);
  }
  for (const Index n : reached_) {
    nodes_[n].clear();
    if (!plain_) best_[space_->point_of(n)] = unreached;
  }
  reached_.clear();
}

bool Solver::add(std::span<const Source> sources, const Limits& limits) {
  const std::size_t before = counts_.expansions, first = sources_.size();
  for (const Source& s : sources) sources_.push_back({s.at, s.offset});
  if (sources_.size() > 1 && reach_.empty()) measure_reach();
  queue_.clear();
  base_node_ = none;
  for (std::size_t n = 0; n < sources.size(); ++n) seed(static_cast<Index>(first + n), sources[n]);
  left_.clear();
  while (!queue_.empty() || go_by_edges()) {
    const Queue::Offer next = queue_.pop();
    if (next.distance > limits.radius) {
      queue_.clear();
      continue;
    }
    const Label* found = nodes_[next.vertex].find(next.chain, next.distance);
    if (found == nullptr) continue;
    if (!plain_ && next.distance > longest(next.vertex)) continue;
    const std::size_t expansions = counts_.expansions - before;
    if (expansions >= limits.expansions) return false;
    if (limits.progress && expansions % 512 == 0) limits.progress(expansions, next.distance);
    ++counts_.expansions;
    expand(next.vertex, Label(*found));
  }
  return true;
}

// Edges that are shorter than what was found past them, as where a solid only touches itself or a
// string came to no end: along them as they are, for an edge is in the domain, whatever is around
// it. False if there is none.
bool Solver::go_by_edges() {
  for (const auto& [node, to] : left_) {
    const Label label = nodes_[node].best();
    if (!is_shorter(node, label, to)) continue;
    from_ = node;
    go_by_corner(node, label, to);
    puller_.pull(attempt_.string);
    accept(attempt_, to);
  }
  left_.clear();
  return !queue_.empty();
}

// A root for each medium that a source is in.
void Solver::seed(Index number, const Source& source) {
  const Point zero = {0, 0, 0};
  const auto root = [&](Index medium, Index node, Index simplex, const Point& beside) {
    roots_.push_back({number, medium, node, simplex, beside});
    const Index chain = chains_.root(static_cast<Index>(roots_.size() - 1));
    hints_.resize(chains_.size(), {});
    return chain;
  };
  if (source.point != none)
    for (const Index n : space_->nodes_at(source.point))
      take(n, {source.offset, root(space_->medium_of(n), n, none, zero), number, zero, 0});
  for (const Inside& in : source.inside) {
    if (source.point != none) break;
    const Index chain = root(in.medium, none, in.simplex, in.beside);
    for (const Index p : in.corner) {
      if (p == none) continue;
      const Point leg = space_->point(p) - source.at;
      const double length = slowness(in.medium) * norm(leg);
      take(space_->node(p, in.medium), {source.offset + length, chain, number, unit(leg), length});
    }
  }
}

void Solver::take(Index node, const Label& label) {
  const bool first = nodes_[node].empty();
  if (!nodes_[node].take(label, spread(node))) return;
  if (first && node != space_->nodes()) reached_.push_back(node);
  ++counts_.labels;
  if (!plain_) {
    double& best = best_[point_of(node)];
    best = std::min(best, label.distance);
  }
  queue_.push({label.distance, node, label.chain});
}

void Solver::expand(Index node, const Label& label) {
  from_ = node;
  const Index first = space_->media()[medium_of(node)].first_node;
  for (const Index w : space_->neighbours(node)) {
    const Outcome outcome = offer(node, label, first + w, none);
    if (outcome != Outcome::longer)
      offer_edge(node, label, first + w, outcome == Outcome::free ? length(attempt_) : unreached);
    if (is_shorter(node, label, first + w)) left_.emplace_back(node, first + w);
  }
  if (plain_) return;
  for (const Index other : space_->nodes_at(point_of(node))) {
    if (other == node) continue;
    const auto& medium = space_->media()[medium_of(other)];
    for (const Index w : space_->neighbours(other))
      offer_through(node, label, medium.first_node + w);
  }
}

// Into another medium, through each place at the point.
void Solver::offer_through(Index node, const Label& label, Index to) {
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
    if (offer(node, label, to, door) == Outcome::free) found = std::min(found, length(attempt_));
  }
  offer_edge(node, label, to, found);
  if (is_shorter(node, label, to)) left_.emplace_back(node, to);
}

// Along the edge, if that is shorter than what was found: from the point itself, or over a row.
void Solver::offer_edge(Index node, const Label& label, Index to, double found) {
  const double length = direct(node, label, to);
  if (found < length * (1 + rounding)) return;
  direct_ = length * (1 + rounding);
  // In its own medium it may turn about a bend on the way and be shorter.
  const auto& own = space_->media()[medium_of(node)];
  const bool may_gain = medium_of(node) == medium_of(to) && own.room && !own.room->places().empty();
  const bool shorter = length < distance(point_of(to)) * (1 - rounding);
  if (may_gain || (shorter && length < limit(to, label.source, {0, 0, 0}, length)))
    if (attempt_corner(node, label, to) == Outcome::free) accept(attempt_, to);
}

// The string to the node itself, whose legs are free.
void Solver::prepare(Index node, const Label& label) {
  if (base_node_ == node && base_chain_ == label.chain) return;
  base_node_ = node;
  base_chain_ = label.chain;
  Attempt& a = base_;
  std::size_t n = 0;
  Index chain = label.chain;
  for (; !chains_.is_root(chain); chain = chains_[chain].parent) ++n;
  a.root = chains_[chain].place;
  const Root& root = roots_[a.root];
  auto& knots = a.string.knots;
  knots.assign(n + 2, {});
  chain = label.chain;
  for (std::size_t k = n; k > 0; --k, chain = chains_[chain].parent) {
    knots[k].door = chains_[chain].place;
    knots[k].place = place(space_->place_of(knots[k].door));
    knots[k].t = hints_[chain][0];
    knots[k].u = hints_[chain][1];
    knots[k].medium = space_->medium_behind(knots[k].door);
    knots[k].slowness = slowness(knots[k].medium);
  }
  knots[0].at = sources_[root.source].at;
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
double Solver::bound(Index from, const Label& label, Index to, Index door) const {
  const Point way = at(to) - at(from);
  const Point slope = slowness(medium_of(from)) * label.last;
  const Place& q = space_->place(space_->place_of(door));
  double along = dot(slope, q.along), wide = dot(slope, q.wide);
  const double s = slowness(space_->medium_behind(door)),
               rest = s * s - along * along - wide * wide;
  if (rest <= 0) return -unreached;
  const double wa = dot(way, q.along), ww = dot(way, q.wide);
  const Point off = way - wa * q.along - ww * q.wide;
  return label.distance + along * wa + wide * ww + std::sqrt(rest) * norm(off);
}

Solver::Outcome Solver::offer(Index from, const Label& label, Index to, Index door) {
  VertexLabels& known = nodes_[to];
  Index chain = label.chain;
  if (door == none) {
    if (known.knows(chain)) return Outcome::longer;
    // The length of a chain is convex in where it ends.
    const double slope = slowness(medium_of(from)) * dot(label.last, at(to) - at(from));
    const double least = label.distance + slope;
    if (least >= limit(to, label.source, label.last, least)) return Outcome::longer;
  } else {
    const double least = bound(from, label, to, door);
    if (least >= limit(to, label.source, {0, 0, 0}, least)) return Outcome::longer;
    chain = chains_.with(chain, door);
    hints_.resize(chains_.size(), {});
    if (known.knows(chain)) return Outcome::longer;
  }
  direct_ = direct(from, label, to) * (1 + rounding);
  const Outcome outcome = attempt(from, label, to, door);
  if (outcome == Outcome::free) accept(attempt_, to);
  // Where it was blocked it may come past on another side from another node.
  if (outcome != Outcome::stuck && !attempt_.touched && !known.empty()) known.remember(chain);
  // One that is longer than the edge is no reason not to go there.
  return outcome == Outcome::longer && !(length(attempt_) < direct_) ? Outcome::stuck : outcome;
}

Solver::Outcome Solver::attempt(Index from, const Label& label, Index to, Index door) {
  prepare(from, label);
  start(to);
  if (door != none) append(attempt_, door, at(to));
  const Outcome outcome = settle(attempt_, to, unreached);
  return outcome == Outcome::longer ? outcome : improve(attempt_, to, outcome);
}

// Straight on from the point itself, along the edge.
void Solver::go_by_corner(Index from, const Label& label, Index to) {
  const Index p = point_of(from), door = space_->door(space_->corner(p), medium_of(to));
  prepare(from, label);
  start(to);
  append(attempt_, door, space_->point(p));
}

// And what is shorter past it.
Solver::Outcome Solver::attempt_corner(Index from, const Label& label, Index to) {
  go_by_corner(from, label, to);
  return improve(attempt_, to, settle(attempt_, to, unreached));
}

const Place* Solver::place(Index number) {
  if (space_->kind(number) != Kind::corner) return &space_->place(number);
  const Index p = space_->point_of_corner(number);
  const Point zero = {0, 0, 0};
  return &corners_.try_emplace(p, Place{space_->point(p), zero, 0, 0, zero, zero, zero, 0, p})
              .first->second;
}

void Solver::accept(const Attempt& a, Index to) {
  const auto& knots = a.string.knots;
  Index chain = chains_.root(a.root);
  for (std::size_t k = 1; k + 1 < knots.size(); ++k) {
    chain = chains_.with(chain, knots[k].door);
    hints_.resize(chains_.size(), {});
    hints_[chain] = {knots[k].t, knots[k].u};
  }
  nodes_[to].remember(chain);
  const std::size_t last = a.string.bends();
  take(to, {length(a), chain, roots_[a.root].source, last_leg(a),
            knots[last].slowness * norm(knots[last + 1].at - knots[last].at)});
}

std::pair<Index, const Label*> Solver::best(Index point) const {
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

void Solver::attach(const Point& at, std::span<const Inside> inside,
                    std::span<const Index> sources) {
  const auto number = static_cast<Index>(space_->nodes());
  attached_ = at;
  base_node_ = none;  // may be the one that was attached before
  nodes_[number].clear();
  if (!plain_) best_[space_->points()] = unreached;
  Index medium = inside.empty() ? 0 : inside[0].medium;
  VertexLabels shortest;
  for (const Inside& in : inside) {
    attached_medium_ = in.medium;
    attached_beside_ = in.beside;
    for (const Index s : sources) {
      const auto of_source = [](const Root& root, Index source) { return root.source < source; };
      for (auto root = std::lower_bound(roots_.begin(), roots_.end(), s, of_source);
           root != roots_.end() && root->source == s; ++root) {
        if (root->simplex != in.simplex) continue;
        const Point leg = at - sources_[s].at;
        const double length = slowness(in.medium) * norm(leg);
        take(number,
             {sources_[s].offset + length, chains_.root(static_cast<Index>(root - roots_.begin())),
              s, unit(leg), length});
      }
    }
    for (const Index p : in.corner) {
      if (p == none) continue;
      for (const Index n : space_->nodes_at(p)) {
        from_ = n;
        for (const Label& label : nodes_[n].labels) {
          if (medium_of(n) != in.medium)
            offer_through(n, label, number);
          else if (const Outcome o = offer(n, label, number, none); o != Outcome::longer)
            offer_edge(n, label, number, o == Outcome::free ? length(attempt_) : unreached);
        }
      }
    }
    if (nodes_[number].best().distance < shortest.best().distance) {
      shortest = nodes_[number];
      medium = in.medium;
    }
    nodes_[number].clear();
  }
  nodes_[number] = shortest;
  attached_medium_ = medium;
  if (!plain_) best_[space_->points()] = shortest.best().distance;
  queue_.clear();
}

double Solver::moved(Index node, const Label& label, const Point& at, const Point& beside) {
  const Root& root = root_of(label);
  const Origin& source = sources_[root.source];
  if (const auto& medium = space_->media()[root.medium];
      chains_.is_root(label.chain) && medium.room) {
    const Point from = root.node == none ? root.beside
                                         : medium.room->beside(medium.in_room(root.node), at,
                                                               space_->point(point_of(node)));
    if (!medium.room->sight().is_blocked(from, beside))
      return source.offset + medium.slowness * norm(at - source.at);
  }
  const auto number = static_cast<Index>(space_->nodes());
  nodes_[number].clear();
  if (!plain_) best_[space_->points()] = unreached;
  attached_ = at;
  attached_beside_ = beside;
  attached_medium_ = medium_of(node);
  direct_ = unreached;
  from_ = node;
  const bool free = attempt(node, label, number, none) == Outcome::free ||
                    attempt_corner(node, label, number) == Outcome::free;
  return free ? length(attempt_) : unreached;
}

Solver::Path Solver::path(Index point) {
  const auto [node, label] = best(point);
  if (label == nullptr) return {};
  prepare(node, Label(*label));
  Path path;
  for (const Knot& knot : base_.string.knots) {
    path.points.push_back(knot.at);
    path.media.push_back(knot.medium);
  }
  path.media.pop_back();
  return path;
}

std::size_t Solver::bytes() const {
  const auto of = [](const auto& v) { return v.capacity() * sizeof(v[0]); };
  std::size_t labels = 0;
  for (const VertexLabels& node : nodes_) labels += of(node.labels);
  return chains_.bytes() + of(hints_) + of(nodes_) + labels + of(best_) + of(reach_) +
         of(reached_) + queue_.bytes() + of(left_) + of(sources_) + of(roots_);
}

}  // namespace plexway::strings
