#include "paths/strip_paths.hpp"

#include <cmath>
#include <limits>
#include <utility>

namespace plexway::detail {

template <class Real>
void StripPaths<Real>::add(StripWay& way, Strip& leg, Heading& at, const Heading& to) const {
  std::vector<Crossing> around;
  if (straightener_.around(at.face, at.corner, at.angle, to.face, to.corner, to.angle,
                           std::numeric_limits<double>::infinity(), around)) {
    leg.crossings.insert(leg.crossings.end(), around.begin(), around.end());
  } else {
    leg.end = at_corner(at.corner);
    way.legs.push_back(std::move(leg));
    leg = Strip{};
    leg.first = to.face;
    leg.start = at_corner(to.corner);
  }
  at = to;
}

template <class Real>
StripWay StripPaths<Real>::joined(std::vector<Strip> strips, Index source) const {
  StripWay way;
  way.source = source;
  // Which way it goes on at a vertex is not known before it is pulled: any direction will do.
  const auto heading = [&](Index f, const std::array<double, 3>& b) {
    const std::size_t i = corner_of(b);
    return Heading{f, i, shape_.angle(f, i) / 2};
  };
  Strip leg = std::move(strips[0]);
  for (std::size_t k = 1; k < strips.size(); ++k) {
    Heading at = heading(leg.last(), leg.end);
    add(way, leg, at, heading(strips[k].first, strips[k].start));
    leg.crossings.insert(leg.crossings.end(), strips[k].crossings.begin(),
                         strips[k].crossings.end());
    leg.end = strips[k].end;
  }
  way.legs.push_back(std::move(leg));
  return way;
}

template <class Real>
PulledWay StripPaths<Real>::straighten(StripWay way) const {
  PulledWay result;
  result.source = way.source;
  for (Strip& leg : way.legs) {
    result.pulled.push_back(straightener_.straighten(leg));
    result.length += result.pulled.back().length;
  }
  result.legs = std::move(way.legs);
  return result;
}

template <class Real>
std::vector<StraightPiece> StripPaths<Real>::pieces(const PulledWay& way) {
  std::vector<StraightPiece> found;
  for (std::size_t k = 0; k < way.legs.size(); ++k) {
    const Strip& leg = way.legs[k];
    for (std::size_t i = 0; i <= leg.crossings.size(); ++i) {
      const auto in = entry(leg, way.pulled[k], i), out = exit(leg, way.pulled[k], i);
      if (in != out) found.push_back({leg.face(i), in, out});
    }
  }
  if (found.empty()) {  // it stays where it is
    const Strip& leg = way.legs.back();
    found.push_back({leg.last(), leg.end, leg.end});
  }
  return found;
}

template <class Real>
Path StripPaths<Real>::to_path(const PulledWay& way, std::span<const Position> drawn) const {
  Path path;
  path.source = way.source;
  path.windows = way.windows;
  path.capped = way.capped;
  path.length = 0;
  const auto places = shape_.embedded() ? positions_ : drawn;
  const auto push = [&](Index f, const std::array<double, 3>& b) {
    const Index number = mesh_.triangles()[f].face;
    const bool turned = (number & reversed) != 0;
    path.points.push_back({number & ~reversed, {b[0], turned ? b[2] : b[1], turned ? b[1] : b[2]}});
    if (places.empty()) return;
    Position at = {0, 0, 0};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 3; ++k)
        at[k] += b[i] * places[outer_[mesh_.triangles()[f].corner[i]]][k];
    path.positions.push_back(at);
  };
  const std::vector<StraightPiece> lines = pieces(way);
  for (const StraightPiece& line : lines) {
    if (line.from == line.to) continue;
    push(line.face, line.from);
    if (!shape_.embedded()) path.length += shape_.distance(line.face, line.from, line.to);
  }
  push(lines.back().face, lines.back().to);
  if (!shape_.embedded()) return path;
  for (std::size_t i = 0; i + 1 < path.positions.size(); ++i) {
    const auto &p = path.positions[i], &q = path.positions[i + 1];
    path.length += std::hypot(q[0] - p[0], q[1] - p[1], q[2] - p[2]);
  }
  return path;
}

template class StripPaths<float>;
template class StripPaths<double>;

}  // namespace plexway::detail
