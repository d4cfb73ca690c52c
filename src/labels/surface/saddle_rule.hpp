#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include <plexway/surface/detail/triangle_record.hpp>

#include "labels/surface/saddle_label.hpp"
#include "labels/surface/saddle_poses.hpp"
#include "labels/surface/saddle_refraction.hpp"
#include "labels/surface/saddle_step.hpp"
#include "labels/surface/saddle_step_lanes.hpp"

namespace plexway::detail {

/// Visibility::saddles on triangles: how labels get from one to the next.
template <class Real, class Front>
class SaddleRule : public SaddlePoses<Real> {
 public:
  using Poses = SaddlePoses<Real>;
  using Poses::at_corner;
  using Poses::hinge_of;
  using Poses::packed;
  using Poses::posed;
  using Poses::turned;
  using typename Poses::Label;
  using typename Poses::Point;
  using typename Poses::Posed;

  SaddleRule(std::span<const TriangleRecord<Real>> triangles, Front& front, bool vectorised)
      : triangles_(triangles.data()),
        sentinel_(static_cast<Index>(triangles.size() - 1)),
        front_(front),
        vectorised_(vectorised) {
    // Nothing is nearer: never accepted.
    front_.put(sentinel_, {kernel::Lanes<Real>(0, 0, 0, 0), kernel::Lanes<Real>(0, -1, 0, 0)});
  }

  /// The same rule on another front: of another executor, or one that a loop can keep in registers.
  template <class Other>
  [[nodiscard]] SaddleRule<Real, Other> on(Other& front) const {
    SaddleRule<Real, Other> rule(triangles_, sentinel_, front, vectorised_);
    rule.patience_ = patience_;
    return rule;
  }

  /// The same rule over other triangles.
  template <class Other>
  [[nodiscard]] SaddleRule<Real, Other> over(std::span<const TriangleRecord<Real>> triangles,
                                             Other& front) const {
    return SaddleRule<Real, Other>(triangles, front, vectorised_);
  }

  /// Below 1, a refracted path must be shorter by that factor to count.
  void set_patience(Real patience) { patience_ = patience; }

  [[nodiscard]] Real distance(Index f) const { return front_.label(f).distance(); }
  /// What a label for f must be below. Around a bend all paths are equally long from both sides, so
  /// rounding would decide which label stays; a gain must be more than that.
  [[nodiscard, gnu::always_inline]] Real to_beat(Index f) const {
    constexpr Real gain = Real(1) - Real(16) * std::numeric_limits<Real>::epsilon();
    return front_.reached(f) ? distance(f) * gain : std::numeric_limits<Real>::infinity();
  }

  /// The hot loop's body: pushes the label of triangle f over the two hinges it did not come by.
  /// `full(f, edge)` applies the full rule where the common case does not hold.
  template <class Full>
  [[gnu::always_inline]] void expand(Index f, Full full) const {
    const TriangleRecord<Real>& t = triangles_[f];
    const std::size_t in = front_.hinge(f);
    const std::size_t left = edge_before(in), right = edge_after(in);
    const Index over_left = t.across[left], over_right = t.across[right];
    Label own = front_.label(f);
    if (may_narrow(t, in, own)) [[unlikely]]
      own =
          narrow_by_neighbours(f, own, [&](const Label& narrower) { front_.narrow(f, narrower); });
    if (((over_left | over_right) & Across::special) || !vectorised_) [[unlikely]] {
      full(f, left);
      full(f, right);
      return;
    }
    const Index l = over_left >> Across::face_shift, r = over_right >> Across::face_shift;
    const std::size_t kl = over_left & Across::edge_mask, kr = over_right & Across::edge_mask;
    const TriangleRecord<Real>&tl = triangles_[l], &tr = triangles_[r];
    const SaddleStepLanes<Real> step(t, in, left, right, own, tl.apex_x(kl), tl.apex_h(kl),
                                     tr.apex_x(kr), tr.apex_h(kr));
    // Read before anything is accepted: one hinge must not change what the other compares with.
    // And after the arithmetic, so that it is under way when a branch is mispredicted here.
    const Real known_left = to_beat(l), known_right = to_beat(r);
    const Index source = front_.source(f);
    if (step.left_distance < known_left) {
      SaddleLabel<Real> label;
      if (step.left_rare()) [[unlikely]]
        label = resolve(step.left_posed(), tl, kl, 0, false);
      else if (step.left_bent()) [[unlikely]]
        label = step.bent_label(true, tl, kl);
      else
        label = step.left_label();
      if (label.distance() < known_left) [[likely]] {
        front_.accept(l, kl, label, label.distance(), source);
        prefetch(tl, kl);
      }
    }
    if (step.right_distance < known_right) {
      SaddleLabel<Real> label;
      if (step.right_rare()) [[unlikely]]
        label = resolve(step.right_posed(), tr, kr, 1, false);
      else if (step.right_bent()) [[unlikely]]
        label = step.bent_label(false, tr, kr);
      else
        label = step.right_label();
      if (label.distance() < known_right) [[likely]] {
        front_.accept(r, kr, label, label.distance(), source);
        prefetch(tr, kr);
      }
    }
  }

