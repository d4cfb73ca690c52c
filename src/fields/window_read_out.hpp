#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include <plexway/surface/triangle_mesh.hpp>

#include "paths/solved.hpp"
#include "paths/strip.hpp"
#include "windows/window_solver.hpp"

namespace plexway::detail {

/// Distances inside triangles from the windows that a solve kept: all that entered a triangle are
/// asked, its corners, and the sources in it. Numbers and unit inside.
template <class Real>
class WindowReadOut {
 public:
  WindowReadOut(const TriangleMesh<Real>& mesh, const Solved<Real>& solved)
      : mesh_(mesh), solved_(solved) {
    for (Index n = 0; n < solved.sources.size(); ++n)
      if (solved.sources[n].vertex == none)
        within_.emplace_back(mesh.inside_face(solved.sources[n].simplex).first, n);
    std::sort(within_.begin(), within_.end());
  }

  /// The last straight piece of a path in a triangle: from a place on its rim, or from a source.
  struct Sight {
    enum class Over { nothing, corner, edge, source };
    double distance = std::numeric_limits<double>::infinity();
    Over over = Over::nothing;
    std::size_t edge = 3;
    std::array<double, 3> place = {};  ///< barycentric
    Index source = none;
  };
  /// From where a point of triangle f is seen: one at a corner from elsewhere than that corner and
  /// over the edge across, one on edge `entered` not over that.
  [[nodiscard]] Sight look(Index f, const std::array<double, 3>& weight,
                           std::size_t entered = 3) const {
    const TriangleRecord<Real>& t = mesh_.triangles()[f];
    const std::size_t own = corner_of(weight);
    Sight best;
    const auto offer = [&](double d, typename Sight::Over over, std::size_t edge,
                           const std::array<double, 3>& place, Index source) {
      if (d < best.distance) best = {d, over, edge, place, source};
    };
    const double unit = mesh_.unit();
    for (std::size_t i = 0; i < 3; ++i) {
      const Index v = solved_.outer[t.corner[i]];
      const double d = static_cast<double>(solved_.field.distance[v]);
      if (i == own || !(d < std::numeric_limits<double>::infinity())) continue;
      offer(d / unit + apart(t, weight, at_corner(i)), Sight::Over::corner, 3, at_corner(i),
            solved_.field.label.empty() ? 0 : solved_.field.label[v]);
    }
    for (auto at = std::lower_bound(within_.begin(), within_.end(), std::pair<Index, Index>(f, 0));
         at != within_.end() && at->first == f; ++at) {
      const PointSource& s = solved_.sources[at->second];
      const bool turned = mesh_.inside_face(s.simplex).second;
      const std::array<double, 3> place = {s.barycentric[0], s.barycentric[turned ? 2 : 1],
                                           s.barycentric[turned ? 1 : 2]};
      offer(s.offset / unit + apart(t, weight, place), Sight::Over::source, 3, place, at->second);
    }
    for (std::size_t e = 0; e < 3; ++e) {
      if (e == entered || (own < 3 && e != edge_after(own))) continue;
      const double length = static_cast<double>(t.length[e]);
      const double x = weight[edge_after(e)] * length +
                       weight[edge_before(e)] * static_cast<double>(t.apex_x(e));
      const double h = weight[edge_before(e)] * static_cast<double>(t.apex_h(e));
      const auto seen = solved_.windows->nearest(static_cast<Index>(4 * f + e), x, h);
      if (!(seen.distance < best.distance)) continue;
      const double share = length > 0 ? seen.foot / length : 0;
      std::array<double, 3> place = {};
      place[e] = 1 - share;
      place[edge_after(e)] = share;
      offer(seen.distance, Sight::Over::edge, e, place, seen.source);
    }
    return best;
  }

  [[nodiscard]] double at(Index f, const std::array<double, 3>& weight) const {
    const std::size_t own = corner_of(weight);
    if (own == 3) return look(f, weight).distance;
    const Index v = solved_.outer[mesh_.triangles()[f].corner[own]];
    return static_cast<double>(solved_.field.distance[v]) / mesh_.unit();
  }

 private:
  /// From q to p, along edge 0 and off it.
  [[nodiscard]] static std::array<double, 2> difference(const TriangleRecord<Real>& t,
                                                        const std::array<double, 3>& p,
                                                        const std::array<double, 3>& q) {
    const double b = p[1] - q[1], c = p[2] - q[2];
    return {b * static_cast<double>(t.length[0]) + c * static_cast<double>(t.apex_x(0)),
            c * static_cast<double>(t.apex_h(0))};
  }
  [[nodiscard]] static double apart(const TriangleRecord<Real>& t, const std::array<double, 3>& p,
                                    const std::array<double, 3>& q) {
    const auto [x, y] = difference(t, p, q);
    return std::hypot(x, y);
  }

  const TriangleMesh<Real>& mesh_;
  const Solved<Real>& solved_;
  std::vector<std::pair<Index, Index>> within_;  ///< triangles with a source inside, and which
};

}  // namespace plexway::detail
