#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include <plexway/solve/options.hpp>
#include <plexway/solve/probe_table.hpp>
#include <plexway/surface/detail/triangle_record.hpp>

#include "kernel/hinge.hpp"
#include "labels/simplicial/simplex_label.hpp"

namespace plexway::detail {

/// Where the plain step aims: the share of the centroid in the probe, 1 the centroid itself, 0 the
/// apex. Small and by value, so that a rule has it at hand.
template <class Real>
class ProbeAim {
 public:
  ProbeAim(Visibility policy, const ProbeTable& table)
      : policy_(policy),
        slender_(static_cast<Real>(table.slender)),
        uneven_(static_cast<Real>(table.uneven)),
        low_(static_cast<Real>(table.low)) {
    for (std::size_t i = 0; i < 6; ++i) share_[i] = static_cast<Real>(table.share[i]);
  }

  /// Of a triangle with these edges, `shared` the one that a path comes in by, `height` over it.
  [[nodiscard]] Real share(Real shared, Real second, Real third, Real height) const {
    if (policy_ == Visibility::upper_bound) return Real(0);
    if (policy_ != Visibility::tuned) return Real(1);
    return share_[entry(shared, second, third, height)];
  }

  /// Which entry of the table.
  [[nodiscard]] std::size_t entry(Real shared, Real second, Real third, Real height) const {
    const Real longest = std::max({shared, second, third});
    const Real shortest = std::min({shared, second, third});
    const std::size_t row = longest > slender_ * shared ? 2 : longest > uneven_ * shortest ? 1 : 0;
    return row + (height < low_ * shared ? 3 : 0);
  }

 private:
  Visibility policy_;
  Real slender_, uneven_, low_, share_[6];
};

/// The plain step on triangles, for the policies that look at one hinge at a time (centroid, tuned,
/// upper_bound): the K = 1 hinge kernel, word for word, on labels that hold nothing but squared
/// lengths. Steps for other dimensions differ in K and in the records they read.
template <class Real, class Front>
class PlainRule {
 public:
  using Label = SimplexLabel<Real, 2>;
  using Kernel = kernel::HingeKernel<Real, 1>;
  using Point = typename Kernel::HingePoint;

  PlainRule(std::span<const TriangleRecord<Real>> triangles, Front& front, Visibility policy,
            const ProbeTable& table)
      : PlainRule(triangles, front, ProbeAim<Real>(policy, table)) {}
  PlainRule(std::span<const TriangleRecord<Real>> triangles, Front& front,
            const ProbeAim<Real>& aim)
      : triangles_(triangles.data()),
        sentinel_(static_cast<Index>(triangles.size() - 1)),
        front_(front),
        aim_(aim) {}

  [[nodiscard]] Real distance(Index f) const { return front_.label(f).centre; }
  [[nodiscard]] Real distance_or_inf(Index f) const {
    return front_.reached(f) ? distance(f) : std::numeric_limits<Real>::infinity();
  }

  template <class Full>
  void expand(Index f, Full full) const {
    const std::size_t in = front_.hinge(f);
    full(f, in == 0 ? 2 : in - 1);
    full(f, in == 2 ? 0 : in + 1);
  }
  [[nodiscard]] PlainRule on(Front&) const { return *this; }  // it only goes by `full`
  /// The same rule on the front of another executor.
  template <class Other>
  [[nodiscard]] PlainRule<Real, Other> on(Other& front) const {
    return PlainRule<Real, Other>({triangles_, sentinel_ + std::size_t{1}}, front, aim_);
  }

  /// The same rule over other triangles.
  template <class Other>
  [[nodiscard]] PlainRule<Real, Other> over(std::span<const TriangleRecord<Real>> triangles,
                                            Other& front) const {
    return PlainRule<Real, Other>(triangles, front, aim_);
  }

  /// Over one edge, to every triangle there. (A plain step never drops an update: there is no last
  /// resort to take.)
  void cross(Index f, std::size_t side, bool) {
    const int edge = static_cast<int>(side);
    for (Index across = triangles_[f].across[edge];;) {
      const Index g = across >> Across::face_shift;
      const int k = static_cast<int>(across & Across::edge_mask);
      if (g == sentinel_ || (g == f && k == edge)) break;
      // Which end of g's edge is which end of ours; flips add up around a fan.
      flip_ = across == triangles_[f].across[edge] ? (across & Across::flip) != 0 : flip_;
      enter(f, edge, g, k, flip_);
      if (!(across & Across::fan)) break;
      across = triangles_[g].across[k];
      flip_ = flip_ == ((across & Across::flip) != 0);
    }
  }

