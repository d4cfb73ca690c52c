#include "paths/surface_trace.hpp"

#include <algorithm>
#include <utility>

#include "paths/infinity.hpp"

namespace plexway::detail {
template <class Real>
SurfaceTrace<Real>::SurfaceTrace(const TriangleMesh<Real>& mesh, const Solved<Real>& solved)
    : mesh_(mesh),
      solved_(solved),
      strips_(mesh, solved.positions, solved.outer),
      shape_(strips_.shape()),
      labels_(mesh, solved) {}

template <class Real>
double SurfaceTrace<Real>::distance(Index v) const {
  if (!solved_.field.distance.empty())
    return static_cast<double>(solved_.field.distance[solved_.outer[v]]);
  double least = infinity;
  mesh_.corners_at(v, corners_);
  for (const Index c : corners_)
    if (labels_.reached(c / 3)) least = std::min(least, labels_.corner_distance(c / 3, c % 3));
  return least * mesh_.unit();
}

template <class Real>
double SurfaceTrace<Real>::promise(Index f, const std::array<double, 3>& b) const {
  double least = infinity;
  for (std::size_t i = 0; i < 3; ++i)
    least = std::min(
        least, distance(mesh_.triangles()[f].corner[i]) + shape_.distance(f, at_corner(i), b));
  return least;
}

template <class Real>
PulledWay SurfaceTrace<Real>::find(const PointSource& point, const TraceOptions& options) const {
  Index f = none;
  std::array<double, 3> b = {};
  Index vertex = point.vertex;
  if (vertex == none) {
    const auto [face, turned] = mesh_.inside_face(point.simplex);
    f = face;
    b = inside(point.barycentric, turned);
    if (const std::size_t i = corner_of(b); i < 3)
      vertex = solved_.outer[mesh_.triangles()[f].corner[i]];
  }
  const auto known = [&](Index v) { return distance(v) < infinity; };
  if (vertex != none) {
    const Index corner = mesh_.corner_at(mesh_.inside_vertex(vertex));
    if (corner == none || !known(mesh_.inside_vertex(vertex))) return {};
    f = corner / 3;
    b = at_corner(corner % 3);
  } else if (!std::any_of(std::begin(mesh_.triangles()[f].corner),
                          std::end(mesh_.triangles()[f].corner), known)) {
    return {};
  }

  if (StripWay way; solved_.windows && follow_windows(f, b, way)) {
    PulledWay best = strips_.straighten(std::move(way));
    // Exact ones leave nothing to be found.
    if (options.margin && solved_.field.accuracy != Accuracy::exact())
      search_windows(f, b, options, best);
    return best;
  }

  // A path longer than promised by this is a reason to try the shortest way along edges as well.
  constexpr double failure = 1.01;
  const double promised = promise(f, b);
  PulledWay best;
  const auto whole = [&](const PulledWay& t) {
    return t.source == none ? infinity : t.length + solved_.sources[t.source].offset;
  };
  for (const bool blindly : {false, true}) {
    StripWay way;
    if (whole(best) <= promised * failure || !descend(f, b, blindly, way)) continue;
    PulledWay traced = strips_.straighten(std::move(way));
    if (whole(traced) < whole(best)) best = std::move(traced);
  }
  if (best.source != none) search_windows(f, b, options, best);
  return best;
}

template class SurfaceTrace<float>;
template class SurfaceTrace<double>;

}  // namespace plexway::detail