  /// May triangle t, come in by edge `in`, take tighter limits over (see narrow_limits)? The common
  /// no, without branches: each would be a coin toss.
  [[gnu::always_inline]] bool may_narrow(const TriangleRecord<Real>& t, std::size_t in,
                                         const Label& label) const {
    const Seen seen(t, in, label);
    const Label& other = front_.label(seen.across >> Across::face_shift);
    using L = kernel::Lanes<Real>;
    const L theirs = other.x * other.x + other.h * other.h;
    const L ours = label.x * label.x + label.h * label.h;
    // A limit as far from the source is the same one.
    const auto tighter = abs(theirs - ours) > L(Real(0.01)) * theirs;
    const int limits = kernel::lane_bits(tighter) >> 2;
    const bool same = std::abs(other.x[1] - label.x[1]) <= same_source * label.h[1];
    const Real size = std::abs(label.x[0]) + std::abs(label.h[0]) + t.length[in];
    const Real rounding = Real(64) * std::numeric_limits<Real>::epsilon() * size;
    // Centres in the dark keep what they have.
    const Real qx = (t.length[in] + t.apex_x(in)) * Real(1. / 3) - label.x[0];
    const Real qh = t.apex_h(in) * Real(1. / 3) + label.h[0];
    const auto dark = label.x * L(0, 0, qh, -qh) + label.h * L(0, 0, qx, -qx) > L(rounding * size);
    const bool lit = kernel::lane_bits(dark) == 0;
    return (limits != 0) & same & lit & (seen.height < -rounding);
  }

  /// Takes tighter limits over from the neighbour that the source sees before f, if it holds the
  /// same source: take(label). Returns the label that f has then.
  template <class Take>
  [[gnu::noinline]] Label narrow_by_neighbours(Index f, Label label, const Take& take) const {
    const TriangleRecord<Real>& t = triangles_[f];
    const std::size_t in = front_.hinge(f);
    const Seen seen(t, in, label);
    const Index g = seen.across >> Across::face_shift;
    if (!(seen.across & Across::special) && label.h[0] >= 0 && front_.reached(g) &&
        front_.hinge(g) != (seen.across & Across::edge_mask) &&
        front_.source(g) == front_.source(f) && narrow(t, in, seen.left, seen.across, label))
      take(label);
    return label;
  }

  /// The full rule over one edge, to every triangle there.
  [[gnu::noinline]] void cross(Index f, std::size_t edge, bool last_resort) {
    int pivot = -1;
    const Posed here = leave(f, front_.hinge(f), edge, pivot);
    cross_posed(f, edge, here, pivot, last_resort, front_.source(f));
  }

  void cross_posed(Index f, std::size_t edge, const Posed& here, int pivot, bool last_resort,
                   Index source) {
    around(f, edge, [&](Index g, std::size_t k, bool flip) {
      if (refracts(f, edge, g, k)) [[unlikely]] {
        Posed there = here;
        enter_refracted(g, k, there, flip, pivot, triangles_[f].length[edge], source);
      } else {
        enter(g, k, here, flip, pivot, last_resort, source);
      }
    });
  }

  /// A path of length sigma ends at corner i of triangle f; false if f knows a better one.
  bool seed_corner(Index f, std::size_t i, Real sigma, Index source) {
    const TriangleRecord<Real>& t = triangles_[f];
    const Real x = (t.length[i] + t.apex_x(i)) / 3, h = t.apex_h(i) / 3;
    const Real d = sigma + std::sqrt(x * x + h * h);
    const bool better = d < to_beat(f);
    if (!((t.across[i] | t.across[edge_before(i)]) & Across::fan)) [[likely]] {
      if (better) accept_corner(f, i, sigma, d, source);
      return better;
    }
    // Where an edge at the corner refracts the two triangles beside it see two lights, from the
    // corner and from along the edge. One is kept; what the other is the best for lies beyond.
    const std::size_t before = front_.updates();
    if (better)
      accept_corner(f, i, sigma, d, source);
    else
      pass_on(f, i, at_corner(sigma), source);
    for (const std::size_t e : {i, edge_before(i)}) {
      Posed here;
      here.source = {{e == i ? t.length[e] : Real(0)}, Real(0)};
      here.limit[0] = here.limit[1] = here.source;
      here.sigma = sigma;
      around(f, e, [&](Index g, std::size_t k, bool flip) {
        if (!refracts(f, e, g, k)) return;
        if (front_.reached(g))
          pass_on(g, front_.hinge(g), posed(front_.label(g)), front_.source(g));
        Posed along = here;
        if (!enter_refracted(g, k, along, flip, -1, t.length[e], source))
          pass_on(g, k, along, source);
      });
    }
    return front_.updates() != before;
  }

