#include "paths/cells/cells.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "complexes/common/number_range.hpp"

namespace plexway::detail {
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
    const Cell cell = all.cell(string.cells[k]);
    const auto ends = string.leg(cell, k);
    // Along an edge without length it goes on.
    if (!(leg > 0) && (cell.corners > 2 || ends[0] == ends[1])) continue;
    path.length += leg;
    path.points.push_back({string.cells[k], ends[0]});
  }
  path.points.push_back({string.cells.back(), string.end});
  return path;
}

// A point of a cell by the vertices that it lies between; by none inside of a tetrahedron.
CellCrossing held_by(const Cell& cell, const std::array<double, 4>& at) {
  constexpr double touching = 1e-5;
  CellCrossing held;
  double sum = 0;
  for (std::size_t i = 0; i < cell.corners; ++i) {
    if (!(at[i] > touching) || held.face.has(cell.vertex[i])) continue;  // a loop has one twice
    if (held.face.corners == 3) return {};
    held.face.add(cell.vertex[i]);
    sum += at[i];
  }
  for (std::size_t i = 0; i < held.face.corners; ++i)
    held.at[i] = at[cell.corner(held.face.vertex[i])] / sum;
  return held;
}

// Places of a face that has the point: there, and ever nearer to it. On the point's own face only
// `along`, where that may be followed.
void add_places(const CellCrossing& held, const CellFace& face, bool along, FacePlaces& places) {
  constexpr int levels = 4;
  std::array<double, 3> point = {};
  std::vector<std::size_t> others;
  for (std::size_t i = 0; i < face.corners; ++i) {
    if (!held.face.has(face.vertex[i])) others.push_back(i);
    for (std::size_t k = 0; k < held.face.corners; ++k)
      if (held.face.vertex[k] == face.vertex[i]) point[i] = held.at[k];
  }
  std::vector<std::array<double, 3>> aims;
  if (others.size() == 2) {
    auto& aim = aims.emplace_back();
    aim[others[0]] = aim[others[1]] = .5;
  } else {
    if (others.empty() && along) others.assign({0, 1, 2});
    for (const std::size_t i : others)
      if (i < face.corners) aims.emplace_back()[i] = 1;
  }
  places.push_back(point);
  for (const auto& aim : aims)
    for (int level = 1; level <= levels; ++level) {
      const double share = std::ldexp(1., -2 * level);
      auto& place = places.emplace_back();
      for (std::size_t i = 0; i < 3; ++i) place[i] = (1 - share) * point[i] + share * aim[i];
    }
}

// The cells at all places of a string, and places around these: a shorter way around the vertex or
// edge that holds it, or along a sheet that it crosses, leads over them.
Corridor corridor_of(const Cells& all, const CellString& string) {
  Corridor corridor;
  std::vector<Index> around;
  std::vector<CellFace> seen;
  const std::size_t n = string.crossings.size();
  for (std::size_t k = 0; k <= n + 1; ++k) {
    corridor.cells.insert(string.cells[std::min(k, n)]);
    const Cell cell = all.cell(string.cells[std::min(k, n)]);
    const CellCrossing held = held_by(cell, k == 0   ? string.start
                                            : k <= n ? string.place(cell, k - 1)
                                                     : string.end);
    if (held.face.corners == 0) continue;
    all.around(held.face, around);
    seen.clear();
    for (const Index s : around) {
      corridor.cells.insert(s);
      const auto corners = all.corners(s);
      const bool is_wire = corners.size() == 2;  // which meets others at vertices
      for (unsigned set = 1; set < (1u << corners.size()) && set < 15; ++set) {
        CellFace face;
        std::size_t common = 0;
        for (std::size_t i = 0; i < corners.size(); ++i)
          if (set >> i & 1) face.add(corners[i]), common += held.face.has(corners[i]);
        if (face.corners == 1) corridor.places[face] = {{1, 0, 0}};
        if (face.corners == 1 || is_wire || common < held.face.corners ||
            std::find(seen.begin(), seen.end(), face) != seen.end())
          continue;
        seen.push_back(face);
        add_places(held, face, around.size() > 2, corridor.places[face]);
      }
    }
  }
  return corridor;
}

