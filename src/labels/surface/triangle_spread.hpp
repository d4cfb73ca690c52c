#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

#include <plexway/surface/detail/triangle_record.hpp>

namespace plexway::detail {

/// The hot loop of a propagation over triangles, for any rule and front.
template <class Real, class Rule, class Front>
class TriangleSpread {
 public:
  /// Over `triangles` of a surface of `faces`, as far as `radius` (the unit inside).
  TriangleSpread(std::span<const TriangleRecord<Real>> triangles, Rule rule, Front& front,
                 Real radius, bool refracts, std::size_t faces)
      : triangles_(triangles.data()),
        rule_(rule),
        front_(front),
        radius_(radius),
        refracts_(refracts),
        faces_(faces) {}

  [[nodiscard]] Rule& rule() { return rule_; }
  [[nodiscard]] const Rule& rule() const { return rule_; }
  [[nodiscard]] bool refracts() const { return refracts_; }

  /// Until no triangle waits (true) or what the front was granted is spent. It works on
  /// a copy of the front that nothing points to, which the compiler can keep in registers; the
  /// rare full rule gets the original. `f` becomes the last triangle expanded.
  bool share(bool last_resort, Index& f) {
    Front wave = front_;
    const Rule rule = rule_.on(wave);
    const auto full = [&](Index g, std::size_t edge) {
      front_ = wave;
      rule_.cross(g, edge, last_resort);
      wave = front_;
    };
    const auto distance_of = [&](Index g) { return rule.distance(g); };
    while (wave.next(f, distance_of)) expand(rule, wave, f, last_resort, full);
    front_ = wave;
    return !wave.share_spent();
  }

  /// One triangle, as far as the radius allows; full(f, edge) is for the rare full rule.
  template <class OnFront, class AnyFront, class Full>
  [[gnu::always_inline]] void expand(const OnFront& rule, const AnyFront& front, Index f,
                                     bool last_resort, const Full& full) const {
    const Real radius = radius_;
    if (rule.distance(f) > radius) [[unlikely]]
      if (rule.distance(f) - size(triangles_[f]) > radius) return;
    if (last_resort) [[unlikely]] {
      for (std::size_t e = 0; e < 3; ++e)
        if (e != front.hinge(f)) full(f, e);
      return;
    }
    rule.expand(f, full);
  }

  /// Two updates a triangle are usual. Where lengths are no metric at all, refracted paths might
  /// get shorter each time around, without end: from 64 on they must gain more and more.
  template <class AnyRule>
  void limit(AnyRule& rule, std::size_t updates) const {
    if constexpr (requires { rule.set_patience(Real(1)); }) {
      const double more = static_cast<double>(updates) / (64 * static_cast<double>(faces_));
      if (more > 1) rule.set_patience(std::max(static_cast<Real>(2 - more), Real(1e-20)));
    }
  }

 private:
  /// No point of a triangle is farther from its centre: two thirds of a median, and no median is
  /// longer than the longest edge.
  static Real size(const TriangleRecord<Real>& t) {
    return std::max({t.length[0], t.length[1], t.length[2]}) * (Real(2) / 3);
  }

  const TriangleRecord<Real>* triangles_;
  Rule rule_;
  Front& front_;
  Real radius_;
  bool refracts_;
  std::size_t faces_;
};

}  // namespace plexway::detail