  /// A path of length sigma ends inside triangle f, at (x, y) over its edge 0.
  void seed_inside(Index f, Real x, Real y, Real sigma, Index source) {
    const TriangleRecord<Real>& t = triangles_[f];
    const Real dx = (t.length[0] + t.apex_x(0)) / 3 - x, dy = t.apex_h(0) / 3 - y;
    const Real d = sigma + std::sqrt(dx * dx + dy * dy);
    // Farther from the centre than another source here, it may still be the nearer one beyond.
    const bool better = d < to_beat(f);
    const Label kept = front_.label(f);
    const Label label = {kernel::Lanes<Real>(x, sigma, 0, 0), kernel::Lanes<Real>(-y, d, 0, 0)};
    if (better)
      front_.accept(f, 0, label, d, source);
    else
      front_.put(f, label);
    // Expansion would not take edge 0, and would take a source on an edge for one behind it.
    for (std::size_t edge = 0; edge < 3; ++edge) {
      int pivot = -1;
      Posed here = leave(f, 0, edge, pivot);
      here.source.h = std::max(here.source.h, Real(0));
      here.limit[0] = here.limit[1] = here.source;
      cross_posed(f, edge, here, -1, true, source);
    }
    if (!better) front_.put(f, kept);
  }

  /// Length of the path to corner i of a reached triangle.
  [[nodiscard]] Real corner_distance(Index f, std::size_t i) const {
    const TriangleRecord<Real>& t = triangles_[f];
    const std::size_t in = front_.hinge(f);
    const Posed label = posed(front_.label(f));
    Point q = {{Real(0)}, Real(0)};
    if (i == (in + 1) % 3) q.x[0] = t.length[in];
    if (i == (in + 2) % 3) q = {{t.apex_x(in)}, t.apex_h(in)};
    return path_length<Real>(label, t.length[in], q);
  }

  [[nodiscard]] const Label& label(Index f) const { return front_.label(f); }

  /// A label comes over edge k of f from elsewhere, posed on the far side.
  void enter_posed(Index f, std::size_t k, const Posed& label, Index source) {
    enter(f, k, label, false, -1, true, source);
  }
  [[nodiscard]] const TriangleRecord<Real>& triangle(Index f) const { return triangles_[f]; }

 private:
  template <class, class>
  friend class SaddleRule;

  /// Which neighbour the source of a label sees before its triangle, and at what height over the
  /// edge to it: negative if so.
  struct Seen {
    [[gnu::always_inline]] Seen(const TriangleRecord<Real>& t, std::size_t in, const Label& label) {
      const Real x = label.x[0], h = label.h[0];
      const std::size_t before = edge_before(in), after = edge_after(in);
      const Real to_left = x * t.sine(in) + h * t.cosine[in];
      const Real to_right = (t.length[in] - x) * t.sine(after) + h * t.cosine[after];
      left = to_left < to_right;
      height = std::min(to_left, to_right);
      across = t.across[left ? before : after];
    }
    Real height;
    bool left;
    Index across;
  };

 protected:
  SaddleRule(const TriangleRecord<Real>* triangles, Index sentinel, Front& front, bool vectorised)
      : triangles_(triangles), sentinel_(sentinel), front_(front), vectorised_(vectorised) {}

  /// `visit(g, k, flip)` for each triangle beyond an edge, and whether it runs the same way there.
  template <class Visit>
  void around(Index f, std::size_t edge, Visit visit) const {
    const Index start = triangles_[f].across[edge];
    bool flip = (start & Across::flip) != 0;
    for (Index across = start;;) {
      const Index g = across >> Across::face_shift;
      const std::size_t k = across & Across::edge_mask;
      if (g == sentinel_ || (g == f && k == edge)) break;
      visit(g, k, flip);
      if (!(across & Across::fan)) break;
      across = triangles_[g].across[k];
      flip = flip == ((across & Across::flip) != 0);
    }
  }

