#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

#include "strings/flat/flat_space.hpp"
#include "strings/flat/flat_taut.hpp"
#include "strings/labels.hpp"

/// Shortest paths in flat domains of any dimension by strings, as Solver (solver.hpp) in solids:
/// places are faces of N - 2 dimensions.
namespace plexway::detail::strings {
/// A vertex as a source, or one that a path goes on from.
struct FlatRoot {
  Index vertex;
  double sigma;  ///< walked up to there
  Index source;
};

template <int N>
class FlatSolver {
 public:
  using Point = FlatPoint<N>;
  using Along = typename BendingFace<N>::Along;
  using Label = LabelIn<Point>;

  explicit FlatSolver(const FlatSpace<N>& space) : space_(&space), taut_(space.flat()) {}

  /// From vertices; false if the expansions ended before it did.
  bool solve(std::span<const FlatRoot> sources, const Limits& limits) {
    known_.assign(space_->vertices(), {});
    if (reach_.empty() && (limits.radius < infinity || sources.size() > 1)) measure_reach();
    roots_.assign(sources.begin(), sources.end());
    chains_.clear();
    hints_.clear();
    queue_.clear();
    counts_ = {};
    for (Index n = 0; n < sources.size(); ++n)
      take(sources[n].vertex, {sources[n].sigma, chains_.root(n), sources[n].source, {}, 0});
    while (!queue_.empty()) {
      const Queue::Offer next = queue_.pop();
      if (next.distance > limits.radius && next.distance > limits.radius + reach_[next.vertex])
        continue;
      const Label* found = known_[next.vertex].find(next.chain, next.distance);
      if (found == nullptr) continue;
      const std::size_t expansions = counts_.expansions;
      if (expansions >= limits.expansions) return false;
      if (limits.progress && expansions % 1024 == 0) limits.progress(expansions, next.distance);
      ++counts_.expansions;
      const Label label = *found;
      prepare(next.vertex, label);
      for (const Index w : space_->neighbours(next.vertex)) offer(next.vertex, label, w);
    }
    return true;
  }

  /// +inf where nothing leads.
  [[nodiscard]] double distance(Index vertex) const { return known_[vertex].best().distance; }
  [[nodiscard]] Index source(Index vertex) const { return known_[vertex].best().source; }
  [[nodiscard]] const Counts& counts() const { return counts_; }
  [[nodiscard]] std::size_t bytes() const {
    const auto of = [](const auto& v) { return v.capacity() * sizeof(v[0]); };
    std::size_t labels = 0;
    for (const auto& vertex : known_) labels += of(vertex.labels);
    return labels + chains_.bytes() + of(hints_) + of(known_) + of(roots_) + of(reach_) +
           queue_.bytes();
  }

 private:
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  static constexpr double rounding = 1e-9;
  static constexpr double behind = .5;          // a second label, at most so many edges
  static constexpr double cosine = .99;         // of last legs that are nearer one is of no use
  static constexpr std::size_t most_bends = 6;  // more cost far more and gain next to nothing

  /// A bend of a string.
  struct Bend {
    Index face;
    Along at;
    Point point;
  };
  /// Where a leg was free, a little inside the domain.
  struct Leg {
    Point from, to;
    bool known = false;  // it was seen to be free there
  };
  /// A string on its way to a new end.
  struct Attempt {
    Index root = none;
    Point from{}, to{};
    std::vector<Bend> bends;
    std::vector<Leg> legs;
    double length = 0;
    bool touched = false;  // something was put in
    [[nodiscard]] const Point& corner(std::size_t n) const {
      return n == 0 ? from : n > bends.size() ? to : bends[n - 1].point;
    }
  };
  enum class Outcome { free, longer, stuck };

