#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include <plexway/solve/options.hpp>

#include "kernel/hinge.hpp"
#include "labels/simplicial/simplex_cells.hpp"
#include "labels/simplicial/simplex_label.hpp"

namespace plexway::detail {

#include "kernel/text_begin.inl"

/// The plain step on solids and complexes of any dimension N: the hinge kernel with K = N - 1, word
/// for word, on labels that hold nothing but squared lengths. Policies: upper_bound aims at the
/// apex, which measures only paths that exist; every other at the centroid, the literal step of
/// GSP.
///
/// If the straight line from S to the probe passes the facet, S is kept; if not, the path bends on
/// the facet's boundary. Every offer counts, also where the domain is flat and another strip of
/// simplices will bring a straight line: that one then wins. Where a line passes a facet's boundary
/// exactly, as in grids, rounding must not decide: lines may miss by a tolerance, and a bend is
/// made longer by more than rounding, so that of equal paths the straight one wins.
template <class Cells, class Front>
class PlainSimplexRule : kernel::HingeKernel<typename Cells::Real, Cells::N - 1> {
  using Real = typename Cells::Real;
  using Kernel = kernel::HingeKernel<Real, Cells::N - 1>;
  using Kernel::K, Kernel::KE, Kernel::make_pose, Kernel::locate, Kernel::carry, Kernel::behind,
      Kernel::vertex_point, Kernel::distance_squared;
  using typename Kernel::HingePose, typename Kernel::HingePoint, typename Kernel::HingeStep;

 public:
  static constexpr int N = Cells::N;
  using Label = SimplexLabel<Real, N>;

  PlainSimplexRule(const Cells& cells, Front& front, Visibility policy = Visibility::centroid)
      : cells_(cells),
        facet_tolerance(cells.tolerance()),
        to_apex_(policy == Visibility::upper_bound),
        front_(&front) {}

  [[nodiscard]] const Cells& cells() const { return cells_; }
  [[nodiscard]] Real distance(Index s) const { return front_->label(s).centre; }
  [[nodiscard]] Real corner_distance(Index s, Index i) const {
    return front_->label(s).sigma + std::sqrt(front_->label(s).distance2[i]);
  }
  /// At least the longest way from the centre to a corner.
  [[nodiscard]] Real size(Index s) const {
    Real longest = 0;
    for (Index e = 0; e < N * (N + 1) / 2; ++e) longest = std::max(longest, squared_edge(s, e));
    return std::sqrt(longest);
  }

  /// An update counts if the centre is nearer than this share of its distance. 1 but where lengths
  /// of no flat simplices would have it go on for ever.
  void set_patience(Real share) { patience_ = share; }

  /// Offers to all neighbours but the one the path came from.
  void expand(Index s) {
    const Index in = static_cast<Index>(front_->hinge(s));
    for (Index i = 0; i <= N; ++i)
      if (i != in) cross(s, i, false);
  }

#include "labels/simplicial/plain_step.inl"

  bool seed_corner(Index s, Index i, Real sigma, Index source) {
    Label label;
    for (Index j = 0; j <= N; ++j)
      label.distance2[j] = i == j ? 0 : squared_edge(s, edge_between(i, j));
    return accept(s, i == N ? 0 : i + 1, label, sigma, source);
  }

  /// A point of a simplex, by its barycentric coordinates.
  void seed_inside(Index s, const std::array<double, N + 1>& b, Real sigma, Index source) {
    const auto distance2 = corner_distances2(cells_, s, b);
    Label label;
    for (std::size_t i = 0; i <= N; ++i) label.distance2[i] = static_cast<Real>(distance2[i]);
    // Farther from the centre than another source here, it may still be the nearer one beyond.
    const bool better = accept(s, 0, label, sigma, source);
    const Label kept = front_->label(s);
    const Index kept_source = front_->source(s);
    if (!better) {
      front_->put(s, label);
      front_->set_source(s, source);
    }
    for (Index i = 0; i <= N; ++i) cross(s, i, true);
    front_->put(s, kept);
    front_->set_source(s, kept_source);
  }

