#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <functional>
#include <vector>

#include <plexway/executors/source_sets.hpp>

#include "complex/test_meshes.hpp"

using namespace plexway;
using namespace plexway::testing;

namespace {

// The points where a straight line from a to b in the plane passes the edges of a flat surface.
CurveSource straight_curve(const Surface& s, const Position& a, const Position& b) {
  struct Piece {
    double from, to;
    PointSource first, last;
  };
  std::vector<Piece> pieces;
  for (Index f = 0; f < s.faces.size(); ++f) {
    double lo = 0, hi = 1;
    double wa[3] = {}, wb[3] = {};
    const double all = area2(s, s.faces[f][0], s.faces[f][1], s.faces[f][2]);
    for (std::size_t i = 0; i < 3 && lo < hi; ++i) {
      const Position &p = s.positions[s.faces[f][(i + 1) % 3]],
                     &q = s.positions[s.faces[f][(i + 2) % 3]];
      const auto side = [&](const Position& x) {
        return ((q[0] - p[0]) * (x[1] - p[1]) - (q[1] - p[1]) * (x[0] - p[0])) / all;
      };
      wa[i] = side(a), wb[i] = side(b);
      if (std::abs(wa[i]) < 1e-12) wa[i] = 0;
      if (std::abs(wb[i]) < 1e-12) wb[i] = 0;
      if (wa[i] <= 0 && wb[i] <= 0 && wa[i] + wb[i] < 0) hi = lo;
      if (wa[i] < 0 && wb[i] > 0) lo = std::max(lo, wa[i] / (wa[i] - wb[i]));
      if (wa[i] > 0 && wb[i] < 0) hi = std::min(hi, wa[i] / (wa[i] - wb[i]));
    }
    if (!(hi - lo > 1e-9)) continue;
    const auto at = [&](double t) {
      std::array<double, 3> w;
      double sum = 0;
      for (std::size_t i = 0; i < 3; ++i) sum += w[i] = std::max(0., wa[i] + t * (wb[i] - wa[i]));
      for (double& x : w) x /= sum;
      return PointSource::in(f, w);
    };
    pieces.push_back({lo, hi, at(lo), at(hi)});
  }
  std::sort(pieces.begin(), pieces.end(),
            [](const Piece& p, const Piece& q) { return p.from < q.from; });
  CurveSource curve;
  double reached = -1;
  for (const Piece& p : pieces) {
    if (p.from < reached - 1e-9) continue;  // along an edge
    if (reached < 0) curve.points.push_back(p.first);
    curve.points.push_back(p.last);
    reached = p.to;
  }
  return curve;
}

double to_segment(const Position& p, const Position& a, const Position& b) {
  double ab = 0, ap = 0, d = 0;
  for (std::size_t i = 0; i < 3; ++i)
    ab += (b[i] - a[i]) * (b[i] - a[i]), ap += (b[i] - a[i]) * (p[i] - a[i]);
  const double t = ab > 0 ? std::clamp(ap / ab, 0., 1.) : 0;
  for (std::size_t i = 0; i < 3; ++i) d += std::pow(p[i] - a[i] - t * (b[i] - a[i]), 2);
  return std::sqrt(d);
}

double worst(const Surface& s, const std::vector<double>& found,
             const std::function<double(const Position&)>& exact) {
  double most = 0;
  for (std::size_t v = 0; v < found.size(); ++v) {
    const double d = exact(s.positions[v]);
    const double e = std::abs(found[v] - d) / std::max(d, 1e-3);
    if (e > most) most = e;
  }
  return most;
}

}  // namespace

TEST_CASE("a segment in the plane is exact") {
  const Surface meshes[] = {grid(24, 24), random_polygon(9, 600, 900, 5)};
  const std::pair<Position, Position> segments[] = {{{0.31, 0.42, 0}, {0.64, 0.57, 0}},
                                                    {{0.25, 0.5, 0}, {0.75, 0.5, 0}},
                                                    {{0.5, 0.51, 0}, {0.503, 0.512, 0}}};
  for (const Surface& s : meshes) {
    const auto mesh = s.mesh<double>();
    for (const auto& [a, b] : segments) {
      const CurveSource curve = straight_curve(s, a, b);
      const auto rule = [&](const Position& p) { return to_segment(p, a, b); };
      const auto field = propagate(Serial{}, mesh, Source(curve));
      std::printf("%zu points, worst %g  upd %zu of %zu\n", curve.points.size(),
                  worst(s, field.distance, rule), field.statistics.updates, s.faces.size());
      CHECK(worst(s, field.distance, rule) < 1e-4);
    }
  }
}
