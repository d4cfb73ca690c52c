#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <plexway/solid/tet_mesh.hpp>
#include <plexway/solve/options.hpp>

#include "kernel/hinge.hpp"
#include "labels/solid/plain_solid_label.hpp"

namespace plexway {

#include "kernel/text_begin.inl"

/// The plain step in solids: the K = 2 hinge kernel on labels that hold nothing but squared
/// lengths. A path may bend on any face. Probing the centroid is the literal step of GSP; probing
/// the apex (Visibility::upper_bound) measures only paths that exist: if a face is seen whole, and
/// the apex through it, then so is all of the tetrahedron.
template <class Real, class Front>
class PlainSolidRule : kernel::HingeKernel<Real, 2> {
  using Kernel = kernel::HingeKernel<Real, 2>;
  using Kernel::K, Kernel::KE, Kernel::make_pose, Kernel::locate, Kernel::carry, Kernel::behind,
      Kernel::vertex_point, Kernel::distance_squared;
  using typename Kernel::HingePose, typename Kernel::HingePoint, typename Kernel::HingeStep;

 public:
  using Label = PlainSolidLabel<Real>;

  PlainSolidRule(const TetMesh<Real>& mesh, Front& front, Visibility policy = Visibility::centroid)
      : mesh_(&mesh),
        tets_(mesh.tets().data()),
        points_(mesh.points().data()),
        lengths_(mesh.squared_lengths().data()),
        sentinel_(static_cast<Index>(mesh.tet_count())),
        embedded_(mesh.embedded()),
        face_tolerance(embedded_ || mesh.summary().notch_edges > 0 ? rounding : Real(0.1)),
        policy_(policy),
        front_(&front) {}
  /// The same rule on the front of another executor.
  template <class Other>
  [[nodiscard]] PlainSolidRule<Real, Other> on(Other& front) const {
    return PlainSolidRule<Real, Other>(*mesh_, front, policy_);
  }

  [[nodiscard]] Real distance(Index t) const { return front_->label(t).centre; }
  [[nodiscard]] Real distance_or_inf(Index t) const {
    return front_->reached(t) ? distance(t) : std::numeric_limits<Real>::infinity();
  }
  /// At least the longest way from the centre to a corner.
  [[nodiscard]] Real size(Index t) const {
    Real longest = 0;
    for (Index e = 0; e < 6; ++e) longest = std::max(longest, squared_edge(t, e));
    return std::sqrt(longest);
  }
  /// Nothing is ever dropped, so nothing is ever too long.
  [[nodiscard]] Real way(Index, Index) const { return std::numeric_limits<Real>::infinity(); }

  [[nodiscard]] bool drops() const { return false; }
  [[nodiscard]] Real least_way2(Index, Index) const {
    return std::numeric_limits<Real>::infinity();
  }

  void expand(Index t, bool) const {
    const Index in = static_cast<Index>(front_->hinge(t));
    for (Index i = 0; i < 4; ++i)
      if (i != in) cross(t, i, false);
  }

#include "labels/solid/plain_solid_step.inl"

  void cross(Index t, Index face, bool) const {
    const Index across = tets_[t].across[face];
    const Index u = across >> TetAcross::tet_shift, apex = across & TetAcross::face_mask;
    if (u == sentinel_) return;
    const Label label = offer_plain(front_->label(t), t, face, u, apex, t == inside_,
                                    policy_ == Visibility::upper_bound);
    take(u, apex, label, front_->source(t));
  }

  bool seed_corner(Index t, Index i, Real sigma, Index source) const {
    Label label;
    for (Index j = 0; j < 4; ++j) label.distance2[j] = i == j ? 0 : squared_edge(t, tet_edge(i, j));
    return accept(t, (i + 1) & 3, label, sigma, source);
  }

  void seed_inside(Index t, const std::array<double, 4>& barycentric, Real sigma, Index source) {
    Label label;
    for (Index i = 0; i < 4; ++i)
      label.distance2[i] = std::max(squared_from(t, barycentric, i), Real(0));
    // Farther from the centre than another source here, it may still be the nearer one beyond.
    const bool better = accept(t, 0, label, sigma, source);
    const Label kept = front_->label(t);
    const Index kept_source = front_->source(t);
    if (!better) {
      label.sigma = sigma;
      front_->put(t, label);
      front_->set_source(t, source);
    }
    inside_ = t;
    for (Index i = 0; i < 4; ++i) cross(t, i, false);
    inside_ = none;
    front_->put(t, kept);
    front_->set_source(t, kept_source);
  }

  [[nodiscard]] Real corner_distance(Index t, Index i, Real = 0) const {
    return front_->label(t).sigma + std::sqrt(front_->label(t).distance2[i]);
  }

  /// As SolidRule's.
  [[nodiscard]] bool bends() const { return false; }
  template <class Offer>
  void ask_around(std::span<const Index> around, const Offer& offer) const {
    Real best = std::numeric_limits<Real>::infinity();
    Index by = none;
    for (const Index c : around) {
      if (!front_->reached(c / 4)) continue;
      const Real d = corner_distance(c / 4, c % 4);
      if (d < best) best = d, by = c / 4;
    }
    if (by != none) offer(by, best);
  }

