#include "paths/media_walk.hpp"

#include <utility>

namespace plexway {

MediaWalk::Weights MediaWalk::weights(Index simplex, const Point& p) const {
  const auto& c = space_.simplices()[simplex].corner;
  const Point origin = space_.point(c[0]), off = p - origin;
  const auto edge = [&](std::size_t i) { return space_.point(c[i]) - origin; };
  Weights w = {};
  const Point u = edge(1);
  if (c[2] == none) {
    w[1] = dot(off, u) / dot(u, u);
  } else {
    const Point v = edge(2), last = c[3] == none ? cross(u, v) : edge(3);
    const double volume = dot(last, cross(u, v));
    w[1] = dot(off, cross(v, last)) / volume;
    w[2] = dot(off, cross(last, u)) / volume;
    if (c[3] != none) w[3] = dot(off, cross(u, v)) / volume;
  }
  w[0] = 1 - w[1] - w[2] - w[3];
  return w;
}

// Triangles may belong to a solid medium, if that is as fast.
bool MediaWalk::is_of(Index simplex, Index medium) const {
  const auto& s = space_.simplices()[simplex];
  return s.medium == medium && (s.corner[3] != none || !space_.media()[medium].is_solid);
}

// Up to where does the line from p to q stay in a simplex that it is in at `at`? -1: it is not.
double MediaWalk::leaves(Index simplex, const Point& p, const Point& q, double at,
                         double tolerance) const {
  const Weights from = weights(simplex, p), to = weights(simplex, q);
  double first = 1;
  for (std::size_t i = 0; i < 4; ++i) {
    if (!(from[i] + at * (to[i] - from[i]) >= -tolerance)) return -1;
    if (to[i] < -tolerance) first = std::min(first, from[i] / (from[i] - to[i]));
  }
  return first;
}

std::vector<Index> MediaWalk::around(Index simplex, const Point& p) const {
  constexpr double near = 1e-7;
  Weights w = weights(simplex, p);
  for (double& x : w)
    if (x < near) x = 0;
  return space_.simplices_around(simplex, w);
}

bool MediaWalk::walk(Index medium, std::vector<Index> from, const Point& p, const Point& q,
                     std::vector<Step>& steps) const {
  constexpr double finest = 1e-9, coarsest = 1e-2, progress = 1e-12;
  const auto arrives = [&](std::vector<Index> now, double tolerance) {
    steps.clear();
    for (double at = 0; at < 1;) {
      Step best = {none, at, at + progress};
      for (const Index s : now) {
        if (!is_of(s, medium)) continue;
        const double until = leaves(s, p, q, at, tolerance);
        if (until > best.end) best = {s, at, until};
      }
      if (best.simplex == none) return false;
      steps.push_back(best);
      at = best.end;
      now = around(best.simplex, p + at * (q - p));
    }
    return true;
  };
  for (double tolerance = finest; tolerance < coarsest; tolerance *= 10)
    if (arrives(from, tolerance)) return true;
  return arrives(std::move(from), coarsest);
}

}  // namespace plexway
