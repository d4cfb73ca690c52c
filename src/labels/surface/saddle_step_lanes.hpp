#pragma once

#include <plexway/surface/detail/triangle_record.hpp>

#include "labels/surface/saddle_step.hpp"

namespace plexway::detail {

/// The step of saddle_step.hpp for both hinges by which a path leaves a triangle, at once.
///
/// A path that came in by edge i leaves by the edge before it, around corner i, or by the edge
/// after it, around corner i + 1: around a pivot, left or right. Measured from the pivot both are
/// the same, so lanes 0 1 are the left hinge and lanes 2 3 the right one; and on each hinge the
/// left limit is the mirror image of the right one, so even lanes hold the pivot's side and odd
/// lanes the far side, each with x measured from its own end.
///
/// Only what is common is done for all: neither source nor limit given up, at most one bend. `bent`
/// says where that is not so (`bent_label` sees to it), `rare` which hinges need the full rule.
template <class Real>
class SaddleStepLanes {
 public:
  using L = kernel::Lanes<Real>;
  using Mask = typename L::Mask;
  using Kernel = kernel::HingeKernel<L, 1>;

  /// `in` is the edge the label is posed on, `before` and `after` its neighbours. The apexes are
  /// those of the triangles beyond, over the left and the right hinge.
  [[gnu::always_inline]] SaddleStepLanes(const TriangleRecord<Real>& t, std::size_t in,
                                         std::size_t before, std::size_t after,
                                         const SaddleLabel<Real>& label, Real left_apex_x,
                                         Real left_apex_h, Real right_apex_x, Real right_apex_h) {
    const Real width = t.length[in], left = t.length[before], right = t.length[after];
    const L length(left, left, right, right);

    // The angle at each pivot. Sign bits of sines say where paths may bend.
    const L cosine(t.cosine[in], t.cosine[in], t.cosine[after], t.cosine[after]);
    const Real s0 = t.signed_sine[in], s1 = t.signed_sine[after], s2 = t.signed_sine[before];
    constexpr auto sign = std::numeric_limits<typename L::Integer>::min();
    const L sine = (typename L::Vector)((Mask)L(s0, s0, s1, s1).v & ~Mask{sign, sign, sign, sign});
    const Mask saddle = (Mask)L(s0, s2, s1, s2).v < 0;

    // S from the pivots, and the limits from S, turned onto the hinges.
    const L flip(1, 1, -1, -1), mirror(1, -1, 1, -1), from(0, 0, width, width);
    const L off(0, left, 0, right);
    const typename L::Vector x = label.x.v, h = label.h.v;
    const L u = from + flip * L(__builtin_shufflevector(x, x, 0, 0, 0, 0));
    const L uh = __builtin_shufflevector(h, h, 0, 0, 0, 0);
    typename Kernel::HingePoint S;
    S.x[0] = off + mirror * (u * cosine - uh * sine);
    S.h = u * sine + uh * cosine;
    const L w = flip * L(__builtin_shufflevector(x, x, 2, 3, 3, 2));
    const L wh = __builtin_shufflevector(h, h, 2, 3, 3, 2);
    const L px = mirror * (w * cosine - wh * sine);
    const L ph = w * sine + wh * cosine, py = -ph;

    // The centres beyond.
    constexpr Real third = Real(1. / 3);
    const Real c0 = (left + left_apex_x) * third, c1 = (right + right_apex_x) * third;
    const Real h0 = left_apex_h * third, h1 = right_apex_h * third;
    typename Kernel::HingePoint q;
    q.x[0] = L(c0, left - c0, right - c1, c1);
    q.h = L(h0, h0, h1, h1);

    // Limits for this probe: the remembered one or, where it is tighter, the hinge's own end.
    const Mask loose = px * S.h + py * S.x[0] > L(0);  // the remembered limit is the tighter one
    const L ex = select(loose, px, -S.x[0]), ey = select(loose, py, S.h);
    const L gx = q.x[0] - S.x[0], gy = q.h + S.h;
    const Mask dark = ex * gy - ey * gx > L(0);
    const L bx = gx - ex, by = gy - ey;
    const L straight = sqrt(gx * gx + gy * gy);
    const L bent = sqrt(ex * ex + ey * ey) + sqrt(bx * bx + by * by);
    const L way = select(dark, bent, straight);
    const L sigma = __builtin_shufflevector(x, x, 1, 1, 1, 1);
    const L both = max(way, L(__builtin_shufflevector(way.v, way.v, 1, 0, 3, 2))) + sigma;
    // Behind the hinge, and neither a limit nor the pivot to bend at: dropped.
    const L rounding =
        L(Real(64) * std::numeric_limits<Real>::epsilon()) * (abs(S.x[0]) + abs(S.h) + length);
    const Mask behind = S.h < -rounding;
    const L inf(std::numeric_limits<Real>::infinity());
    const L kept = select(behind & ~(loose | saddle), inf, both);
    left_distance = kept[0];
    right_distance = kept[2];

    // As hides_hinge in saddle_step.hpp.
    const Mask limited = (px.v != 0) | (py.v != 0);
    const Mask wholly_dark = (px * S.h - py * (length - S.x[0]) > -(length * rounding)) & limited;
    const Mask bends_twice = dark & loose & ((S.x[0] + px) * q.h + q.x[0] * (S.h + ph) < L(0));
    const Mask far_side = {0, -1, 0, -1};
    rare_ = kernel::lane_bits((wholly_dark & far_side) | behind);
    bent_ = kernel::lane_bits(wholly_dark | bends_twice);
    wholly_dark_ = kernel::lane_bits(wholly_dark);

    // An end that is a saddle and tighter than the limit takes its place. `along` makes all x run
    // from the hinge's first end.
    const L along(1, -1, -1, 1);
    const Mask keep = loose | ~saddle;
    source_ = S;
    bare_x_ = px;
    bare_h_ = ph;
    limit_x_ = along * select(keep, px, -S.x[0]);
    limit_h_ = select(keep, ph, -S.h);
    sigma_ = x[1];
  }