  /// Labels of u offer a path over the edge (v, w) of t, which touches u in that edge only.
  bool pass_edge(Index u, Index t, Index v, Index w, Real gain) const {
    using Edge = kernel::HingeKernel<Real, 1>;
    const Index u0 = corner_of(u, v), u1 = corner_of(u, w);
    const Index t0 = corner_of(t, v), t1 = corner_of(t, w);
    const Real e2[1] = {squared_edge(t, tet_edge(t0, t1))};
    const auto pose = Edge::make_pose(e2);
    const Real s2[2] = {front_->label(u).distance2[u0], front_->label(u).distance2[u1]};
    const auto S = Edge::locate(pose, s2);
    // The best point of the edge for the farther of the others: its distances are then exact.
    Label best;
    best.centre = std::numeric_limits<Real>::infinity();
    Index hinge = 0;
    for (Index i = 0; i < 4; ++i) {
      if (i == t0 || i == t1) continue;
      hinge = i;
      const Real q2[2] = {squared_edge(t, tet_edge(t0, i)), squared_edge(t, tet_edge(t1, i))};
      const auto q = Edge::locate(pose, q2);
      auto c = Edge::crossing(S, q);
      auto b = Edge::vertex_point(pose, 0);
      b.x[0] = std::clamp(c.x[0] / c.w, Real(0), Real(1));
      Label label;
      for (Index j = 0; j < 4; ++j) {
        auto at = Edge::vertex_point(pose, j == t1 ? 1 : 0);
        if (j != t0 && j != t1) {
          const Real j2[2] = {squared_edge(t, tet_edge(t0, j)), squared_edge(t, tet_edge(t1, j))};
          at = Edge::locate(pose, j2);
        }
        label.distance2[j] = Edge::distance_squared(pose, b, at);
      }
      label.sigma = front_->label(u).sigma + std::sqrt(Edge::distance_squared(pose, S, b));
      label.centre = centre_distance(t, label);
      if (label.centre < best.centre) best = label;
    }
    if (!(best.centre < distance_or_inf(t) * gain)) return false;
    return accept(t, hinge, best, best.sigma, front_->source(u));
  }

 private:
  static constexpr Real rounding = sizeof(Real) == 4 ? Real(2e-4) : Real(1e-9);
  static constexpr Real bend_penalty = 1 + 32 * std::numeric_limits<Real>::epsilon();

  // What the text of the step calls.
  static Real max(Real a, Real b) { return kernel::max(a, b); }
  static Real min(Real a, Real b) { return kernel::min(a, b); }
  static Real sqrt(Real a) { return kernel::sqrt(a); }
  [[nodiscard]] Index vertex_of(Index t, Index i) const { return tets_[t].corner[i]; }
  [[nodiscard]] Real squared_edge(Index t, Index edge) const {
    if (!embedded_) return lengths_[t][edge];
    const auto d = points_[tets_[t].corner[tet_edge_ends[edge][1]]] -
                   points_[tets_[t].corner[tet_edge_ends[edge][0]]];
    return dot(d, d);
  }

  /// Squared distance of corner i from a point: sum_j b_j l_ij^2 - sum_{j < k} b_j b_k l_jk^2.
  [[nodiscard]] Real squared_from(Index t, const std::array<double, 4>& b, Index i) const {
    double sum = 0;
    for (Index j = 0; j < 4; ++j)
      if (j != i) sum += b[j] * static_cast<double>(squared_edge(t, tet_edge(i, j)));
    for (Index e = 0; e < 6; ++e)
      sum -=
          b[tet_edge_ends[e][0]] * b[tet_edge_ends[e][1]] * static_cast<double>(squared_edge(t, e));
    return static_cast<Real>(sum);
  }
  bool accept(Index t, Index hinge, Label& label, Real sigma, Index source) const {
    label.sigma = sigma;
    label.centre = centre_distance(t, label);
    return take(t, hinge, label, source);
  }
  bool take(Index t, Index hinge, const Label& label, Index source) const {
    constexpr Real gain = Real(1) - Real(16) * std::numeric_limits<Real>::epsilon();
    if (!(label.centre < distance_or_inf(t) * gain)) return false;
    front_->accept(t, hinge, label, label.centre, source);
    return true;
  }

  const TetMesh<Real>* mesh_;
  const TetRecord<Real>* tets_;
  const Vector3<Real>* points_;
  const std::array<Real, 6>* lengths_;
  Index sentinel_;
  bool embedded_;
  // Lengths alone that nothing is in the way of: what a line misses a face by is how space is bent
  // there, not a notch that it would cut off. (By the name that the text of the step has.)
  Real face_tolerance;
  Visibility policy_;
  Front* front_;
  Index inside_ = none;  // the tetrahedron a source lies in, while its faces are crossed
};

#include "kernel/text_end.inl"

}  // namespace plexway