  /// Labels of u offer a path over the edge (v, w) of t, which touches u in that edge only.
  bool pass_edge(Index u, Index t, Index v, Index w) {
    using Edge = kernel::HingeKernel<Real, 1>;
    const Index u0 = corner_of(u, v), u1 = corner_of(u, w);
    const Index t0 = corner_of(t, v), t1 = corner_of(t, w);
    const Real e2[1] = {squared_edge(t, edge_between(t0, t1))};
    const auto pose = Edge::make_pose(e2);
    const Real s2[2] = {front_->label(u).distance2[u0], front_->label(u).distance2[u1]};
    const auto S = Edge::locate(pose, s2);
    const auto off = [&](Index i) {
      const Real i2[2] = {squared_edge(t, edge_between(t0, i)),
                          squared_edge(t, edge_between(t1, i))};
      return Edge::locate(pose, i2);
    };
    // The best point of the edge for the farther of the others: its distances are then exact.
    Label best;
    best.centre = std::numeric_limits<Real>::infinity();
    Index hinge = 0;
    for (Index i = 0; i <= N; ++i) {
      if (i == t0 || i == t1) continue;
      hinge = i;
      const auto c = Edge::crossing(S, off(i));
      auto b = Edge::vertex_point(pose, 0);
      b.x[0] = std::clamp(c.x[0] / c.w, Real(0), Real(1));
      Label label;
      for (Index j = 0; j <= N; ++j)
        label.distance2[j] = Edge::distance_squared(
            pose, b, j == t0 || j == t1 ? Edge::vertex_point(pose, j == t1 ? 1 : 0) : off(j));
      label.sigma = front_->label(u).sigma + std::sqrt(Edge::distance_squared(pose, S, b));
      label.centre = centre_distance(t, label);
      if (label.centre < best.centre) best = label;
    }
    // By more than rounding; else this would not end.
    constexpr Real gain = 1 - 64 * std::numeric_limits<Real>::epsilon();
    if (!(best.centre < distance_or_inf(t) * gain)) return false;
    return take(t, hinge, best, front_->source(u));
  }

 private:
  // By a vertex all paths bend, so none is favoured: sums along them are compared to the last bit.
  static constexpr Real rounding = K == 0 ? Real(0) : std::numeric_limits<Real>::epsilon();
  static constexpr Real bend_penalty = 1 + 32 * rounding, gain = 1 - 16 * rounding;

  // What the text of the step calls.
  static Real max(Real a, Real b) { return kernel::max(a, b); }
  static Real min(Real a, Real b) { return kernel::min(a, b); }
  static Real sqrt(Real a) { return kernel::sqrt(a); }
  [[nodiscard]] Index vertex_of(Index s, Index i) const { return cells_.vertex_of(s, i); }
  [[nodiscard]] Real squared_edge(Index s, Index edge) const {
    return cells_.squared_edge(s, edge);
  }
  [[nodiscard]] Index corner_of(Index s, Index vertex) const {
    Index i = 0;
    while (vertex_of(s, i) != vertex) ++i;
    return i;
  }
  [[nodiscard]] Index corner_beyond(Index s, Index facet, Index n, Index t, Index i) const {
    if constexpr (Cells::in_one_order)
      return n + (n >= facet);
    else
      return corner_of(s, vertex_of(t, i));
  }
  static constexpr Index edge_between(Index i, Index j) {
    return i < j ? j * (j - 1) / 2 + i : i * (i - 1) / 2 + j;
  }

  [[nodiscard]] Real distance_or_inf(Index s) const {
    return front_->reached(s) ? distance(s) : std::numeric_limits<Real>::infinity();
  }
  [[nodiscard]] bool is_better(Index s, const Label& label) const {
    return label.centre < distance_or_inf(s) * (gain * patience_);
  }

  /// Over one facet, to every simplex there; `inside`: the label's source is in s.
  void cross(Index s, Index facet, bool inside) {
    cells_.over(s, facet, [&](Index t, Index apex) {
      const Label& from = front_->label(s);
      const PlainHinge hinge = pose_facet(from, s, facet, t, apex);
      const Label straight = offer_straight(from, hinge, t, apex);
      if (!is_better(t, straight)) return;
      take(t, apex, offer_seen(from, straight, hinge, s, facet, t, apex, inside, to_apex_),
           front_->source(s));
    });
  }

  bool accept(Index s, Index in, Label& label, Real sigma, Index source) {
    label.sigma = sigma;
    label.centre = centre_distance(s, label);
    return take(s, in, label, source);
  }
  bool take(Index s, Index in, const Label& label, Index source) {
    if (!is_better(s, label)) return false;
    front_->accept(s, in, label, label.centre, source);
    for (Index i = 0; i <= N; ++i)  // what it needs when its turn comes
      cells_.over(s, i, [&](Index t, Index) {
        cells_.prefetch(t);
        __builtin_prefetch(&front_->label(t));
      });
    return true;
  }

  Cells cells_;
  Real facet_tolerance;  // by the name that the text of the step has
  bool to_apex_;
  Real patience_ = 1;
  Front* front_;
};

#include "kernel/text_end.inl"

}  // namespace plexway::detail