  /// The label of f posed on one of its edges, as a neighbour that runs the other way sees it.
  Posed leave(Index f, std::size_t in, std::size_t edge, int& pivot) const {
    return turned(triangles_[f], posed(front_.label(f)), in, edge, pivot);
  }
  bool narrow(const TriangleRecord<Real>& t, std::size_t in, bool left, Index across,
              Label& label) const {
    const Index g = across >> Across::face_shift;
    const std::size_t edge = left ? edge_before(in) : edge_after(in), corner = left ? in : edge;
    int pivot = -1;
    const Posed other = leave(g, front_.hinge(g), across & Across::edge_mask, pivot);
    const auto found = kernel::SaddleKernel<Real>::narrow_limits(
        posed(label), other, left, t.length[in], t.length[edge], t.cosine[corner], t.sine(corner),
        {{t.apex_x(in)}, t.apex_h(in)}, same_source * label.distance());
    for (int i = 0; i < 2; ++i) {
      if (!found.narrower[i]) continue;
      label.x.v[2 + i] = found.limit[i].x[0] - label.x[0];
      label.h.v[2 + i] = found.limit[i].h - label.h[0];
    }
    return found.narrower[0] || found.narrower[1];
  }

  void enter(Index g, std::size_t k, Posed label, bool flip, int pivot, bool last_resort,
             Index source) {
    const TriangleRecord<Real>& t = triangles_[g];
    if (flip) {
      label = kernel::SaddleKernel<Real>::mirror_label(label, t.length[k]);
      if (pivot >= 0) pivot = 1 - pivot;
    }
    const Label entered = resolve(label, t, k, pivot, last_resort);
    if (!(entered.distance() < to_beat(g))) return;
    front_.accept(g, k, entered, entered.distance(), source);
  }

  /// Do f and g measure the edge between them differently, by more than rounding?
  [[nodiscard]] bool refracts(Index f, std::size_t edge, Index g, std::size_t k) const {
    constexpr Real rounding = sizeof(Real) == 4 ? Real(1e-6) : Real(1e-10);
    const Real here = triangles_[f].length[edge], there = triangles_[g].length[k];
    return std::abs(there - here) > rounding * here && there > 0 && here > 0;
  }

  /// Over an edge that is `width` long on the side the label comes from.
  /// True if it is the best there; `label` is what it is beyond.
  [[gnu::noinline]] bool enter_refracted(Index g, std::size_t k, Posed& label, bool flip, int pivot,
                                         Real width, Index source) {
    if (flip) {
      label = kernel::SaddleKernel<Real>::mirror_label(label, width);
      if (pivot >= 0) pivot = 1 - pivot;
    }
    const Real d =
        std::max(Real(0), refract<Real>(label, hinge_of(triangles_[g], k, pivot), width));
    const bool better = d < to_beat(g) * patience_;
    if (better) front_.accept(g, k, packed(label, d), d, source);
    return better;
  }

  void accept_corner(Index f, std::size_t i, Real sigma, Real d, Index source) {
    front_.accept(f, i, {kernel::Lanes<Real>(0, sigma, 0, 0), kernel::Lanes<Real>(0, d, 0, 0)}, d,
                  source);
  }

  /// Takes a label, posed on edge `in` of f, over the two other edges, whatever f keeps.
  void pass_on(Index f, std::size_t in, const Posed& label, Index source) {
    for (const std::size_t e : {edge_before(in), edge_after(in)}) {
      int pivot = -1;
      const Posed here = turned(triangles_[f], label, in, e, pivot);
      cross_posed(f, e, here, pivot, true, source);
    }
  }

  /// The full rule for one triangle beyond.
  [[gnu::noinline]] static Label resolve(Posed label, const TriangleRecord<Real>& t, std::size_t k,
                                         int pivot, bool last_resort) {
    const Real d = cross_hinge<Real>(label, hinge_of(t, k, pivot), last_resort);
    return packed(label, d);
  }

  // What the neighbours of a triangle come in by edge k will need when its turn comes.
  [[gnu::always_inline]] void prefetch(const TriangleRecord<Real>& t, std::size_t k) const {
    const Index a = t.across[k == 0 ? 2 : k - 1] >> Across::face_shift;
    const Index b = t.across[k == 2 ? 0 : k + 1] >> Across::face_shift;
    __builtin_prefetch(&triangles_[a]);
    __builtin_prefetch(&front_.label(a));
    __builtin_prefetch(&triangles_[b]);
    __builtin_prefetch(&front_.label(b));
  }

  /// Two labels are of one source if it is at the same place, within this share of its distance:
  /// what curvature between two strips of triangles may turn it by.
  static constexpr Real same_source = Real(1. / 128);

  const TriangleRecord<Real>* triangles_;
  Index sentinel_;
  Front& front_;
  bool vectorised_;
  Real patience_ = 1;
};

}  // namespace plexway::detail
