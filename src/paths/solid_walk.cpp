#include "paths/solid_walk.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plexway {

template <class Real>
typename SolidWalk<Real>::Barycentric SolidWalk<Real>::barycentric(Index t, const Point& p) const {
  const auto& c = mesh_.tets()[t].corner;
  const Point o = vertex(c[0]);
  const Point u = vertex(c[1]) - o, v = vertex(c[2]) - o, w = vertex(c[3]) - o, q = p - o;
  const Point vw = cross(v, w), wu = cross(w, u), uv = cross(u, v);
  const double volume = dot(u, vw);
  Barycentric b = {0, dot(q, vw) / volume, dot(q, wu) / volume, dot(q, uv) / volume};
  b[0] = 1 - b[1] - b[2] - b[3];
  return b;
}

template <class Real>
double SolidWalk<Real>::leaves(Index t, const Point& p, const Point& q, double at, double tolerance,
                               Index& face) const {
  const Barycentric from = barycentric(t, p), to = barycentric(t, q);
  double first = 1;
  face = none;
  for (Index i = 0; i < 4; ++i) {
    const double here = from[i] + at * (to[i] - from[i]);
    if (!(here >= -tolerance)) return -1;  // it is not in t at all; or t is flat
    if (to[i] >= -tolerance) continue;
    const double out = from[i] / (from[i] - to[i]);
    if (out < first) first = out, face = i;
  }
  return first;
}

template <class Real>
void SolidWalk<Real>::around(Index t, const Point& at, std::vector<Index>& tets) const {
  const Index sentinel = static_cast<Index>(mesh_.tet_count());
  constexpr std::size_t most = 4096;
  tets.assign(1, t);
  for (std::size_t k = 0; k < tets.size() && tets.size() < most; ++k) {
    const Barycentric b = barycentric(tets[k], at);
    for (std::size_t i = 0; i < 4; ++i) {
      if (std::abs(b[i]) > 100 * finest) continue;  // not on face i
      const Index next = mesh_.tets()[tets[k]].across[i] >> TetAcross::tet_shift;
      if (next == sentinel || std::find(tets.begin(), tets.end(), next) != tets.end()) continue;
      const Barycentric there = barycentric(next, at);
      if (*std::min_element(there.begin(), there.end()) >= -100 * finest) tets.push_back(next);
    }
  }
}

template <class Real>
void SolidWalk<Real>::all_at(Index t, const Point& at, std::vector<Index>& tets) const {
  around(t, at, tets);
  const Barycentric b = barycentric(t, at);
  std::vector<Index> own;  // corners that it lies between
  for (std::size_t i = 0; i < 4; ++i)
    if (std::abs(b[i]) > 100 * finest) own.push_back(mesh_.tets()[t].corner[i]);
  if (own.empty() || own.size() > 2) return;
  for (const Index c : mesh_.corners_at(own.front())) {
    const Index* const corner = mesh_.tets()[c / 4].corner;
    if (std::find(corner, corner + 4, own.back()) == corner + 4) continue;
    if (std::find(tets.begin(), tets.end(), c / 4) == tets.end()) tets.push_back(c / 4);
  }
}

template <class Real>
bool SolidWalk<Real>::walk(std::span<const Index> from, const Point& p, const Point& q,
                           std::vector<Step>* steps) const {
  double tolerance = finest;
  while (!walk(from, p, q, tolerance, steps))
    if ((tolerance *= 10) > coarsest) return false;
  return true;
}

template <class Real>
bool SolidWalk<Real>::walk(std::span<const Index> from, const Point& p, const Point& q,
                           double tolerance, std::vector<Step>* steps) const {
  const Index sentinel = static_cast<Index>(mesh_.tet_count());
  constexpr double progress = 1e-12;
  steps->clear();
  double at = 0;
  Index t = none, face = none;
  double until = -1;
  const auto best_of = [&](std::span<const Index> tets) {
    t = none, until = at + progress;
    for (const Index candidate : tets) {
      Index out = none;
      const double reach = leaves(candidate, p, q, at, tolerance, out);
      if (reach > until) until = reach, t = candidate, face = out;
      if (reach >= 1) return;
    }
  };
  best_of(from);
  std::vector<Index> tets;
  while (t != none) {
    steps->push_back({t, at, std::min(until, 1.)});
    if (until >= 1) return true;
    at = until;
    const Index before = t;
    const Index next = mesh_.tets()[t].across[face] >> TetAcross::tet_shift;
    t = none;
    if (next != sentinel) {
      Index out = none;
      const double reach = leaves(next, p, q, at, tolerance, out);
      if (reach > at + progress) t = next, until = reach, face = out;
    }
    if (t == none) {  // through an edge or a vertex, or along one
      around(before, p + at * (q - p), tets);
      best_of(tets);
    }
  }
  return false;
}

template class SolidWalk<float>;
template class SolidWalk<double>;

}  // namespace plexway
