#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>

#include <plexway/solve/distance_field.hpp>
#include <plexway/solve/options.hpp>
#include <plexway/source/point_source.hpp>
#include <plexway/surface/detail/triangle_record.hpp>
#include <plexway/surface/triangle_mesh.hpp>

#include "labels/wavefront.hpp"
#include "labels/workspace_state.hpp"

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

/// One propagation over a surface from seeds to the last label, for any rule and front.
template <class Real, class Rule, class Front, bool kLabels>
class TrianglePropagation {
 public:
  TrianglePropagation(const TriangleMesh<Real>& mesh, WorkspaceState<Real>& workspace, Rule rule,
                      Front& front, const PropagateOptions& options)
      : mesh_(mesh),
        triangles_(mesh.triangles()),
        workspace_(workspace),
        front_(front),
        radius_(static_cast<Real>(options.radius / mesh.unit())),
        spread_(triangles_, rule, front, radius_, mesh.summary().refracting_edges > 0,
                mesh.face_count()) {}

  void seed(const PointSource& source, Index number) {
    const Real sigma = static_cast<Real>(source.offset / mesh_.unit());
    if (source.vertex != none) {
      seed_vertex(mesh_.inside_vertex(source.vertex), sigma, number);
      return;
    }
    std::array<double, 4> b = source.barycentric;
    const auto [f, turned] = mesh_.inside_face(source.simplex);
    if (turned) std::swap(b[1], b[2]);
    seed_inside(f, b, sigma, number);
  }

  /// The same by numbers and in the unit inside.
  void seed_inside(Index f, const std::array<double, 4>& b, Real sigma, Index number) {
    for (int i = 0; i < 3; ++i)
      if (b[static_cast<std::size_t>(i)] == 1) {
        seed_vertex(triangles_[f].corner[i], sigma, number);
        return;
      }
    const TriangleRecord<Real>& t = triangles_[f];
    const double x =
        b[1] * static_cast<double>(t.length[0]) + b[2] * static_cast<double>(t.apex_x(0));
    const double y = b[2] * static_cast<double>(t.apex_h(0));
    spread_.rule().seed_inside(f, static_cast<Real>(x), static_cast<Real>(y), sigma, number);
  }

  void seed_vertex(Index vertex, Real sigma, Index number) {
    mesh_.corners_at(vertex, workspace_.corners);
    for (const Index c : workspace_.corners)
      spread_.rule().seed_corner(c / 3, c % 3, sigma, number);
  }

  void run() {
    run([&](bool last_resort) { spread(last_resort); });
  }
  /// With another way to expand all that waits: spread(last_resort).
  template <class Spread>
  void run(const Spread& spread_all) {
    int revivals = 0;
    do {
      spread_all(last_resort(revivals));
      if (front_.out_of_budget()) return;
    } while (repair(revivals));
  }

  [[nodiscard]] const Rule& rule() const { return spread_.rule(); }

  // the parts of run, for those who do more in between or must not look at the whole
  static bool last_resort(int revivals) { return revivals > 8; }
  /// Once none waits: true if some wait again.
  bool repair(int& revivals) {
    ++revivals;
    return pass_pinches(mesh_.pinched()) || revive();
  }

  void spread(bool last_resort) {
    Index f = 0;
    while (!spread_.share(last_resort, f)) {
      if (!front_.take_stock(spread_.rule().distance(f))) return;
      if (spread_.refracts()) spread_.limit(spread_.rule(), front_.updates());
    }
  }

  /// A path may pass a vertex where fans of triangles only touch: it bends there (a hinge of
  /// dimension 0). True if some triangle got a better label.
  bool pass_pinches(std::span<const Index> pinched) {
    bool any = false;
    for (const Index v : pinched) any |= bend_at(v, path_to(v));
    return any;
  }

  /// The best path to a vertex, of those in its triangles.
  struct Path {
    Real distance = std::numeric_limits<Real>::infinity();
    Index source = none;
  };
  /// Of its triangles count those below `end`.
  [[nodiscard]] Path path_to(Index vertex, Index end = none) const {
    mesh_.corners_at(vertex, workspace_.corners);
    Path best;
    for (const Index c : workspace_.corners) {
      if (c / 3 >= end || !front_.reached(c / 3)) continue;
      const Real d = spread_.rule().corner_distance(c / 3, c % 3);
      if (d < best.distance) best = {d, front_.source(c / 3)};
    }
    return best;
  }
  /// Goes on from there into all of them. True if one got a better label.
  bool bend_at(Index vertex, const Path& best, Index end = none) {
    if (!(best.distance < std::numeric_limits<Real>::infinity()) || best.distance > radius_)
      return false;
    bool any = false;
    mesh_.corners_at(vertex, workspace_.corners);
    for (const Index c : workspace_.corners) {
      if (c / 3 >= end) continue;
      const std::size_t i = c % 3;
      // Within rounding of its own path it stays with that one; else this would not end.
      if (front_.reached(c / 3) &&
          spread_.rule().corner_distance(c / 3, i) <=
              best.distance * (1 + 64 * std::numeric_limits<Real>::epsilon()))
        continue;
      any |= spread_.rule().seed_corner(c / 3, i, best.distance, best.source);
    }
    return any;
  }

  /// Updates that turn around a vertex where no path bends are dropped. Where that leaves a
  /// triangle without any label, they are taken after all; after some rounds of it, everywhere, so
  /// that rounds end.
  bool revive() {
    const std::size_t faces = mesh_.face_count();
    if (front_.reached_count() == faces || radius_ < std::numeric_limits<Real>::infinity())
      return false;
    return revive_all();
  }
  /// Without a look whether there are any.
  bool revive_all() {
    const std::size_t before = front_.updates();
    for (Index f = 0; f < mesh_.face_count(); ++f) {
      if (!front_.reached(f)) continue;
      for (std::size_t e = 0; e < 3; ++e) {
        const Index g = triangles_[f].across[e] >> Across::face_shift;
        if (!front_.reached(g) && e != front_.hinge(f)) spread_.rule().cross(f, e, true);
      }
    }
    return front_.updates() != before;
  }

 private:
  const TriangleMesh<Real>& mesh_;
  std::span<const TriangleRecord<Real>> triangles_;
  WorkspaceState<Real>& workspace_;
  Front& front_;
  Real radius_;
  TriangleSpread<Real, Rule, Front> spread_;
};

}  // namespace plexway::detail
