#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "paths/strip_paths.hpp"

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

template <class Real>
std::vector<StraightPiece> laid_on(const TriangleMesh<Real>& input,
                                   const IntrinsicDelaunay& delaunay,
                                   const TriangleMesh<Real>& mesh, const StraightPiece& line) {
  const Index number = mesh.triangles()[line.face].face;
  const bool other_way = (number & reversed) != 0;
  std::vector<StraightPiece> pieces;
  for (const auto& piece : delaunay.line_to_input(number & ~reversed, turned(line.from, other_way),
                                                  turned(line.to, other_way))) {
    const auto [face, runs_back] = input.inside_face(piece.face);
    pieces.push_back({face, turned(piece.from, runs_back), turned(piece.to, runs_back)});
  }
  return pieces;
}
template std::vector<StraightPiece> laid_on(const TriangleMesh<float>&, const IntrinsicDelaunay&,
                                            const TriangleMesh<float>&, const StraightPiece&);
template std::vector<StraightPiece> laid_on(const TriangleMesh<double>&, const IntrinsicDelaunay&,
                                            const TriangleMesh<double>&, const StraightPiece&);

/// From the last strip's end, a point of this triangle as well but for rounding: over the edge
/// between, or else from vertex to vertex by as few triangles as do, mostly none.
template <class Real>
void LaidPaths<Real>::go_on(std::vector<Strip>& strips, Index face) const {
  Strip& strip = strips.back();
  const Index last = strip.last();
  if (last == face) return;
  std::optional<Crossing> over;
  for (std::size_t e = 0; e < 3; ++e)
    across_edge(mesh_, last, e, [&](const Crossing& c) {
      const bool nearer = !over || strip.end[edge_before(e)] < strip.end[edge_before(over->from)];
      if (c.face == face && nearer) over = c;
    });
  if (over) {
    strip.crossings.push_back(*over);
    return;
  }
  // By which corner of a triangle, 3 f + i, into which of the next. The nearest corner comes first.
  std::unordered_map<Index, std::pair<Index, Index>> came = {{last, {none, none}}};
  std::vector<Index> reached = {last}, corners;
  std::array<std::size_t, 3> order = {0, 1, 2};
  std::sort(order.begin(), order.end(),
            [&](std::size_t i, std::size_t k) { return strip.end[i] > strip.end[k]; });
  for (std::size_t n = 0; n < reached.size() && came.count(face) == 0; ++n)
    for (const std::size_t i : order) {
      mesh_.corners_at(mesh_.triangles()[reached[n]].corner[i], corners);
      for (const Index c : corners)
        if (came.try_emplace(c / 3, 3 * reached[n] + static_cast<Index>(i), c).second)
          reached.push_back(c / 3);
    }
  std::vector<std::pair<Index, Index>> hops;
  for (Index f = face; f != last; f = hops.back().first / 3) hops.push_back(came.at(f));
  std::for_each(hops.rbegin(), hops.rend(), [&](const std::pair<Index, Index>& hop) {
    strips.back().end = at_corner(hop.first % 3);
    Strip next;
    next.first = hop.second / 3;
    next.start = at_corner(hop.second % 3);
    strips.push_back(std::move(next));
  });
}

template <class Real>
Path LaidPaths<Real>::lay(std::span<const StraightPiece> lines, const PointSource& from,
                          const PointSource& to) const {
  std::vector<Strip> strips;
  // A vertex is in whatever triangle the path is in beside it.
  const auto go_to = [&](const PointSource& point, Index beside) {
    Index face = beside;
    std::array<double, 3> at = {};
    if (point.vertex == none) {
      const auto [own, runs_back] = mesh_.inside_face(point.simplex);
      face = own;
      at = turned({point.barycentric[0], point.barycentric[1], point.barycentric[2]}, runs_back);
    } else {
      const Index vertex = mesh_.inside_vertex(point.vertex);
      const auto corner_in = [&](Index f) {
        const auto& corner = mesh_.triangles()[f].corner;
        return static_cast<std::size_t>(std::find(corner, corner + 3, vertex) - corner);
      };
      if (corner_in(face) == 3) face = mesh_.corner_at(vertex) / 3;
      at = at_corner(corner_in(face));
    }
    if (strips.empty()) {
      strips.emplace_back();
      strips.back().first = face;
      strips.back().start = at;
    }
    go_on(strips, face);
    strips.back().end = at;
  };
  for (const StraightPiece& line : lines) {
    if (strips.empty()) go_to(from, line.face);
    go_on(strips, line.face);
    strips.back().end = line.to;
  }
  go_to(to, strips.back().last());
  return strips_.to_path(strips_.straighten(strips_.joined(std::move(strips), none)));
}

template class LaidPaths<float>;
template class LaidPaths<double>;

}  // namespace plexway::detail
