#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <limits>
#include <utility>
#include <vector>

#include <plexway/simplicial/simplicial_complex.hpp>

#include "labels/simplicial/simplex_label.hpp"
#include "labels/simplicial/simplex_way.hpp"

namespace plexway {

/// What vertices know beside simplices, for SimplexStringRule.
///
/// A simplex keeps the way that is best for its centre. Where two ways are about as long, all the
/// centres around a vertex may be on one side while the vertex, often on a wall, is on the other:
/// the way that is shorter for it may pass along a whole wall between that and the next centres. So
/// each vertex keeps the shortest way that it heard of, and as long as that is the best for some
/// vertex it is carried on through the simplices around, from centre to centre, whether they keep
/// it or not.
template <class Real, int N, class Rule>
class SimplexVertexWays {
 public:
  using Way = SimplexVertexWay<N>;
  using Label = SimplexStringLabel<N>;

  SimplexVertexWays(Rule& rule, Way* ways, SimplexTelling<N>* telling)
      : rule_(rule), domain_(rule.domain()), ways_(ways), telling_(*telling) {}

  /// A vertex's way, after all around were asked; at +inf if there is none.
  const Way& at(Index v) const {
    look(v);
    return ways_[v];
  }

  /// All vertices look around, and tell each other until nobody gains. True if a simplex did.
  /// report(simplices, distance) gets how many more were looked at and how far the vertex is, and
  /// may throw Cancelled.
  template <class Report>
  bool pass(double radius, const Report& report) {
    const auto report_at = [&](Index v) {
      const double distance = ways_[v].distance;
      report(domain_.corners_at(v).size(), distance < infinity ? distance : 0);
    };
    for (Index v = 0; v < domain_.vertex_count(); ++v) {
      report_at(v);
      look(v);
    }
    std::vector<Index>& waiting = telling_.waiting;
    waiting.clear();
    for (Index v = 0; v < domain_.vertex_count(); ++v)
      if (ways_[v].is_new && ways_[v].distance <= radius) waiting.push_back(v);
    std::sort(waiting.begin(), waiting.end(), [&](Index a, Index b) {
      const double to_a = ways_[a].distance, to_b = ways_[b].distance;
      return to_a != to_b ? to_a < to_b : a < b;
    });
    bool any = false;
    for (std::size_t i = 0; i < waiting.size(); ++i) {
      report_at(waiting[i]);
      any |= tell(waiting[i], radius, waiting);
    }
    return any;
  }

 private:
  static constexpr Index sides = N + 1;
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  /// By so much a way must be shorter than another, or vertices would not come to an end.
  static constexpr double gain = 1 - 1e-10;

  /// The simplices around, if they know more than last time. Of those whose ways are the same one
  /// is asked, if that goes on to the vertex over the same faces.
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
    for (const Index c : domain_.corners_at(v)) {
      const Index s = c / sides;
      if (!front.reached(s)) continue;
      const auto& label = front.label(s);
      const double limit = way.distance * (1 - 1e-14);
      if (!(least_over<N>(rule_.flat(), label, rule_.centre(s), at) < limit)) continue;
      if (std::any_of(asked, asked + count, [&](Index other) {
            return front.source(other) == front.source(s) && same_way(front.label(other), label);
          }))
        continue;
      bool bent = false;
      const double d = rule_.reach(label, s, c % sides, limit, bent);
      if (d < limit) take(way, label, d, s, front.source(s));
      if (!bent && count < most) asked[count++] = s;
    }
  }
  static void take(Way& way, const Label& label, double distance, Index simplex, Index source) {
    way.label = label;
    way.distance = distance;
    way.simplex = simplex;
    way.source = source;
    way.is_new = true;
  }