  /// Of the centre beyond, where not rare.
  Real left_distance, right_distance;

  [[nodiscard, gnu::always_inline]] bool left_rare() const { return rare_ & 3; }
  [[nodiscard, gnu::always_inline]] bool right_rare() const { return rare_ & 12; }
  [[nodiscard, gnu::always_inline]] bool left_bent() const { return bent_ & 3; }
  [[nodiscard, gnu::always_inline]] bool right_bent() const { return bent_ & 12; }

  /// The label of the triangle beyond where the pivot's limit hides all of the hinge, or the path
  /// to the centre bends twice; not where rare. `t` and `k` are that triangle and its edge.
  [[nodiscard, gnu::always_inline]] SaddleLabel<Real> bent_label(bool left,
                                                                 const TriangleRecord<Real>& t,
                                                                 std::size_t k) const {
    return bent_label(left, t, k, source_.x[0], source_.h, bare_x_, bare_h_, limit_x_, limit_h_,
                      sigma_, bent_, wholly_dark_);
  }

 private:
  // Everything by value, so that the numbers of the common case can stay in registers.
  [[nodiscard, gnu::noinline]] static SaddleLabel<Real> bent_label(
      bool left, const TriangleRecord<Real>& t, std::size_t k, L source_x, L source_h, L bare_x,
      L bare_h, L limit_x, L limit_h, Real sigma, int bent, int wholly_dark) {
    const int i = left ? 0 : 2, j = i + 1;  // the lanes of the pivot's side and of the far side
    const Real length = t.length[k];
    const Real c = (length + t.apex_x(k)) * Real(1. / 3), qh = t.apex_h(k) * Real(1. / 3);
    const Real qx = left ? c : length - c, fx = length - qx;
    Real Sx = source_x[i], Sh = source_h[i];
    Real px = bare_x[i], ph = bare_h[i], rx = bare_x[j], rh = bare_h[j], d;
    const auto norm = [](Real x, Real y) { return kernel::sqrt(x * x + y * y); };
    if (wholly_dark >> i & 1) {
      sigma += norm(px, ph);
      Sx += px, Sh += ph;
      const std::size_t far = edge_after(k);
      const bool bends_here = t.saddle(left ? k : far), bends_there = t.saddle(left ? far : k);
      px = bends_here ? -Sx : Real(0), ph = bends_here ? -Sh : Real(0);
      rx = bends_there ? Sx - length : Real(0), rh = bends_there ? -Sh : Real(0);
      if (Sx * qh + qx * Sh < Real(0))
        d = norm(Sx, Sh) + norm(qx, qh);
      else if ((length - Sx) * qh + fx * Sh < Real(0))
        d = norm(length - Sx, Sh) + norm(fx, qh);
      else
        d = norm(qx - Sx, qh + Sh);
    } else {
      const Real tx = Sx + px, ux = length - Sx + rx, th = Sh + ph, uh = Sh + rh;
      d = Real(0);
      if (bent >> i & 1) d = norm(px, ph) + norm(tx, th) + norm(qx, qh);
      if (bent >> j & 1) d = std::max(d, norm(rx, rh) + norm(ux, uh) + norm(fx, qh));
      px = limit_x[i] * (left ? Real(1) : Real(-1)), ph = limit_h[i];
      rx = limit_x[j] * (left ? Real(-1) : Real(1)), rh = limit_h[j];
    }
    d += sigma;
    if (left) return {L(Sx, sigma, px, -rx), L(Sh, d, ph, rh)};
    return {L(length - Sx, sigma, rx, -px), L(Sh, d, rh, ph)};
  }

