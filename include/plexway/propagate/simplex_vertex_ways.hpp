#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <vector>

#include <plexway/complex/simplicial_complex.hpp>
#include <plexway/propagate/simplex_label.hpp>
#include <plexway/propagate/simplex_way.hpp>

namespace plexway {

/// What vertices know beside simplices, for SimplexStringRule.
///
/// A simplex keeps the way that is best for its centre. Where two ways are about as long, all the
/// centres around a vertex may be on one side while the vertex, often on a wall, is on the other: the
/// way that is shorter for it may pass along a whole wall between that and the next centres. So each
/// vertex keeps the shortest way that it heard of, and tells those around it, simplices and
/// vertices, as far as nobody there has been told by a simplex already.
template <class Real, int N, class Rule>
class SimplexVertexWays {
 public:
  using Way = SimplexVertexWay<N>;

  SimplexVertexWays(Rule& rule, Way* ways) : rule_(rule), domain_(rule.domain()), ways_(ways) {}

  /// A vertex's way, after all around were asked; at +inf if there is none.
  const Way& at(Index v) const {
    look(v);
    return ways_[v];
  }

  /// All vertices look around, and tell each other until nobody gains. True if a simplex did.
  template <class Over>
  bool pass(double radius, const Over& over) {
    over(domain_.vertex_count(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) look(static_cast<Index>(v));
    });
    std::vector<Index> waiting;
    for (Index v = 0; v < domain_.vertex_count(); ++v)
      if (ways_[v].is_new && ways_[v].label.centre <= radius) waiting.push_back(v);
    std::sort(waiting.begin(), waiting.end(), [&](Index a, Index b) {
      const double to_a = ways_[a].label.centre, to_b = ways_[b].label.centre;
      return to_a != to_b ? to_a < to_b : a < b;
    });
    bool any = false;
    for (std::size_t i = 0; i < waiting.size(); ++i) any |= tell(waiting[i], radius, waiting);
    return any;
  }

 private:
  static constexpr Index sides = N + 1;
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  /// By so much a way must be shorter than another, or vertices would not come to an end.
  static constexpr double gain = 1 - 1e-10;

  /// The simplices around, if they know more than last time. Of those whose ways are the same one is
  /// asked, if that goes on to the vertex over the same faces.
  void look(Index v) const {
    Way& way = ways_[v];
    const auto& front = rule_.front();
    double known = 0;
    for (const Index c : domain_.corners_at(v))
      if (front.reached(c / sides)) known += front.label(c / sides).centre;
    if (known == way.seen) return;
    way.seen = known;
    way.is_new = true;
    constexpr std::size_t most = 12;
    Index asked[most];
    std::size_t count = 0;
    const auto& at = rule_.flat().positions[v];
    SimplexStringLabel<N> found;
    for (const Index c : domain_.corners_at(v)) {
      const Index s = c / sides;
      if (!front.reached(s)) continue;
      const auto& label = front.label(s);
      const double limit = way.label.centre * (1 - 1e-14);
      if (!(least_over<N>(rule_.flat(), label, rule_.centre(s), at) < limit)) continue;
      if (std::any_of(asked, asked + count, [&](Index other) {
            return front.source(other) == front.source(s) &&
                   same_way(front.label(other), label);
          }))
        continue;
      bool bent = false;
      if (rule_.reach(s, c % sides, limit, found, bent)) take(way, found, s, front.source(s));
      if (!bent && count < most) asked[count++] = s;
    }
  }
  static void take(Way& way, const SimplexStringLabel<N>& label, Index simplex, Index source) {
    way.label = label;
    way.simplex = simplex;
    way.source = source;
    way.is_new = true;
  }

  bool tell(Index v, double radius, std::vector<Index>& waiting) {
    if (!ways_[v].is_new || !(ways_[v].label.centre < infinity)) return false;
    ways_[v].is_new = false;
    Way way = ways_[v];
    bool any = false;
    // Around a corner as from a source: no string goes on that bends where its end is. Nor does one
    // where parts only touch.
    const bool is_pinched = contains(domain_.pinched(), v);
    const bool is_corner = contains(rule_.flat().corners, v);
    if (is_pinched || is_corner) {
      for (const Index c : domain_.corners_at(v))
        any |= rule_.seed_corner(c / sides, c % sides, static_cast<Real>(way.label.centre),
                                 way.source);
      if (is_pinched) return any;
      way.label = point_label<N>(rule_.flat().positions[v], way.label.centre);
      way.label.centre = way.label.sigma;
    }
    told_.clear();
    SimplexStringLabel<N> found;
    for (const Index c : domain_.corners_at(v)) {
      const Index t = c / sides;
      if (is_corner) {
        way.simplex = t;
        hold<N>(way.label, direction<N>(rule_.flat().positions[v], rule_.centre(t)));
      } else if (has(t, way)) {
        continue;
      } else if (!next_to(t, way)) {
        any |= rule_.offer_from(t, c % sides, way);
      }
      for (std::size_t k = 0; k < sides; ++k) {
        const Index w = domain_.records()[t].corner[k];
        if (w == v || std::find(told_.begin(), told_.end(), w) != told_.end()) continue;
        told_.push_back(w);
        if (around(w, way)) continue;
        Way& there = ways_[w];
        if (!rule_.reach_from(t, c % sides, k, way, there.label.centre * gain, found)) continue;
        const bool waits = there.is_new;
        take(there, found, t, way.source);
        if (!waits && there.label.centre <= radius) waiting.push_back(w);
      }
    }
    return any;
  }

  template <class Vertices>
  static bool contains(const Vertices& ascending, Index v) {
    return std::binary_search(ascending.begin(), ascending.end(), v);
  }
  /// Came the simplex's own way along that one?
  [[nodiscard]] bool has(Index s, const Way& way) const {
    const auto& front = rule_.front();
    return front.reached(s) && front.source(s) == way.source &&
           same_way(front.label(s), way.label);
  }
  /// Had it the offer from a neighbour?
  [[nodiscard]] bool next_to(Index s, const Way& way) const {
    for (const Index across : domain_.records()[s].across)
      if (across != none && has(across >> FacetAcross::simplex_shift, way)) return true;
    return false;
  }
  /// Had a vertex?
  [[nodiscard]] bool around(Index w, const Way& way) const {
    const auto corners = domain_.corners_at(w);
    return std::any_of(corners.begin(), corners.end(),
                       [&](Index c) { return has(c / sides, way); });
  }

  Rule& rule_;
  const SimplicialComplex<Real, N>& domain_;
  Way* ways_;
  std::vector<Index> told_;
};

}  // namespace plexway