  bool tell(Index v, double radius, std::vector<Index>& waiting) {
    if (!ways_[v].is_new || !(ways_[v].distance < infinity)) return false;
    ways_[v].is_new = false;
    const Way way = ways_[v];
    bool any = false;
    // Around a corner, and where parts only touch, as from a source.
    if (contains(domain_.pinched(), v) || contains(rule_.flat().corners, v))
      for (const Index c : domain_.corners_at(v))
        any |= rule_.seed_corner(c / sides, c % sides, static_cast<Real>(way.distance), way.source);
    find_wanted(v, way);
    if (telling_.wanted.empty()) return any;

    const auto star = domain_.corners_at(v);
    const auto place = [&](Index s) {
      return static_cast<std::size_t>(
          std::find_if(star.begin(), star.end(), [s](Index c) { return c / sides == s; }) -
          star.begin());
    };
    telling_.star.assign(star.size(), {});
    telling_.line.assign(1, place(way.simplex));
    telling_.star[telling_.line[0]] = {way.label, true};
    for (std::size_t n = 0; n < telling_.line.size() && !telling_.wanted.empty(); ++n) {
      const Index s = star[telling_.line[n]] / sides;
      const Label from = telling_.star[telling_.line[n]].label;
      for (std::size_t facet = 0; facet < sides; ++facet) {
        const Index across = domain_.records()[s].across[facet];
        if (facet == star[telling_.line[n]] % sides || across == none) continue;
        const Index t = across >> FacetAcross::simplex_shift;
        const std::size_t at = place(t);
        if (std::exchange(telling_.star[at].seen, true)) continue;
        const bool is_wanted = std::erase_if(telling_.wanted, [t](const SimplexWanted& w) {
                                 return w.simplex == t;
                               }) > 0;
        Label& label = telling_.star[at].label;
        if (has(t, way)) {
          label = rule_.front().label(t);
        } else {
          if (!rule_.offer_around(from, s, facet, t, infinity, label)) continue;
          if (is_wanted) {
            any |= rule_.accept(t, across & FacetAcross::facet_mask, label, way.source);
            for (std::size_t k = 0; k < sides; ++k) give(t, k, label, way.source, radius, waiting);
          }
        }
        if (leads_on(label, way.source, t)) telling_.line.push_back(at);
      }
    }
    return any;
  }
  void give(Index t, std::size_t k, const Label& label, Index source, double radius,
            std::vector<Index>& waiting) {
    const Index w = domain_.records()[t].corner[k];
    Way& there = ways_[w];
    if (there.source == source && same_way(there.label, label)) return;
    const double limit = there.distance * gain;
    if (!(least_over<N>(rule_.flat(), label, rule_.centre(t), rule_.flat().positions[w]) < limit))
      return;
    bool bent;
    const double d = rule_.reach(label, t, k, limit, bent);
    if (!(d < limit)) return;
    const bool waits = there.is_new;
    take(there, label, d, t, source);
    if (!waits && d <= radius) waiting.push_back(w);
  }

