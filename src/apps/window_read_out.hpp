#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <tuple>

#include <plexway/complex/triangle_mesh.hpp>

#include "apps/solved.hpp"
#include "propagate/windows/window_solver.hpp"

namespace plexway {

/// Distances inside triangles from the windows that a solve kept: all that entered a triangle are
/// asked, its corners, and the sources in it. Numbers and unit inside.
template <class Real>
class WindowReadOut {
 public:
  WindowReadOut(const TriangleMesh<Real>& mesh, const Solved<Real>& solved)
      : mesh_(mesh), solved_(solved) {}

  /// The last straight piece of a path: from `from`, along edge 0 of the triangle and off it.
  struct Sight {
    double distance = std::numeric_limits<double>::infinity();
    std::array<double, 2> at = {}, from = {};
    Index source = none;
  };
  [[nodiscard]] Sight look(Index f, const std::array<double, 3>& weight) const {
    const TriangleRecord<Real>& t = mesh_.triangles()[f];
    const std::array<double, 2> corner[3] = {
        {0, 0},
        {static_cast<double>(t.length[0]), 0},
        {static_cast<double>(t.apex_x(0)), static_cast<double>(t.apex_h(0))}};
    Sight best;
    best.at = place(corner, weight);
    const auto straight = [&](const std::array<double, 2>& from, double distance, Index source) {
      const double d = distance + std::hypot(best.at[0] - from[0], best.at[1] - from[1]);
      if (d < best.distance) best.distance = d, best.from = from, best.source = source;
    };
    const double unit = mesh_.unit();
    for (std::size_t i = 0; i < 3; ++i) {
      const Index v = solved_.outer[t.corner[i]];
      const double d = static_cast<double>(solved_.field.distance[v]);
      if (d < std::numeric_limits<double>::infinity())
        straight(corner[i], d / unit, solved_.field.label.empty() ? 0 : solved_.field.label[v]);
    }
    for (Index n = 0; n < solved_.sources.size(); ++n) {
      const PointSource& s = solved_.sources[n];
      if (s.vertex != none) continue;
      const auto [face, turned] = mesh_.inside_face(s.simplex);
      if (face != f) continue;
      straight(place(corner, {s.barycentric[0], s.barycentric[turned ? 2 : 1],
                              s.barycentric[turned ? 1 : 2]}),
               s.offset / unit, n);
    }
    for (std::size_t e = 0; e < 3; ++e) {
      const double length = static_cast<double>(t.length[e]);
      const double x = weight[edge_after(e)] * length +
                       weight[edge_before(e)] * static_cast<double>(t.apex_x(e));
      const double h = weight[edge_before(e)] * static_cast<double>(t.apex_h(e));
      const auto seen = solved_.windows->nearest(static_cast<Index>(4 * f + e), x, h);
      if (!(seen.distance < best.distance)) continue;
      const double share = length > 0 ? seen.foot / length : 0;
      std::array<double, 3> on_edge = {};
      on_edge[e] = 1 - share;
      on_edge[edge_after(e)] = share;
      best.distance = seen.distance;
      best.from = place(corner, on_edge);
      best.source = seen.source;
    }
    return best;
  }

  [[nodiscard]] double at(Index f, const std::array<double, 3>& weight) const {
    return look(f, weight).distance;
  }
  /// Unit direction away from the source at the centre: along edge 0 and off it. 0 where the source
  /// is there, or nothing leads there.
  [[nodiscard]] std::array<double, 2> gradient(Index f) const {
    const Sight sight = look(f, {1. / 3, 1. / 3, 1. / 3});
    const double x = sight.at[0] - sight.from[0], y = sight.at[1] - sight.from[1];
    const double length = std::hypot(x, y);
    if (sight.source == none || !(length > 0)) return {0, 0};
    return {x / length, y / length};
  }

 private:
  [[nodiscard]] static std::array<double, 2> place(const std::array<double, 2> (&corner)[3],
                                                   const std::array<double, 3>& weight) {
    std::array<double, 2> p = {};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 2; ++k) p[k] += weight[i] * corner[i][k];
    return p;
  }

  const TriangleMesh<Real>& mesh_;
  const Solved<Real>& solved_;
};

}  // namespace plexway
