#include "paths/cell_trace.hpp"

#include <cmath>
#include <vector>

#include "paths/cell_detours.hpp"
#include "paths/cell_search.hpp"
#include "paths/infinity.hpp"

namespace plexway {
namespace {

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

// The shortest way by a corner of the cell.
double by_corners(const Cells& all, std::span<const double> distance, const CellPoint& start) {
  const Cell cell = all.cell(start.cell);
  Point3 place{};
  for (std::size_t i = 0; i < cell.corners; ++i)
    for (std::size_t k = 0; k < 3; ++k) place[k] += start.at[i] * cell.place[i][k];
  double best = infinity;
  for (std::size_t i = 0; i < cell.corners; ++i) {
    const Point3 leg = minus(cell.place[i], place);
    best = std::min(best, distance[cell.vertex[i]] + std::sqrt(dot(leg, leg)));
  }
  return best;
}

void add_positions(const CellField& field, Path& path) {
  if (field.positions.empty()) return;
  for (const PathPoint& p : path.points) {
    const std::array<Index, 4> outer = field.cells.outer_corners(p.simplex);
    std::array<double, 3> place = {0, 0, 0};
    for (std::size_t i = 0; i < 4 && outer[i] != none; ++i)
      for (std::size_t k = 0; k < 3; ++k)
        place[k] += p.barycentric[i] * field.positions[outer[i]][k];
    path.positions.push_back(place);
  }
}

}  // namespace

double read_cells(const CellField& field, const PointSource& point, ReadOut level) {
  const CellPoint start = in_cells(field.cells, point);
  if (start.vertex != none) return field.distance[start.vertex];
  if (level == ReadOut::linear) {
    const auto corners = field.cells.corners(start.cell);
    double sum = 0;
    for (std::size_t i = 0; i < corners.size(); ++i)
      if (start.at[i] > 0) sum += start.at[i] * field.distance[corners[i]];
    return sum;
  }
  const Path path = trace_cells(field, point);
  const double whole =
      path.source == none ? infinity : path.length + field.sources[path.source].offset;
  return std::min(whole, by_corners(field.cells, field.distance, start));
}

Path trace_cells(const CellField& field, const PointSource& point) {
  const Cells& all = field.cells;
  const std::span<const double> distance = field.distance;
  const std::span<const PointSource> sources = field.sources;
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
  const double promised =
      start.vertex != none ? distance[start.vertex] : by_corners(all, distance, start);
  constexpr double close = 5e-4;
  constexpr int most_rounds = 1000;
  double whole = infinity;
  for (const std::size_t places : {2, 4, 8}) {
    auto way = search_cells(all, distance, goals, start, places);
    if (!way) break;
    pull_taut(all, way->string);
    for (int round = 0; round < most_rounds && improve(all, way->string); ++round) {
    }
    Path path = path_of(all, way->string);
    path.source = static_cast<Index>(way->goal);
    const double length = path.length + goals[way->goal].offset;
    if (length < whole) whole = length, best = std::move(path);
    if (whole <= promised * (1 + close)) break;
  }
  add_positions(field, best);
  return best;
}

}  // namespace plexway
