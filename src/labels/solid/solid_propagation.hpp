#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include <plexway/solid/tet_mesh.hpp>
#include <plexway/solve/options.hpp>
#include <plexway/source/point_source.hpp>

#include "labels/wavefront.hpp"
#include "labels/workspace_state.hpp"

namespace plexway {

/// One propagation in a solid from seeds to the last label, for any rule and front.
template <class Real, class Rule, class Front>
class SolidPropagation {
 public:
  SolidPropagation(const TetMesh<Real>& mesh, Rule rule, Front& front,
                   const PropagateOptions& options)
      : mesh_(mesh),
        tets_(mesh.tets()),
        rule_(rule),
        front_(front),
        radius_(static_cast<Real>(options.radius / mesh.unit())) {
    front.expect_slow_steps();
  }

  void seed(const PointSource& source, Index number) {
    const Real sigma = static_cast<Real>(source.offset / mesh_.unit());
    if (source.vertex != none) {
      seed_vertex(mesh_.inside_vertex(source.vertex), sigma, number);
      return;
    }
    std::array<double, 4> b = source.barycentric;
    const auto [t, turned] = mesh_.inside_tet(source.simplex);
    if (turned) std::swap(b[2], b[3]);
    seed_inside(t, b, sigma, number);
  }

  /// The same by numbers and in the unit inside.
  void seed_inside(Index t, const std::array<double, 4>& b, Real sigma, Index number) {
    for (std::size_t i = 0; i < 4; ++i)
      if (b[i] == 1) {
        seed_vertex(tets_[t].corner[i], sigma, number);
        return;
      }
    rule_.seed_inside(t, b, sigma, number);
  }

  void seed_vertex(Index vertex, Real sigma, Index number) {
    for (const Index c : mesh_.corners_at(vertex)) rule_.seed_corner(c / 4, c % 4, sigma, number);
  }

  void run() {
    run([&](bool last_resort) { spread(last_resort); },
        [&](const auto& look) { look_everywhere(look); });
  }
  /// With other ways to expand all that waits, spread(last_resort), and to find what to repair:
  /// look(t) at least at all tetrahedra that `may_need_repair` names, in order.
  template <class Spread, class Search>
  void run(const Spread& spread_all, const Search& search) {
    int repairs = 0;
    do {
      spread_all(last_resort(repairs));
      if (front_.out_of_budget()) return;
    } while (repair(repairs, search));
  }

  // The parts of run, for those who do more in between.

  static bool last_resort(int repairs) { return repairs > 8; }
  /// All that waits nearer than the queue's horizon.
  void spread(bool last_resort) {
    Index t = 0;
    while (!spread_share(last_resort, t))
      if (!front_.take_stock(rule_.distance(t))) return;
  }
  /// When none waits. True if some wait again; `repairs` counts how often.
  bool repair(int& repairs) {
    return repair(repairs, [&](const auto& look) { look_everywhere(look); });
  }

  /// Does t lack a label or know a better one than a neighbour has? For searches.
  [[nodiscard]] bool may_need_repair(Index t) const {
    bool any = false;
    look_at(t, [&](Index, bool) { any = true; });
    return any;
  }

  /// Expands tetrahedra for the front of a thread.
  template <class Other>
  [[nodiscard]] auto expander(Other& front, bool last_resort) const {
    return Expander<Other>{*this, rule_.on(front), last_resort};
  }

  [[nodiscard]] Rule& rule() { return rule_; }
  [[nodiscard]] const Rule& rule() const { return rule_; }

 private:
  template <class Other>
  struct Expander {
    const SolidPropagation& propagation;
    decltype(std::declval<const Rule&>().on(std::declval<Other&>())) rule;
    bool last_resort;

    void operator()(Index t) const { propagation.expand(rule, t, last_resort); }
  };

  template <class Look>
  void look_everywhere(const Look& look) const {
    const Index tets = static_cast<Index>(mesh_.tet_count());
    for (Index t = 0; t < tets; ++t) look(t);
  }
  template <class Search>
  bool repair(int& repairs, const Search& search) {
    return pass_pinches() || (++repairs < 64 && repair_round(repairs, search));
  }

