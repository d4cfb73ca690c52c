#include "paths/string_paths.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "complexes/common/number_range.hpp"

namespace plexway::detail {
namespace {

constexpr std::array<double, 4> centre = {.25, .25, .25, .25};

}  // namespace

template <class Real>
std::vector<Index> TetSpace<Real>::around(Index t, const std::array<double, 4>& weight) const {
  const auto& record = mesh.tets()[t];
  std::vector<Index> own;  // corners that it lies between
  std::size_t across = 4;
  for (std::size_t i = 0; i < 4; ++i)
    if (weight[i] > 0)
      own.push_back(record.corner[i]);
    else
      across = i;
  std::vector<Index> found = {t};
  if (own.size() == 3) {
    const Index next = record.across[across] >> TetAcross::tet_shift;
    if (next != static_cast<Index>(mesh.tet_count())) found.push_back(next);
  }
  if (own.empty() || own.size() > 2) return found;
  for (const Index c : mesh.corners_at(own.front())) {
    const Index* const corner = mesh.tets()[c / 4].corner;
    if (c / 4 != t && std::find(corner, corner + 4, own.back()) != corner + 4)
      found.push_back(c / 4);
  }
  return found;
}

template <class Real>
Path StringPaths<Real>::trace(const PointSource& point) const {
  const auto reached = [&](Index v) {
    return static_cast<double>(solved_.field.distance[solved_.outer[v]]) < infinity;
  };
  Index v = none, t = none;
  std::array<double, 4> weight = point.barycentric;
  if (point.vertex != none) {
    v = mesh_.inside_vertex(point.vertex);
  } else {
    const auto [tet, turned] = mesh_.inside_tet(point.simplex);
    t = tet;
    if (turned) std::swap(weight[2], weight[3]);
    if (const std::size_t i = corner_of(weight); i < 4) v = mesh_.tets()[t].corner[i];
  }
  if (v == none) {
    const auto& corner = mesh_.tets()[t].corner;
    if (std::none_of(std::begin(corner), std::end(corner), reached)) return {};
    return cut(strings_->at(mesh_, t, weight), {t});
  }
  if (!reached(v)) return {};
  std::vector<Index> around;
  for (const Index c : mesh_.corners_at(v)) around.push_back(c / 4);
  return cut(strings_->at(v), std::move(around));
}

template <class Real>
Path StringPaths<Real>::cut(const SolidStrings::Found& found, std::vector<Index> tets) const {
  if (found.points.empty() || tets.empty()) return {};
  Path path;
  path.source = found.source;
  path.length = 0;
  const auto positions = solved_.positions;
  Point before = {0, 0, 0};
  // A point of t, which the path comes to from another tetrahedron: rounding aside it is in both.
  const auto add = [&](Index t, Index from, const Point& at) {
    std::array<double, 4> b = walk_.weights(t, at);
    const auto& corner = mesh_.tets()[t].corner;
    const auto& before_it = mesh_.tets()[from].corner;
    double sum = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      const bool common =
          std::find(std::begin(before_it), std::end(before_it), corner[i]) != std::end(before_it);
      if (!(b[i] > 1e-15) || !common) b[i] = 0;
      sum += b[i];
    }
    if (!(sum > 0)) return;
    for (double& x : b) x /= sum;
    Point placed = {0, 0, 0};
    for (std::size_t i = 0; i < 4; ++i) {
      if (positions.empty()) {
        placed = placed + b[i] * mesh_.unit() * TetSpace<Real>{mesh_}.point(corner[i]);
      } else {
        const auto& p = positions[solved_.outer[corner[i]]];
        placed = placed + b[i] * Point{p[0], p[1], p[2]};
      }
    }
    if (!path.points.empty()) path.length += norm(placed - before);
    before = placed;
    const Index number = solved_.outer_simplices[t];
    if (mesh_.inside_tet(number).second) std::swap(b[2], b[3]);
    path.points.push_back({number, b});
    if (!positions.empty()) path.positions.push_back({placed.x, placed.y, placed.z});
  };
  Index last = none;
  std::vector<typename StraightWalk<TetSpace<Real>>::Step> steps;
  for (std::size_t k = found.points.size(); k-- > 1;) {
    const Point &p = found.points[k], &q = found.points[k - 1];
    walk_.walk(tets, p, q, steps);
    for (const auto& step : steps) {
      if (!(step.end > step.begin)) continue;
      add(step.simplex, last == none ? step.simplex : last, p + step.begin * (q - p));
      last = step.simplex;
    }
    if (last == none) return {};
    tets = walk_.around(last, q);
  }
  add(last, last, found.points.front());
  return path;
}

template <class Real>
double StringPaths<Real>::at(Index t, const std::array<double, 4>& weight, ReadOut level) const {
  if (level != ReadOut::linear) return strings_->at(mesh_, t, weight).distance;
  double sum = 0;
  for (std::size_t i = 0; i < 4; ++i)
    if (weight[i] > 0)  // other corners may be at infinity
      sum += weight[i] *
             static_cast<double>(solved_.field.distance[solved_.outer[mesh_.tets()[t].corner[i]]]);
  return sum;
}

template <class Real>
std::array<double, 3> StringPaths<Real>::gradient(Index t) const {
  const SolidStrings::Found found = strings_->at(mesh_, t, centre);
  const std::size_t n = found.points.size();
  if (n < 2) return {0, 0, 0};
  const Point away = strings::unit(found.points[n - 1] - found.points[n - 2]);
  return {away.x, away.y, away.z};
}

template <class Real>
Index StringPaths<Real>::source(Index t) const {
  return strings_->at(mesh_, t, centre).source;
}

template class StringPaths<float>;
template class StringPaths<double>;

}  // namespace plexway::detail