  void measure_reach() {
    for (Index v = 0; v < space_->vertices(); ++v) {
      double longest = 0;
      for (const Index w : space_->neighbours(v)) {
        const Point way = minus(space_->point(w), space_->point(v));
        longest = std::max(longest, std::sqrt(inner(way, way)));
      }
      reach_.push_back(longest);
    }
  }
  [[nodiscard]] double limit(Index vertex, Index source, const Point& last, double length) const {
    return known_[vertex].limit(source, last, spread(vertex), length);
  }
  [[nodiscard]] Spread spread(Index vertex) const {
    return {behind, reach_.empty() ? 0 : Spread::nearest * reach_[vertex], cosine};
  }
  void take(Index vertex, const Label& label) {
    if (!known_[vertex].take(label, spread(vertex))) return;
    ++counts_.labels;
    queue_.push({label.distance, vertex, label.chain});
  }

  void pull(Attempt& a) {
    taut_.start(a.from, a.to);
    for (const Bend& bend : a.bends) taut_.add(bend.face, bend.at);
    a.length = taut_.solve();
    for (std::size_t i = 0; i < a.bends.size(); ++i) {
      a.bends[i].at = taut_.along(i);
      a.bends[i].point = space_->face(a.bends[i].face).at(a.bends[i].at);
    }
  }

  // The string to the vertex itself, whose legs are free.
  void prepare(Index vertex, const Label& label) {
    Attempt& a = base_;
    a.root = chains_.source(label.chain);
    a.from = space_->point(roots_[a.root].vertex);
    a.to = space_->point(vertex);
    a.bends.clear();
    for (Index c = label.chain; !chains_.is_root(c); c = chains_[c].parent) {
      const Index face = chains_[c].place;
      a.bends.push_back({face, hints_[c], space_->face(face).at(hints_[c])});
    }
    std::reverse(a.bends.begin(), a.bends.end());
    pull(a);
    // Pulled from elsewhere it is the same; else its legs are not known.
    const double distance = roots_[a.root].sigma + a.length;
    const bool same = std::abs(distance - label.distance) < rounding * (1 + label.distance);
    a.legs.clear();
    for (std::size_t i = 0; i <= a.bends.size(); ++i)
      a.legs.push_back({a.corner(i), a.corner(i + 1), true});
    for (std::size_t i = 0; i <= a.bends.size(); ++i)
      a.legs[i] = {end_of_leg(a, i, i + 1, vertex), end_of_leg(a, i + 1, i, vertex), same};
  }

  void offer(Index from, const Label& label, Index to) {
    auto& at = known_[to];
    if (at.knows(label.chain)) return;
    // The length of a chain is convex in where it ends.
    const Point way = minus(space_->point(to), space_->point(from));
    const double least = label.distance + inner(label.last, way);
    if (least >= limit(to, label.source, label.last, least)) return;
    const double edge = std::sqrt(inner(way, way));
    direct_ = (label.distance + edge) * (1 + rounding);
    from_ = from;
    bool shorter = false;
    const auto settled = [&](Outcome outcome) {
      if (outcome == Outcome::free) accept(attempt_, to);
      shorter = shorter || (outcome != Outcome::stuck &&
                            roots_[attempt_.root].sigma + attempt_.length < direct_);
    };
    attempt_ = base_;
    attempt_.touched = false;
    attempt_.to = space_->point(to);
    Outcome outcome = settle(attempt_, to, infinity);
    if (outcome != Outcome::longer) outcome = past_rims(attempt_, to, outcome);
    settled(outcome);
    // Where it was blocked it may come past on another side from another vertex.
    if (outcome != Outcome::stuck && !attempt_.touched && !at.empty()) at.remember(label.chain);
    if (shorter) return;
    for (const auto& [vertex, gate] : space_->gates_at(from)) {
      if (!base_.bends.empty() && base_.bends.back().face == gate) continue;
      attempt_ = base_;
      attempt_.to = space_->point(to);
      insert(attempt_, attempt_.bends.size(), gate, space_->face(gate).along_of(base_.to));
      settled(settle(attempt_, to, infinity));
    }
    if (shorter) return;
    // On from the vertex itself, along the edge.
    Label on = {label.distance + edge, none, label.source, unit(way), edge};
    if (!(on.distance < limit(to, on.source, on.last, on.distance))) return;
    roots_.push_back({from, label.distance, roots_[base_.root].source});
    on.chain = chains_.root(static_cast<Index>(roots_.size() - 1));
    take(to, on);
  }