constexpr double worth = 1e-10;  // what a change must gain, of the length

double size_of(const Cell& cell) {
  double size = 0;
  for (std::size_t i = 1; i < cell.corners; ++i)
    size = std::max(size, norm(minus(cell.place[i], cell.place[0])));
  return size;
}

// The cells around what holds a point, and places near it of each face that two of them may share,
// by a share of the face: all ways around, but for that point.
Corridor ring_around(const Cells& all, const CellCrossing& held, double share) {
  Corridor ring;
  std::vector<Index> around;
  all.around(held.face, around);
  for (const Index s : around) {
    const auto corners = all.corners(s);
    if (corners.size() == 2) continue;
    ring.cells.insert(s);
    for (const Index left_out : corners) {
      if (held.face.has(left_out)) continue;
      CellFace face;
      for (const Index v : corners)
        if (v != left_out) face.add(v);
      if (face.corners == held.face.corners) continue;
      FacePlaces& places = ring.places[face];
      if (!places.empty()) continue;
      const bool two = face.corners - held.face.corners == 2;
      for (const double first : two ? std::vector{.2, .5, .8} : std::vector{1.}) {
        auto& place = places.emplace_back();
        bool second = false;
        for (std::size_t i = 0; i < face.corners; ++i) {
          if (!held.face.has(face.vertex[i])) {
            place[i] = share * (second ? 1 - first : first);
            second = true;
          }
          for (std::size_t k = 0; k < held.face.corners; ++k)
            if (held.face.vertex[k] == face.vertex[i]) place[i] = (1 - share) * held.at[k];
        }
      }
    }
  }
  return ring;
}

// Around what holds the string at crossings `first` to `last`, which are one point. False if every
// way around is longer.
bool go_around(const Cells& all, CellString& string, std::size_t first, std::size_t last,
               const CellCrossing& held) {
  const auto at = [](auto& v, std::size_t k) { return v.begin() + static_cast<std::ptrdiff_t>(k); };
  CellString part;
  part.cells.assign(at(string.cells, first), at(string.cells, last + 2));
  part.crossings.assign(at(string.crossings, first), at(string.crossings, last + 1));
  part.start = first == 0 ? string.start : string.place(all.cell(part.cells.front()), first - 1);
  part.end = last + 1 == string.crossings.size()
                 ? string.end
                 : string.place(all.cell(part.cells.back()), last + 1);
  const double known = part.length(all);
  const CellPoint start = {none, part.cells.front(), part.start};
  const CellGoal goal = {{none, part.cells.back(), part.end}, 0};
  // Near enough that the least way is the one of the least angle.
  const double near = std::min(part.length(all, 0), part.length(all, part.cells.size() - 1)) /
                      size_of(all.cell(part.cells.front()));
  Corridor ring = ring_around(all, held, std::clamp(near / 4, 1e-4, .2));
  constexpr int ways = 4;
  for (int k = 0; k < ways; ++k) {
    auto way = search_cells(all, ring, std::span(&goal, 1), start);
    if (!way) return false;
    CellString& other = way->string;
    const std::vector<Index> passed = other.cells;
    if (passed.size() == 2) ring.places.erase(other.crossings[0].face);
    pull_taut(all, other);
    if (other.length(all) < known * (1 - worth)) {
      const auto exchange = [&](auto& whole, auto& with, std::size_t begin, std::size_t end) {
        whole.erase(at(whole, begin), at(whole, end));
        whole.insert(at(whole, begin), with.begin(), with.end());
      };
      exchange(string.cells, other.cells, first, last + 2);
      exchange(string.crossings, other.crossings, first, last + 1);
      return true;
    }
    for (std::size_t i = 1; i + 1 < passed.size(); ++i) ring.cells.erase(passed[i]);
  }
  return false;
}