  /// The hot loop, until none waits (true) or the share of the budget is spent.
  bool spread_share(bool last_resort, Index& t) {
    const auto distance_of = [&](Index u) { return rule_.distance(u); };
    while (front_.next(t, distance_of)) expand(rule_, t, last_resort);
    return !front_.share_spent();
  }

  /// One tetrahedron, as far as the radius allows.
  template <class OnFront>
  [[gnu::always_inline]] void expand(const OnFront& rule, Index t, bool last_resort) const {
    if (rule.distance(t) > radius_) [[unlikely]]
      if (rule.distance(t) - rule.size(t) > radius_) return;
    rule.expand(t, last_resort);
  }

 public:
  /// A path may pass a vertex or an edge where tetrahedra only touch: it bends there. True if some
  /// tetrahedron got a better label.
  bool pass_pinches() {
    constexpr Real infinity = std::numeric_limits<Real>::infinity();
    // Within rounding of its own path a tetrahedron stays with that one; else this would not end.
    constexpr Real gain = 1 - 64 * std::numeric_limits<Real>::epsilon();
    bool any = false;
    for (const Index v : mesh_.pinched()) {
      Real best = infinity;
      Index number = none;
      for (const Index c : mesh_.corners_at(v)) {
        if (!front_.reached(c / 4)) continue;
        const Real d = rule_.corner_distance(c / 4, c % 4);
        if (d < best) best = d, number = front_.source(c / 4);
      }
      if (!(best < infinity) || best > radius_) continue;
      for (const Index c : mesh_.corners_at(v))
        if (!front_.reached(c / 4) || rule_.corner_distance(c / 4, c % 4) * gain > best)
          any |= rule_.seed_corner(c / 4, c % 4, best, number);
    }
    for (const auto& edge : mesh_.pinched_edges()) {
      const auto around = mesh_.pinched_edge_tets().subspan(edge.begin, edge.end - edge.begin);
      for (const Index t : around) {
        if (!front_.reached(t) || rule_.distance(t) - rule_.size(t) > radius_) continue;
        for (const Index u : around)
          if (u != t) any |= rule_.pass_edge(t, u, edge.vertex[0], edge.vertex[1], gain);
      }
    }
    return any;
  }

 private:
  /// Offers that miss a face where no path bends are dropped. Where that leaves a tetrahedron
  /// without a label, or with one much longer than a neighbour's and the way between, they are
  /// taken after all, with a bend on the face.
  template <class Search>
  bool repair_round(int round, const Search& search) {
    const std::size_t before = front_.updates();
    std::size_t unreached = 0;
    if (!rule_.drops() && front_.reached_count() == mesh_.tet_count()) return false;
    search([&](Index t) { unreached += repair_around(t); });
    // The last few are not worth another look at all.
    const std::size_t repaired = front_.updates() - before;
    return repaired > 0 && (unreached > 0 || (round < 4 && repaired > mesh_.tet_count() / 1024));
  }

  /// What a reached tetrahedron offers its neighbours all the same. How many of them are unreached.
  std::size_t repair_around(Index t) {
    std::size_t unreached = 0;
    look_at(t, [&](Index face, bool reached) {
      unreached += !reached;
      rule_.cross(t, face, true);
    });
    return unreached;
  }

  /// Calls found(face, reached) for each face of t whose neighbour there is to repair.
  template <class Found>
  [[gnu::always_inline]] void look_at(Index t, const Found& found) const {
    if (!front_.reached(t)) return;
    const Index tets = static_cast<Index>(mesh_.tet_count());
    const Real here = rule_.distance(t);
    if (here > radius_) return;
    for (Index i = 0; i < 4; ++i) {
      const Index u = tets_[t].across[i] >> TetAcross::tet_shift;
      if (u == tets) continue;
      const bool reached = front_.reached(u);
      if (reached) {
        // Not whether it is positive first: nobody can predict that.
        const Real excess = rule_.distance(u) - here;
        if (!(excess * std::abs(excess) > rule_.least_way2(t, u))) [[likely]]
          continue;
        if (!(excess > rule_.way(t, i))) continue;
      }
      found(i, reached);
    }
  }

  const TetMesh<Real>& mesh_;
  std::span<const TetRecord<Real>> tets_;
  Rule rule_;
  Front& front_;
  Real radius_;
};

}  // namespace plexway