  // Pulled, bends dropped and put in until all legs are free; no further if it is of no use, or as
  // long as `least`.
  Outcome settle(Attempt& a, Index to, double least) {
    constexpr int most = 32;
    for (int round = 0; round < most && a.bends.size() <= most_bends; ++round) {
      pull(a);
      if (drop_lifted(a, to)) continue;
      const double length = roots_[a.root].sigma + a.length;
      if (!(a.length < least) || !(length < direct_) ||
          !(length < limit(to, roots_[a.root].source, last_leg(a), length)))
        return Outcome::longer;
      const std::size_t leg = blocked(a, to);
      if (leg == a.legs.size()) return Outcome::free;
      if (!insert_touched(a, leg, to)) break;
    }
    return Outcome::stuck;
  }
  static Point last_leg(const Attempt& a) { return unit(minus(a.to, a.corner(a.bends.size()))); }

  // Where a leg between two corners of a string ends, off the boundary.
  Point end_of_leg(const Attempt& a, std::size_t corner, std::size_t other, Index to) const {
    const Point &toward = a.corner(other),
                &free = other > corner ? a.legs[corner].to : a.legs[other].from;
    if (corner > a.bends.size()) return space_->beside(to, toward, a.legs.back().to);
    if (corner == 0) return space_->beside(roots_[a.root].vertex, toward, free);
    return space_->beside(a.bends[corner - 1].face, a.bends[corner - 1].at, toward, free);
  }

  // Does a string press against the obstacle between the legs that it has at a bend? Angles count
  // from halfway between the walls, and on from where the leg was.
  bool drop_lifted(Attempt& a, Index to) {
    constexpr double pi = std::numbers::pi, slack = 1e-6;  // costs its square
    for (std::size_t i = a.bends.size(); i-- > 0;) {
      const BendingFace<N>& face = space_->face(a.bends[i].face);
      if (face.gate) continue;
      const auto angle = [&](const Point& d) {
        return std::atan2(inner(d, face.side), -inner(d, face.into));
      };
      const auto turned = [&](std::size_t end, std::size_t other, const Point& before) {
        const double now = angle(minus(end_of_leg(a, end, other, to), a.corner(i + 1)));
        if (inner(before, before) < 1e-18) return now;
        return now + 2 * pi * std::round((angle(before) - now) / (2 * pi));
      };
      const Leg &in = a.legs[i], &out = a.legs[i + 1];
      const double before = turned(i, i + 1, minus(in.from, in.to)),
                   behind_it = turned(i + 2, i + 1, minus(out.to, out.from));
      if (std::abs(before - behind_it) >= pi - slack) continue;
      drop(a, i, end_of_leg(a, i + 1, i, to));
      return true;
    }
    return false;
  }