// Around all that holds the string, from its end on, so that places before stay what they are.
bool go_around(const Cells& all, CellString& string) {
  constexpr double touching = 1e-5;
  bool any = false;
  for (std::size_t last = string.crossings.size(); last-- > 0;) {
    std::size_t first = last;
    Cell cell = all.cell(string.cells[last]);
    CellCrossing held = held_by(cell, string.place(cell, last));
    for (; first > 0; --first) {
      if (string.length(all, first) > touching * size_of(cell)) break;
      const Cell before = all.cell(string.cells[first - 1]);
      const CellCrossing there = held_by(before, string.place(before, first - 1));
      CellFace common;  // of two points that are one but for rounding
      for (std::size_t i = 0; i < there.face.corners; ++i)
        if (held.face.has(there.face.vertex[i])) common.add(there.face.vertex[i]);
      if (common.corners == 0) break;
      auto at = string.place(before, first - 1);
      for (std::size_t i = 0; i < before.corners; ++i)
        if (!common.has(before.vertex[i])) at[i] = 0;
      held = held_by(before, at);
      cell = before;
    }
    if (held.face.corners < 3) any |= go_around(all, string, first, last, held);
    last = first;
  }
  return any;
}

// False if nothing was gained. Every change gains, so repeating it ends.
bool improve(const Cells& all, const CellGoal& goal, const CellPoint& start, CellString& string) {
  const double before = string.length(all);
  if (go_around(all, string)) {
    pull_taut(all, string);
    if (string.length(all) < before * (1 - worth)) return true;
  }
  if (auto way = search_cells(all, corridor_of(all, string), std::span(&goal, 1), start)) {
    pull_taut(all, way->string);
    if (way->string.length(all) < string.length(all)) string = std::move(way->string);
  }
  return string.length(all) < before * (1 - worth);
}

// The shortest way by a corner of the cell.
double by_corners(const Cells& all, std::span<const double> distance, const CellPoint& start) {
  const Cell cell = all.cell(start.cell);
  double best = infinity;
  for (std::size_t i = 0; i < cell.corners; ++i) {
    const Point3 leg = minus(cell.place[i], place_in(cell, start.at));
    best = std::min(best, distance[cell.vertex[i]] + norm(leg));
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
  if (!field.in_space) return;
  path.length = 0;
  for (std::size_t i = 0; i + 1 < path.positions.size(); ++i)
    path.length += norm(minus(path.positions[i + 1], path.positions[i]));
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
  double whole = by_corners(field.cells, field.distance, start);
  if (const Cell cell = field.cells.cell(start.cell); cell.corners == 2) {
    for (const PointSource& source : field.sources)
      if (source.vertex == none && source.simplex == start.cell)
        whole = std::min(whole, source.offset + norm(minus(place_in(cell, source.barycentric),
                                                           place_in(cell, start.at))));
    return whole;
  }
  const Path path = trace_cells(field, point);
  return path.source == none ? whole
                             : std::min(whole, path.length + field.sources[path.source].offset);
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
  constexpr double close = 3e-4, doubt = 1e-2;
  const int most_rounds = all.only_edges() ? 0 : 1000;
  double whole = infinity;
  for (const std::size_t places : {2, 4, 8}) {
    auto way = search_cells(all, distance, goals, start, places);
    if (!way) break;
    pull_taut(all, way->string);
    for (int round = 0; round < most_rounds && improve(all, goals[way->goal], start, way->string);
         ++round) {
    }
    Path path = path_of(all, way->string);
    path.source = static_cast<Index>(way->goal);
    const double length = path.length + goals[way->goal].offset;
    if (length < whole) whole = length, best = std::move(path);
    const bool doubtful = start.vertex != none && whole < promised * (1 - doubt);
    if (!doubtful && whole <= promised * (1 + close)) break;
  }
  add_positions(field, best);
  return best;
}

}  // namespace plexway::detail