 public:
  /// The label of the triangle beyond, where not rare.
  [[nodiscard, gnu::always_inline]] SaddleLabel<Real> left_label() const {
    return {
        L(__builtin_shufflevector(L(source_.x[0][0], sigma_, 0, 0).v, limit_x_.v, 0, 1, 4, 5)),
        L(__builtin_shufflevector(L(source_.h[0], left_distance, 0, 0).v, limit_h_.v, 0, 1, 4, 5))};
  }
  [[nodiscard, gnu::always_inline]] SaddleLabel<Real> right_label() const {
    return {L(__builtin_shufflevector(L(source_.x[0][3], sigma_, 0, 0).v, limit_x_.v, 0, 1, 7, 6)),
            L(__builtin_shufflevector(L(source_.h[3], right_distance, 0, 0).v, limit_h_.v, 0, 1, 7,
                                      6))};
  }

  /// What the full rule starts from, where rare.
  [[nodiscard, gnu::always_inline]] PosedSaddles<Real> left_posed() const { return posed(0, 1); }
  [[nodiscard, gnu::always_inline]] PosedSaddles<Real> right_posed() const { return posed(3, 2); }

 private:
  // The lanes of the hinge's first and second end.
  [[nodiscard, gnu::always_inline]] PosedSaddles<Real> posed(int first, int second) const {
    PosedSaddles<Real> p;
    const Real Sx = source_.x[0][first], Sh = source_.h[first];
    p.source = {{Sx}, Sh};
    p.limit[0] = {{Sx + bare_x_[first]}, Sh + bare_h_[first]};
    p.limit[1] = {{Sx - bare_x_[second]}, Sh + bare_h_[second]};
    p.sigma = sigma_;
    return p;
  }

  typename Kernel::HingePoint source_;
  L bare_x_, bare_h_, limit_x_, limit_h_;
  Real sigma_;
  int rare_, bent_, wholly_dark_;
};

}  // namespace plexway::detail