  // The last leg that leaves the domain; as many as there are legs: none does.
  [[nodiscard]] std::size_t blocked(const Attempt& a, Index to) const {
    const auto moved = [](const Point& p, const Point& q) {
      return distance_of(p, q) > FlatSpace<N>::still;
    };
    for (std::size_t i = a.legs.size(); i-- > 0;) {
      if (a.bends.empty() && roots_[a.root].vertex == from_) continue;  // an edge
      const Point from = end_of_leg(a, i, i + 1, to), end = end_of_leg(a, i + 1, i, to);
      const Leg& leg = a.legs[i];
      if (leg.known && !moved(from, leg.from) && !moved(end, leg.to)) continue;
      if (space_->sight().is_blocked(from, end)) return i;
    }
    return a.legs.size();
  }
  bool insert_touched(Attempt& a, std::size_t n, Index to) {
    const Leg leg = a.legs[n];
    const Point from = end_of_leg(a, n, n + 1, to), end = end_of_leg(a, n + 1, n, to);
    const std::array<Index, 2> known = {n > 0 ? a.bends[n - 1].face : none,
                                        n < a.bends.size() ? a.bends[n].face : none};
    // It turns about the end that moved less.
    const bool backward = distance_of(leg.from, from) > distance_of(leg.to, end);
    const auto touch = backward ? space_->sight().touch(end, from, leg.from, known)
                                : space_->sight().touch(from, end, leg.to, known);
    if (!touch) return false;
    a.touched = true;
    insert(a, n, touch->face, touch->at);
    return true;
  }
  // One more bend in leg n.
  void insert(Attempt& a, std::size_t n, Index face, const Along& at) const {
    const Leg leg = a.legs[n];
    const auto beside = [&](const Point& other) { return space_->beside(face, at, other, other); };
    const auto before = static_cast<std::ptrdiff_t>(n);
    const Point in = beside(a.corner(n)), out = beside(a.corner(n + 1));
    a.bends.insert(a.bends.begin() + before, {face, at, space_->face(face).at(at)});
    a.legs[n] = {leg.from, in, false};
    a.legs.insert(a.legs.begin() + before + 1, {out, leg.to, false});
  }
  // Without a bend; the leg that is left was free to there.
  static void drop(Attempt& a, std::size_t n, const Point& beside) {
    const auto at = static_cast<std::ptrdiff_t>(n);
    a.legs[n] = {a.legs[n].from, beside, false};
    a.legs.erase(a.legs.begin() + at + 1);
    a.bends.erase(a.bends.begin() + at);
  }

  // Where a string is held at the rim of a face it may be shorter over another one that is there.
  Outcome past_rims(Attempt& a, Index to, Outcome outcome) {
    for (std::size_t i = a.bends.size(); i-- > 0;) {
      if (!space_->is_at_rim(a.bends[i].face, a.bends[i].at)) continue;
      const Point rim = a.bends[i].point;
      const auto is_there = [&](std::size_t n) {
        return distance_of(a.bends[n].point, rim) < FlatSpace<N>::still;
      };
      std::size_t begin = i, end = i + 1;
      while (begin > 0 && is_there(begin - 1)) --begin;
      while (end < a.bends.size() && is_there(end)) ++end;
      const Index own = end == begin + 1 ? a.bends[begin].face : none;
      const Point beside = end_of_leg(a, begin + 1, begin, to);
      constexpr double gain = 1e-6;  // less is only pulled better
      const double least = outcome == Outcome::free ? a.length * (1 - gain) : infinity;
      bool better = false;
      const auto try_over = [&](Index face) {
        other_ = a;
        for (std::size_t n = end; n-- > begin;) drop(other_, n, beside);
        if (face != none) insert(other_, begin, face, space_->face(face).along_of(rim));
        better = settle(other_, to, least) == Outcome::free;
      };
      space_->faces_at(rim, [&](Index face) {
        if (!better && face != own) try_over(face);
      });
      if (!better && own == none) try_over(none);
      if (better) {  // from the end again
        std::swap(a, other_);
        outcome = Outcome::free;
        i = a.bends.size();
      } else {
        i = begin;
      }
    }
    return outcome;
  }

  void accept(const Attempt& a, Index to) {
    Index chain = chains_.root(a.root);
    for (const Bend& bend : a.bends) {
      chain = chains_.with(chain, bend.face);
      hints_.resize(chains_.size());
      hints_[chain] = bend.at;
    }
    known_[to].remember(chain);
    const Point leg = minus(a.to, a.corner(a.bends.size()));
    take(to, {roots_[a.root].sigma + a.length, chain, roots_[a.root].source, last_leg(a),
              std::sqrt(inner(leg, leg))});
  }

  const FlatSpace<N>* space_;
  Taut<N> taut_;
  std::vector<FlatRoot> roots_;  // the sources first
  Chains chains_;
  std::vector<Along> hints_;  // of a chain: where its last bend was at last
  std::vector<VertexLabelsIn<Point>> known_;
  std::vector<double> reach_;  // of vertices: their longest edge; none from one source
  Queue queue_;
  Attempt base_, attempt_, other_;
  Index from_ = none;  // the vertex that offers
  double direct_ = 0;  // on from there along the edge: a string that is offered is no longer
  Counts counts_;
};

}  // namespace plexway::detail::strings