  bool seed_corner(Index f, std::size_t i, Real sigma, Index source) {
    const TriangleRecord<Real>& t = triangles_[f];
    Label label;
    label.distance2[i] = 0;
    label.distance2[(i + 1) % 3] = t.length[i] * t.length[i];
    label.distance2[(i + 2) % 3] = t.length[(i + 2) % 3] * t.length[(i + 2) % 3];
    return seed(f, i, label, sigma, source);
  }

  void seed_inside(Index f, Real x, Real y, Real sigma, Index source) {
    const TriangleRecord<Real>& t = triangles_[f];
    const Real px[3] = {0, t.length[0], t.apex_x(0)}, py[3] = {0, 0, t.apex_h(0)};
    Label label;
    for (int i = 0; i < 3; ++i)
      label.distance2[i] = (px[i] - x) * (px[i] - x) + (py[i] - y) * (py[i] - y);
    inside_ = f;
    if (seed(f, 0, label, sigma, source)) cross(f, 0, false);
    inside_ = none;
  }

  [[nodiscard]] Real corner_distance(Index f, std::size_t i) const {
    return front_.label(f).sigma + std::sqrt(front_.label(f).distance2[i]);
  }

 private:
  /// Leibniz: the mean squared distance from the corners less that of the centroid.
  static Real centre_distance(const TriangleRecord<Real>& t, const Label& label) {
    Real edges = 0;
    for (const Real l : t.length) edges += l * l;
    const Real mean = (label.distance2[0] + label.distance2[1] + label.distance2[2]) / 3;
    return label.sigma + std::sqrt(std::max(mean - edges / 9, Real(0)));
  }

  bool seed(Index f, std::size_t in, Label& label, Real sigma, Index source) {
    label.sigma = sigma;
    label.centre = centre_distance(triangles_[f], label);
    if (!(label.centre < distance_or_inf(f))) return false;
    front_.accept(f, in, label, label.centre, source);
    return true;
  }

  void enter(Index f, int edge, Index g, int k, bool flip) {
    const TriangleRecord<Real>& U = triangles_[f];
    const TriangleRecord<Real>& T = triangles_[g];
    const Label& from = front_.label(f);
    const int last = (k + 2) % 3, next = (k + 1) % 3;
    const Real edge2[1] = {T.length[k] * T.length[k]};
    const auto pose = Kernel::make_pose(edge2);

    // Ends of the hinge in T's order, the apexes of both triangles over it.
    const int first_of_U = flip ? edge : (edge + 1) % 3, second_of_U = flip ? (edge + 1) % 3 : edge;
    const Real s2[2] = {from.distance2[first_of_U], from.distance2[second_of_U]};
    const Point S = Kernel::locate(pose, s2);
    const Real a2[2] = {T.length[last] * T.length[last], T.length[next] * T.length[next]};
    const Point apex = Kernel::locate(pose, a2);
    const int U_first = flip ? (edge + 2) % 3 : (edge + 1) % 3;  // U's edges at those ends
    const int U_second = flip ? (edge + 1) % 3 : (edge + 2) % 3;
    const Real u2[2] = {U.length[U_first] * U.length[U_first],
                        U.length[U_second] * U.length[U_second]};
    const Point u = Kernel::locate(pose, u2);
    const bool behind =
        f != inside_ && Kernel::behind(pose, S, u, from.distance2[(edge + 2) % 3]) > 0;

    const Real share = aim_.share(T.length[k], T.length[next], T.length[last], apex.h) / 3;
    Point probe = apex;  // on the way from the apex to the centroid
    probe.x[0] += share * (1 - 2 * apex.x[0]);
    probe.h -= share * 2 * apex.h;

    const auto step = Kernel::carry(pose, S, from.sigma, probe, behind, Real(0));
    Label label;
    const Point& B = step.source;
    label.distance2[k] =
        step.visible ? s2[0] : Kernel::distance_squared(pose, B, Kernel::vertex_point(pose, 0));
    label.distance2[next] =
        step.visible ? s2[1] : Kernel::distance_squared(pose, B, Kernel::vertex_point(pose, 1));
    label.distance2[last] = Kernel::distance_squared(pose, B, apex);
    seed(g, static_cast<std::size_t>(k), label, step.sigma, front_.source(f));
  }

  const TriangleRecord<Real>* triangles_;
  Index sentinel_;
  Front& front_;
  ProbeAim<Real> aim_;
  Index inside_ = none;  // the triangle a source lies in, while its own edges are crossed
  bool flip_ = false;
};

}  // namespace plexway::detail
