#include "strings/solver.hpp"

#include <algorithm>

namespace plexway::detail::strings {

void Solver::measure_reach() {
  auto& reach = state_.reach;
  reach.assign(space_->nodes() + 1, 0);
  for (Index n = 0; n < space_->nodes(); ++n) {
    const Index p = space_->point_of(n), m = space_->medium_of(n);
    double longest = 0;
    for (const Index w : space_->neighbours(n)) {
      const Index q = state_.plain ? w : space_->media()[m].points[w];
      longest = std::max(longest, norm(space_->point(q) - space_->point(p)));
    }
    reach[n] = longest * state_.slowness(m);
  }
  reach.back() = *std::max_element(reach.begin(), reach.end());
}

void Solver::clear() {
  state_.sources.clear();
  state_.roots.clear();
  counts_ = {};
  state_.chains.clear();
  state_.hints.clear();
  if (state_.nodes.empty()) {
    state_.nodes.resize(space_->nodes() + 1);
    if (!state_.plain) state_.best.assign(space_->points() + 1, State::unreached);
  }
  for (const Index n : reached_) {
    state_.nodes[n].clear();
    if (!state_.plain) state_.best[space_->point_of(n)] = State::unreached;
  }
  reached_.clear();
}

bool Solver::add(std::span<const Source> sources, const Limits& limits) {
  const std::size_t first = state_.sources.size();
  for (const Source& s : sources) state_.sources.push_back({s.at, s.offset});
  const bool bounded = limits.radius < State::unreached;
  if (state_.reach.empty() && (bounded || state_.sources.size() > 1)) measure_reach();
  while (extenders_.size() < limits.threads.count) extenders_.emplace_back(state_);
  queue_.clear();
  for (std::size_t n = 0; n < sources.size(); ++n) seed(static_cast<Index>(first + n), sources[n]);
  left_.clear();
  std::size_t done = 0, told = 0;
  while (!queue_.empty() || go_by_edges()) {
    const std::size_t gathered = gather(limits),
                      count = std::min(gathered, limits.expansions - done);
    if (count > 0 && limits.progress && done >= told) {
      constexpr std::size_t often = 512;
      limits.progress(done, turns_[0].label.distance);
      told = done + often;
    }
    const auto expand = [&](std::size_t turn, std::size_t thread) {
      Turn& t = turns_[turn];
      t.offers.clear();
      extenders_[thread].expand(t.node, t.label, t.offers);
    };
    if (count > 1 && limits.threads.share)
      limits.threads.share(count, expand);
    else
      for (std::size_t turn = 0; turn < count; ++turn) expand(turn, 0);
    for (std::size_t turn = 0; turn < count; ++turn) take_all(turns_[turn].offers);
    done += count;
    counts_.expansions += count;
    if (count < gathered) return false;
  }
  return true;
}

// The nodes whose turn it is; returns how many: so small a part of the front that they hardly meet,
// as they offer without knowing of each other.
std::size_t Solver::gather(const Limits& limits) {
  constexpr std::size_t part = 32, most = 64;
  const std::size_t wanted = std::clamp(queue_.size() / part, std::size_t{1}, most);
  std::size_t count = 0;
  while (count < wanted && !queue_.empty()) {
    const Queue::Offer next = queue_.pop();
    // One that is no farther beyond than an edge may have what is the shortest nearer by.
    if (next.distance > limits.radius && next.distance > limits.radius + state_.reach[next.vertex])
      continue;
    const Label* found = state_.nodes[next.vertex].find(next.chain, next.distance);
    if (found == nullptr) continue;
    if (!state_.plain && next.distance > state_.longest(next.vertex)) continue;
    if (count == turns_.size()) turns_.emplace_back();
    turns_[count].node = next.vertex;
    turns_[count++].label = *found;
  }
  return count;
}

// Edges that are shorter than what was found past them, as where a solid only touches itself or a
// string came to no end. False if there is none.
bool Solver::go_by_edges() {
  offers_.clear();
  for (const auto& [node, to] : left_) {
    const Label& label = state_.nodes[node].best();
    if (state_.is_shorter(node, label, to)) extenders_[0].go_by_edge(node, label, to, offers_);
  }
  left_.clear();
  take_all(offers_);
  return !queue_.empty();
}

// A root for each medium that a source is in.
void Solver::seed(Index number, const Source& source) {
  const Point zero = {0, 0, 0};
  const auto root = [&](Index medium, Index node, Index simplex, const Point& beside) {
    state_.roots.push_back({number, medium, node, simplex, beside});
    const Index chain = state_.chains.root(static_cast<Index>(state_.roots.size() - 1));
    state_.hints.resize(state_.chains.size(), {});
    return chain;
  };
  if (source.point != none)
    for (const Index n : space_->nodes_at(source.point))
      take(n, {source.offset, root(space_->medium_of(n), n, none, zero), number, zero, 0,
               state_.bit(space_->medium_of(n))});
  for (const Inside& in : source.inside) {
    if (source.point != none) break;
    const Index chain = root(in.medium, none, in.simplex, in.beside);
    for (const Index p : in.corner) {
      if (p == none) continue;
      const Point leg = space_->point(p) - source.at;
      const double length = state_.slowness(in.medium) * norm(leg);
      take(space_->node(p, in.medium),
           {source.offset + length, chain, number, unit(leg), length, state_.bit(in.medium)});
    }
  }
}

void Solver::take_all(const Offers& offers) {
  std::size_t bend = 0;
  for (const Offers::One& one : offers.strings) {
    const bool found = one.label.distance < State::unreached;
    Label label = one.label;
    for (; bend < one.end; ++bend) {
      label.chain = state_.chains.with(label.chain, offers.bends[bend].door);
      state_.hints.resize(state_.chains.size(), {});
      if (found) state_.hints[label.chain] = offers.bends[bend].at;
    }
    state_.nodes[one.to].remember(label.chain);
    if (found) take(one.to, label);
  }
  left_.insert(left_.end(), offers.left.begin(), offers.left.end());
}

void Solver::take(Index node, const Label& label) {
  VertexLabels& labels = state_.nodes[node];
  const bool first = labels.empty();
  if (!labels.take(label, state_.spread(node))) return;
  if (first && node != space_->nodes()) reached_.push_back(node);
  ++counts_.labels;
  if (!state_.plain) {
    double& best = state_.best[state_.point_of(node)];
    best = std::min(best, label.distance);
  }
  queue_.push({label.distance, node, label.chain});
}

std::pair<Index, const Label*> Solver::best(Index point) const {
  std::pair<Index, const Label*> best = {none, nullptr};
  const auto consider = [&](Index node) {
    const Label& l = state_.nodes[node].best();
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

void Solver::set_attached(const Point& at, Index medium, const Point& beside) {
  extenders_[0].forget(static_cast<Index>(space_->nodes()));
  state_.nodes[space_->nodes()].clear();
  state_.attached = at;
  state_.attached_medium = medium;
  state_.attached_beside = beside;
}

void Solver::attach(const Point& at, std::span<const Inside> inside,
                    std::span<const Index> sources) {
  const auto number = static_cast<Index>(space_->nodes());
  double* const least = state_.plain ? nullptr : &state_.best[space_->points()];
  if (least != nullptr) *least = State::unreached;
  Inside best = inside.empty() ? Inside{none, 0, {}, at} : inside[0];
  VertexLabels shortest;
  left_.clear();
  for (const Inside& in : inside) {
    set_attached(at, in.medium, in.beside);
    for (const Index s : sources) {
      const auto of_source = [](const State::Root& root, Index source) {
        return root.source < source;
      };
      const auto& roots = state_.roots;
      for (auto root = std::lower_bound(roots.begin(), roots.end(), s, of_source);
           root != roots.end() && root->source == s; ++root) {
        if (root->simplex != in.simplex) continue;
        const Point leg = at - state_.sources[s].at;
        const double length = state_.slowness(in.medium) * norm(leg);
        take(number, {state_.sources[s].offset + length,
                      state_.chains.root(static_cast<Index>(root - roots.begin())), s, unit(leg),
                      length, state_.bit(in.medium)});
      }
    }
    for (const Index p : in.corner) {
      if (p == none) continue;
      for (const Index n : space_->nodes_at(p))
        for (const Label& label : state_.nodes[n].labels) {
          offers_.clear();
          extenders_[0].extend(n, label, number, offers_);
          take_all(offers_);
        }
    }
    go_by_edges();
    if (state_.nodes[number].best().distance < shortest.best().distance) {
      shortest = state_.nodes[number];
      best = in;
    }
  }
  set_attached(at, best.medium, best.beside);
  state_.nodes[number] = shortest;
  if (least != nullptr) *least = shortest.best().distance;
  queue_.clear();
}

double Solver::moved(Index node, const Label& label, const Point& at, const Point& beside) {
  const State::Root& root = state_.root_of(label);
  const State::Origin& source = state_.sources[root.source];
  if (const auto& medium = space_->media()[root.medium];
      state_.chains.is_root(label.chain) && medium.room) {
    const Point from = root.node == none
                           ? root.beside
                           : medium.room->beside(medium.in_room(root.node), at,
                                                 space_->point(state_.point_of(node)));
    if (!medium.room->sight().is_blocked(from, beside))
      return source.offset + medium.slowness * norm(at - source.at);
  }
  if (!state_.plain) state_.best[space_->points()] = State::unreached;
  set_attached(at, state_.medium_of(node), beside);
  return extenders_[0].moved(node, label, static_cast<Index>(space_->nodes()));
}

Solver::Path Solver::path(Index point) {
  const auto [node, label] = best(point);
  if (label == nullptr) return {};
  Path path;
  for (const Knot& knot : extenders_[0].string(node, *label).knots) {
    path.points.push_back(knot.at);
    path.media.push_back(knot.medium);
  }
  path.media.pop_back();
  return path;
}

std::size_t Solver::bytes() const {
  const auto of = [](const auto& v) { return v.capacity() * sizeof(v[0]); };
  std::size_t labels = 0;
  for (const VertexLabels& node : state_.nodes) labels += of(node.labels);
  std::size_t offers = offers_.bytes();
  for (const Turn& turn : turns_) offers += sizeof(Turn) + turn.offers.bytes();
  for (const Extender& extender : extenders_) offers += extender.bytes();
  return state_.chains.bytes() + of(state_.hints) + of(state_.nodes) + labels + of(state_.best) +
         of(state_.reach) + of(reached_) + queue_.bytes() + of(left_) + of(state_.sources) +
         of(state_.roots) + offers;
}

}  // namespace plexway::detail::strings
