#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

#include <plexway/solve/options.hpp>
#include <plexway/source/point_source.hpp>

#include "labels/simplicial/simplex_rule.hpp"

namespace plexway::detail {

/// One propagation over a solid or a complex of any dimension, from seeds to the last label.
template <class Domain, class Front>
class SimplexPropagation {
 public:
  using Cells = SimplexCells<Domain>;
  using Real = typename Cells::Real;
  using Rule = PlainSimplexRule<Cells, Front>;

  SimplexPropagation(const Domain& domain, Front& front, const PropagateOptions& options)
      : domain_(domain),
        rule_(Cells(domain), front, options.visibility),
        front_(front),
        radius_(static_cast<Real>(options.radius / domain.unit())) {
    front.expect_slow_steps();
  }

  void seed(const PointSource& source, Index number) {
    const Real sigma = static_cast<Real>(source.offset / domain_.unit());
    if (source.vertex != none) {
      for (const Index c : domain_.corners_at(domain_.inside_vertex(source.vertex)))
        rule_.seed_corner(c / sides, c % sides, sigma, number);
      return;
    }
    const auto [s, b] = Cells::inside(domain_, source);
    // To all simplices that have the corners it lies between: over a facet that holds the source
    // its height would come out as the square root of rounding.
    const auto support = static_cast<Index>(
        std::find_if(b.begin(), b.end(), [](double x) { return x > 0; }) - b.begin());
    for (const Index c : domain_.corners_at(vertex(s, support))) {
      std::array<double, sides> there{};
      if (c / sides == s ? (there = b, true) : holds(c / sides, s, b, there))
        rule_.seed_inside(c / sides, there, sigma, number);
    }
  }

  void run() {
    do {
      spread();
    } while (!front_.out_of_budget() && pass_pinches());
  }

  /// A path may pass a vertex or an edge where simplices only touch: it bends there. True if some
  /// simplex got a better label.
  bool pass_pinches() {
    bool any = false;
    for (const Index v : domain_.pinched()) any |= pass(v);
    if constexpr (requires { domain_.pinched_edges(); })
      for (const auto& edge : domain_.pinched_edges()) {
        const auto around = domain_.pinched_edge_tets().subspan(edge.begin, edge.end - edge.begin);
        for (const Index s : around) {
          if (!front_.reached(s) || rule_.distance(s) - rule_.size(s) > radius_) continue;
          for (const Index t : around)
            if (s != t) any |= rule_.pass_edge(s, t, edge.vertex[0], edge.vertex[1]);
        }
      }
    return any;
  }

  [[nodiscard]] const Rule& rule() const { return rule_; }

 private:
  static constexpr Index sides = Cells::N + 1;

  [[nodiscard]] Index vertex(Index s, Index i) const { return rule_.cells().vertex_of(s, i); }

  /// Has t the corners of s that a point lies between? If so, its coordinates there.
  bool holds(Index t, Index s, const std::array<double, sides>& b,
             std::array<double, sides>& there) const {
    for (Index i = 0; i < sides; ++i) {
      if (b[i] == 0) continue;
      Index j = 0;
      while (j < sides && vertex(t, j) != vertex(s, i)) ++j;
      if (j == sides) return false;
      there[j] = b[i];
    }
    return true;
  }

  void spread() {
    const auto distance_of = [&](Index s) { return rule_.distance(s); };
    for (Index s = 0;;) {
      while (front_.next(s, distance_of)) expand(s);
      if (!front_.share_spent() || !front_.take_stock(rule_.distance(s))) return;
      limit(front_.updates());
    }
  }

  /// One simplex, as far as the radius allows.
  void expand(Index s) {
    if (rule_.distance(s) > radius_) [[unlikely]]
      if (rule_.distance(s) - rule_.size(s) > radius_) return;
    rule_.expand(s);
  }

  /// One or two updates a simplex are usual, ten are many. Lengths that no flat simplices have can
  /// make a path shorter each time around, without end: from 128 updates a simplex on they must
  /// gain more and more.
  void limit(std::size_t updates) {
    const double more =
        static_cast<double>(updates) / (128 * static_cast<double>(domain_.simplex_count()));
    if (more > 1) rule_.set_patience(std::max(static_cast<Real>(2 - more), Real(1e-20)));
  }

  bool pass(Index v) {
    Real best = std::numeric_limits<Real>::infinity();
    Index number = none;
    for (const Index c : domain_.corners_at(v)) {
      if (!front_.reached(c / sides)) continue;
      const Real d = rule_.corner_distance(c / sides, c % sides);
      if (d < best) best = d, number = front_.source(c / sides);
    }
    if (!(best < std::numeric_limits<Real>::infinity()) || best > radius_) return false;
    // Within rounding of its own path it stays with that one; else this would not end.
    constexpr Real gain = 1 - 64 * std::numeric_limits<Real>::epsilon();
    bool any = false;
    for (const Index c : domain_.corners_at(v))
      if (!front_.reached(c / sides) || rule_.corner_distance(c / sides, c % sides) * gain > best)
        any |= rule_.seed_corner(c / sides, c % sides, best, number);
    return any;
  }

  const Domain& domain_;
  Rule rule_;
  Front& front_;
  Real radius_;
};

}  // namespace plexway::detail
