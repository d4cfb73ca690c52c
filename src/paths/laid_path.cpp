#include "paths/laid_path.hpp"

#include <algorithm>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

namespace plexway::detail {
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
