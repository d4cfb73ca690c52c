#include "contours.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <utility>

namespace plexway::render {
namespace {

using Place3 = std::array<float, 3>;
using Edge = std::pair<Place3, Place3>;  // the lesser end first: both triangles have the same

Point point_on(const Corner& a, const Corner& b, double value) {
  const double t = (value - static_cast<double>(a.value)) /
                   (static_cast<double>(b.value) - static_cast<double>(a.value));
  Point p;
  for (std::size_t k = 0; k < 3; ++k)
    p[k] = static_cast<double>(a.position[k]) +
           t * (static_cast<double>(b.position[k]) - static_cast<double>(a.position[k]));
  return p;
}

}  // namespace

bool has_contours(const Batch& batch) {
  return batch.isolines && batch.joined && batch.look != Look::ghost && batch.others.empty() &&
         std::all_of(batch.corners.begin(), batch.corners.end(), [](const Corner& corner) {
           return corner.paint == by_value || corner.paint[3] == 255;
         });
}

std::vector<std::vector<Point>> contours(const Batch& batch, double value) {
  struct Piece {
    std::array<Edge, 2> edge;
    std::array<Point, 2> point;
    bool done = false;
  };
  std::vector<Piece> pieces;
  std::multimap<Edge, std::size_t> at;
  const auto above = [&](const Corner& c) { return static_cast<double>(c.value) >= value; };
  for (std::size_t n = 0; n + 2 < batch.corners.size(); n += 3) {
    const Corner* const corner = &batch.corners[n];
    if (corner[0].paint != by_value ||
        (above(corner[0]) == above(corner[1]) && above(corner[1]) == above(corner[2])))
      continue;
    Piece piece;
    std::size_t count = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const Corner *a = &corner[i], *b = &corner[(i + 1) % 3];
      if (above(*a) == above(*b) || count == 2) continue;
      if (b->position < a->position) std::swap(a, b);
      piece.edge[count] = {a->position, b->position};
      piece.point[count++] = point_on(*a, *b, value);
    }
    for (const Edge& edge : piece.edge) at.emplace(edge, pieces.size());
    pieces.push_back(piece);
  }
  std::vector<std::vector<Point>> lines;
  const auto follow = [&](std::size_t p, std::size_t end) {
    std::vector<Point> line = {pieces[p].point[end]};
    for (bool more = true; more;) {
      pieces[p].done = true;
      line.push_back(pieces[p].point[1 - end]);
      const Edge to = pieces[p].edge[1 - end];
      more = false;
      const auto [first, last] = at.equal_range(to);
      for (auto next = first; next != last && !more; ++next) {
        if (pieces[next->second].done) continue;
        p = next->second;
        end = pieces[p].edge[0] == to ? 0 : 1;
        more = true;
      }
    }
    lines.push_back(std::move(line));
  };
  // Those with an end first; then what is closed.
  for (const bool open : {true, false})
    for (std::size_t p = 0; p < pieces.size(); ++p)
      for (std::size_t end = 0; end < 2; ++end)
        if (!pieces[p].done && (!open || at.count(pieces[p].edge[end]) == 1)) follow(p, end);
  return lines;
}

}  // namespace plexway::render
