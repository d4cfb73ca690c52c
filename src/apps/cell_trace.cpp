#include "apps/cell_trace.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include "apps/cell_detours.hpp"
#include "apps/cell_search.hpp"

namespace plexway {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

CellPoint in_cells(const Cells& all, const PointSource& point) {
  if (point.vertex != none) return {all.vertex(point.vertex), none, {}};
  const auto corners = all.corners(point.simplex);
  for (std::size_t i = 0; i < corners.size(); ++i)
    if (point.barycentric[i] == 1) return {corners[i], none, {}};
  return {none, point.simplex, point.barycentric};
}

Path path_of(const Cells& all, const CellString& string) {
  Path path;
  path.length = 0;
  for (std::size_t k = 0; k < string.cells.size(); ++k) {
    const double leg = string.length(all, k);
    if (!(leg > 0)) continue;
    path.length += leg;
    const Cell cell = all.cell(string.cells[k]);
    path.points.push_back({string.cells[k], k == 0 ? string.start : string.place(cell, k - 1)});
  }
  path.points.push_back({string.cells.back(), string.end});
  return path;
}

}  // namespace

Path trace_cells(const Cells& all, std::span<const double> distance,
                 std::span<const PointSource> sources, const PointSource& point) {
  const CellPoint start = in_cells(all, point);
  Path best;
  if (start.vertex != none && !(distance[start.vertex] < infinity)) return best;
  std::vector<CellGoal> goals;
  for (const PointSource& source : sources) goals.push_back({in_cells(all, source), source.offset});
  if (start.vertex != none && all.around(start.vertex).empty()) {  // a vertex of no simplex
    for (std::size_t n = 0; n < goals.size(); ++n)
      if (goals[n].point.vertex == start.vertex &&
          (best.source == none || goals[n].offset < goals[best.source].offset))
        best.source = static_cast<Index>(n), best.length = 0;
    return best;
  }
  const double promised = start.vertex != none ? distance[start.vertex] : 0;
  constexpr double close = 5e-4;
  constexpr int most_rounds = 1000;
  double whole = infinity;
  for (const std::size_t places : {2, 4, 8}) {
    auto way = search_cells(all, distance, goals, start, places);
    if (!way) return best;
    pull_taut(all, way->string);
    for (int round = 0; round < most_rounds && improve(all, way->string); ++round) {
    }
    Path path = path_of(all, way->string);
    path.source = static_cast<Index>(way->goal);
    const double length = path.length + goals[way->goal].offset;
    if (length < whole) whole = length, best = std::move(path);
    if (whole <= promised * (1 + close) || start.vertex == none) break;
  }
  return best;
}

}  // namespace plexway