  /// Those around v for which the way is the shorter one, or for a corner of theirs: first by
  /// bounds, as if nothing were in it, then by its string drawn on from v. (At walls the ends of
  /// strings and of faces are all within some clearances of v, so that string only tells whom to
  /// ask: what they get goes from centre to centre.)
  void find_wanted(Index v, const Way& way) const {
    const FlatDomain<N>& flat = rule_.flat();
    Taut<N> taut(flat);
    SimplexString<N> to_vertex(flat);
    bool is_drawn = false;
    const auto is_shorter = [&](Index t, const StringPoint<N>& to, double limit) {
      const StringPoint<N>& end = rule_.centre(way.simplex);
      if (!(least_over<N>(flat, way.label, end, to) < limit) ||
          !(least_around<N>(flat, way.label, end, to) < limit))
        return false;
      taut.start(way.label.source, to);
      for (std::size_t i = 0; i < way.label.bends; ++i)
        taut.add(way.label.face[i], way.label.along[i]);
      if (!(way.label.sigma + taut.solve() < limit)) return false;
      if (!std::exchange(is_drawn, true))
        rule_.draw_to_corner(way.label, way.simplex, v, to_vertex);
      SimplexString<N> string = to_vertex;
      string.add_point(plus(to, flat.clearance, direction<N>(to, rule_.centre(t))), to);
      return string.pull(limit - way.label.sigma) != SimplexString<N>::Pulled::longer;
    };
    auto& hearers = telling_.hearers;
    hearers.clear();
    for (const Index c : domain_.corners_at(v))
      if (const Index t = c / sides; !has(t, way))
        for (const Index w : domain_.records()[t].corner) hearers.push_back({w, t, false});
    std::sort(hearers.begin(), hearers.end(), [](const SimplexHearer& l, const SimplexHearer& r) {
      return l.vertex != r.vertex ? l.vertex < r.vertex : l.simplex < r.simplex;
    });
    hearers.erase(std::unique(hearers.begin(), hearers.end(),
                              [](const SimplexHearer& l, const SimplexHearer& r) {
                                return l.vertex == r.vertex;
                              }),
                  hearers.end());
    for (SimplexHearer& h : hearers)
      h.gains = gains(h.simplex, h.vertex, way.label, way.source, is_shorter);
    const auto any_gains = [&](Index t) {
      const auto& corners = domain_.records()[t].corner;
      return std::any_of(std::begin(corners), std::end(corners), [&](Index w) {
        return std::lower_bound(hearers.begin(), hearers.end(), w,
                                [](const SimplexHearer& h, Index x) { return h.vertex < x; })
            ->gains;
      });
    };
    telling_.wanted.clear();
    for (const Index c : domain_.corners_at(v)) {
      const Index t = c / sides;
      if (has(t, way)) continue;
      const bool centre = !was_offered(t, way);
      if (any_gains(t) || (centre && is_shorter(t, rule_.centre(t), rule_.to_beat(t))))
        telling_.wanted.push_back({t, centre});
    }
  }
  /// Might one of these gain yet by a label of s?
  [[nodiscard]] bool leads_on(const Label& label, Index source, Index s) const {
    const auto is_shorter = [&](Index, const StringPoint<N>& to, double limit) {
      return least_over<N>(rule_.flat(), label, rule_.centre(s), to) < limit;
    };
    return std::any_of(telling_.wanted.begin(), telling_.wanted.end(), [&](const SimplexWanted& t) {
      if (t.centre && is_shorter(t.simplex, rule_.centre(t.simplex), rule_.to_beat(t.simplex)))
        return true;
      const auto& corners = domain_.records()[t.simplex].corner;
      return std::any_of(std::begin(corners), std::end(corners),
                         [&](Index w) { return gains(t.simplex, w, label, source, is_shorter); });
    });
  }
  /// A neighbour that keeps the way has offered it already, as everything that is kept.
  [[nodiscard]] bool was_offered(Index t, const Way& way) const {
    const auto& across = domain_.records()[t].across;
    return std::any_of(std::begin(across), std::end(across), [&](Index other) {
      return other != none && has(other >> FacetAcross::simplex_shift, way);
    });
  }
  /// Would a corner of s that has another way?
  template <class IsShorter>
  [[nodiscard]] bool gains(Index s, Index w, const Label& label, Index source,
                           const IsShorter& is_shorter) const {
    const Way& there = ways_[w];
    return !(there.source == source && same_way(there.label, label)) &&
           is_shorter(s, rule_.flat().positions[w], there.distance * gain);
  }

  template <class Vertices>
  static bool contains(const Vertices& ascending, Index v) {
    return std::binary_search(ascending.begin(), ascending.end(), v);
  }
  /// Came the simplex's own way along that one?
  [[nodiscard]] bool has(Index s, const Way& way) const {
    const auto& front = rule_.front();
    return front.reached(s) && front.source(s) == way.source && same_way(front.label(s), way.label);
  }
  Rule& rule_;
  const SimplicialComplex<Real, N>& domain_;
  Way* ways_;
  SimplexTelling<N>& telling_;
};

}  // namespace plexway
