#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <plexway/source/source.hpp>

#include "complexes/test_meshes.hpp"

/// Straight curves on flat surfaces, found face by face, and distances from them.
namespace plexway::testing {

/// What a straight line in the xy plane has in the faces that it passes, in its order.
struct FlatCurve {
  std::vector<std::pair<PointSource, PointSource>> pieces;

  [[nodiscard]] CurveSource source() const {
    CurveSource curve;
    curve.points.push_back(pieces.front().first);
    for (const auto& piece : pieces) curve.points.push_back(piece.second);
    return curve;
  }
  /// `count` points on it, as many in each piece as in any.
  [[nodiscard]] std::vector<PointSource> points(std::size_t count) const {
    std::vector<PointSource> points;
    for (std::size_t n = 0; n < count; ++n) {
      const double at = (static_cast<double>(n) + 0.5) * static_cast<double>(pieces.size()) /
                        static_cast<double>(count);
      const std::size_t k = static_cast<std::size_t>(at);
      const double t = at - static_cast<double>(k);
      PointSource p = pieces[k].first;
      for (std::size_t i = 0; i < 3; ++i)
        p.barycentric[i] += t * (pieces[k].second.barycentric[i] - p.barycentric[i]);
      points.push_back(p);
    }
    return points;
  }
};

/// The line from a to b, over faces that `counts` names.
template <class Counts>
FlatCurve flat_curve(const Surface& s, const Position& a, const Position& b, Counts counts) {
  struct Part {
    double from, to;
    PointSource first, last;
  };
  std::vector<Part> parts;
  for (Index f = 0; f < s.faces.size(); ++f) {
    if (!counts(f)) continue;
    double low = 0, high = 1, wa[3] = {}, wb[3] = {};
    const double all = area2(s, s.faces[f][0], s.faces[f][1], s.faces[f][2]);
    for (std::size_t i = 0; i < 3; ++i) {
      const Position &p = s.positions[s.faces[f][(i + 1) % 3]],
                     &q = s.positions[s.faces[f][(i + 2) % 3]];
      const auto weight = [&](const Position& x) {
        const double w = ((q[0] - p[0]) * (x[1] - p[1]) - (q[1] - p[1]) * (x[0] - p[0])) / all;
        return std::abs(w) < 1e-12 ? 0 : w;
      };
      wa[i] = weight(a), wb[i] = weight(b);
      if (wa[i] <= 0 && wb[i] <= 0 && wa[i] + wb[i] < 0) high = -1;
      if (wa[i] < 0 && wb[i] > 0) low = std::max(low, wa[i] / (wa[i] - wb[i]));
      if (wa[i] > 0 && wb[i] < 0) high = std::min(high, wa[i] / (wa[i] - wb[i]));
    }
    if (!(high - low > 1e-9)) continue;
    const auto at = [&](double t) {
      std::array<double, 3> w;
      double sum = 0;
      for (std::size_t i = 0; i < 3; ++i) sum += w[i] = std::max(0., wa[i] + t * (wb[i] - wa[i]));
      for (double& x : w) x /= sum;
      return PointSource::in(f, w);
    };
    parts.push_back({low, high, at(low), at(high)});
  }
  std::stable_sort(parts.begin(), parts.end(),
                   [](const Part& p, const Part& q) { return p.from < q.from; });
  FlatCurve curve;
  double reached = -1;
  for (const Part& p : parts) {
    if (p.from < reached - 1e-9) continue;  // along an edge: the face on the other side
    curve.pieces.emplace_back(p.first, p.last);
    reached = p.to;
  }
  return curve;
}
inline FlatCurve flat_curve(const Surface& s, const Position& a, const Position& b) {
  return flat_curve(s, a, b, [](Index) { return true; });
}

inline double distance_to_segment(const Position& p, const Position& a, const Position& b) {
  double ab = 0, ap = 0, d = 0;
  for (std::size_t i = 0; i < 3; ++i)
    ab += (b[i] - a[i]) * (b[i] - a[i]), ap += (b[i] - a[i]) * (p[i] - a[i]);
  const double t = ab > 0 ? std::clamp(ap / ab, 0., 1.) : 0;
  for (std::size_t i = 0; i < 3; ++i) d += std::pow(p[i] - a[i] - t * (b[i] - a[i]), 2);
  return std::sqrt(d);
}

}  // namespace plexway::testing
