#include "paths/cell_detours.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "sampling/cell_around.hpp"

namespace plexway {
namespace {

constexpr double touching = 1e-5;  // coordinates, and lengths as a share of a cell
constexpr double worth = 1e-10;    // what a change must gain, of the length

// The vertices that a crossing's point has coordinates of.
CellFace held_by(const CellCrossing& crossing) {
  CellFace face;
  for (std::size_t i = 0; i < crossing.face.corners; ++i)
    if (crossing.at[i] > touching) face.add(crossing.face.vertex[i]);
  return face;
}

double size_of(const Cell& cell) {
  double most = 0;
  for (std::size_t i = 1; i < cell.corners; ++i)
    most = std::max(most, norm(minus(cell.place[i], cell.place[0])));
  return most;
}

// Crossings first to last are one point, on `held`.
struct Contact {
  std::size_t first, last;
  CellCrossing held;
};

std::vector<Contact> contacts_of(const Cells& all, const CellString& string) {
  std::vector<Contact> contacts;
  std::vector<CellFace> held;
  for (std::size_t k = 0; k < string.crossings.size(); ++k) {
    const CellFace face = held_by(string.crossings[k]);
    if (!contacts.empty()) {
      CellFace common;  // of two points that are one but for rounding
      for (std::size_t i = 0; i < face.corners; ++i)
        if (held.back().has(face.vertex[i])) common.add(face.vertex[i]);
      if (common.corners > 0 &&
          string.length(all, k) <= touching * size_of(all.cell(string.cells[k]))) {
        contacts.back().last = k;
        held.back() = common;
        continue;
      }
    }
    contacts.push_back({k, k, {}});
    held.push_back(face);
  }
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const CellCrossing& crossing = string.crossings[contacts[c].first];
    CellCrossing& point = contacts[c].held;
    point.face = held[c];
    double sum = 0;
    for (std::size_t i = 0; i < point.face.corners; ++i)
      for (std::size_t j = 0; j < crossing.face.corners; ++j)
        if (crossing.face.vertex[j] == point.face.vertex[i]) sum += point.at[i] = crossing.at[j];
    for (double& x : point.at) x /= sum;
  }
  return contacts;
}

// The string with what lies between two of its cells exchanged.
CellString spliced(const CellString& string, std::size_t first, std::size_t last,
                   const CellString& part) {
  CellString whole;
  whole.start = string.start, whole.end = string.end;
  const auto at = [](auto& v, std::size_t k) { return v.begin() + static_cast<std::ptrdiff_t>(k); };
  whole.cells.assign(string.cells.begin(), at(string.cells, first));
  whole.cells.insert(whole.cells.end(), part.cells.begin(), part.cells.end());
  whole.cells.insert(whole.cells.end(), at(string.cells, last + 2), string.cells.end());
  whole.crossings.assign(string.crossings.begin(), at(string.crossings, first));
  whole.crossings.insert(whole.crossings.end(), part.crossings.begin(), part.crossings.end());
  whole.crossings.insert(whole.crossings.end(), at(string.crossings, last + 1),
                         string.crossings.end());
  return whole;
}

// The part of a string around some of its crossings, from the crossing before to the one behind.
CellString part_of(const Cells& all, const CellString& string, std::size_t first,
                   std::size_t last) {
  CellString part;
  const auto at = [](auto& v, std::size_t k) { return v.begin() + static_cast<std::ptrdiff_t>(k); };
  part.cells.assign(at(string.cells, first), at(string.cells, last + 2));
  part.crossings.assign(at(string.crossings, first), at(string.crossings, last + 1));
  part.start = first == 0 ? string.start : string.place(all.cell(part.cells.front()), first - 1);
  part.end = last + 1 == string.crossings.size()
                 ? string.end
                 : string.place(all.cell(part.cells.back()), last + 1);
  return part;
}

// Around what holds the part's crossings. False if every way around is longer.
bool go_around(const Cells& all, const Contact& contact, CellString& part) {
  const double known = part.length(all);
  const auto shorter = [&](CellString& other) {
    pull_taut(all, other);
    return other.length(all) < known * (1 - worth);
  };
  const Index from = part.cells.front(), to = part.cells.back();
  if (from == to) {
    CellString straight = part;
    straight.cells = {from};
    straight.crossings.clear();
    if (straight.length(all) < known * (1 - worth)) {
      part = straight;
      return true;
    }
  }
  WaysAround around(all, contact.held);
  if (!around.any()) return false;
  constexpr int ways = 4;
  for (int k = 0; k < ways; ++k) {
    const WaysAround::Way way = around.find(from, part.start, to, part.end);
    if (way.cells.empty() || !around.may_gain(way.angle)) return false;
    CellString other;
    other.start = part.start, other.end = part.end;
    other.cells = way.cells;
    other.crossings = way.at;
    if (shorter(other)) {
      part = std::move(other);
      return true;
    }
  }
  return false;
}

// Between two cells, at a point that both have.
CellCrossing crossing_at(const Cells& all, const CellCrossing& point, Index one, Index other) {
  CellCrossing made{all.between(one, other, point.face), {}};
  for (std::size_t i = 0; i < made.face.corners; ++i)
    for (std::size_t j = 0; j < point.face.corners; ++j)
      if (point.face.vertex[j] == made.face.vertex[i]) made.at[i] = point.at[j];
  return made;
}

// By a fast cell at what holds the part: into it around that and out of it there, the other way
// round, or in and out there.
bool run_along(const Cells& all, const Contact& contact, CellString& part) {
  const double known = part.length(all);
  WaysAround around(all, contact.held);
  const Index from = part.cells.front(), to = part.cells.back();
  const auto crossing = [&](Index one, Index other) {
    return crossing_at(all, contact.held, one, other);
  };
  bool any = false;
  CellString best = part;
  double least = known * (1 - worth);
  for (const Index fast : around.fast()) {
    if (fast == from || fast == to) continue;
    std::array<double, 4> middle = {};
    const std::size_t corners = all.corners(fast).size();
    if (corners == 2) continue;
    for (std::size_t i = 0; i < corners; ++i) middle[i] = 1 / static_cast<double>(corners);
    const WaysAround::Way in = around.any_way(from, part.start, fast, middle);
    const WaysAround::Way out = around.any_way(fast, middle, to, part.end);
    for (int k = 0; k < 3; ++k) {
      CellString other;
      other.start = part.start, other.end = part.end;
      if (k == 1 && !in.cells.empty()) {
        other.cells = in.cells, other.crossings = in.at;
      } else {
        other.cells = {from, fast};
        other.crossings = {crossing(from, fast)};
      }
      if (k == 2 && !out.cells.empty()) {
        other.cells.insert(other.cells.end(), out.cells.begin() + 1, out.cells.end());
        other.crossings.insert(other.crossings.end(), out.at.begin(), out.at.end());
      } else {
        other.cells.push_back(to);
        other.crossings.push_back(crossing(fast, to));
      }
      pull_taut(all, other);
      if (const double length = other.length(all); length < least)
        least = length, best = std::move(other), any = true;
    }
  }
  if (any) part = std::move(best);
  return any;
}

// From the start along a fast cell beside the first.
bool run_off(const Cells& all, CellString& string) {
  const Cell first = all.cell(string.cells[0]);
  CellCrossing start;
  for (std::size_t i = 0; i < first.corners; ++i)
    if (string.start[i] > 0 && start.face.corners < 3) start.face.add(first.vertex[i]);
  double sum = 0;
  for (std::size_t i = 0; i < first.corners; ++i)
    for (std::size_t j = 0; j < start.face.corners; ++j)
      if (start.face.vertex[j] == first.vertex[i]) sum += start.at[j] = string.start[i];
  if (first.corners == 2 || sum < 1 - 1e-9) return false;  // inside of a tetrahedron
  const bool alone = string.crossings.empty();
  const std::array<double, 4> end = alone ? string.end : string.place(first, 0);
  const double least = string.length(all, 0) - worth * string.length(all);
  WaysAround around(all, start);
  for (const Index fast : around.fast()) {
    const std::size_t corners = all.corners(fast).size();
    if (fast == string.cells[0] || corners == 2) continue;
    const Cell cell = all.cell(fast);
    std::array<double, 4> middle = {}, there = {};
    for (std::size_t i = 0; i < corners; ++i) middle[i] = 1 / static_cast<double>(corners);
    for (std::size_t j = 0; j < start.face.corners; ++j)
      there[cell.corner(start.face.vertex[j])] = start.at[j];
    const WaysAround::Way way = around.any_way(fast, middle, string.cells[0], end);
    for (const bool direct : {true, false}) {
      CellString part{way.cells, there, end, way.at};
      if (direct) {
        part.cells = {fast, string.cells[0]};
        part.crossings = {crossing_at(all, start, fast, string.cells[0])};
      }
      if (part.cells.empty()) continue;
      pull_taut(all, part);
      if (!(part.length(all) < least)) continue;
      part.cells.insert(part.cells.end(), string.cells.begin() + 1, string.cells.end());
      part.crossings.insert(part.crossings.end(), string.crossings.begin(), string.crossings.end());
      part.end = string.end;
      string = std::move(part);
      return true;
    }
  }
  return false;
}

// The way back.
void turn(CellString& string) {
  std::reverse(string.cells.begin(), string.cells.end());
  std::reverse(string.crossings.begin(), string.crossings.end());
  std::swap(string.start, string.end);
}

// At the ends: a cell that the way only touches is left out.
void trim(const Cells& all, CellString& string) {
  const auto moved = [&](const Cell& from, const std::array<double, 4>& at, const Cell& to,
                         std::array<double, 4>& there) {
    there = {};
    for (std::size_t i = 0; i < from.corners; ++i) {
      if (at[i] == 0) continue;
      const std::size_t j = to.corner(from.vertex[i]);
      if (j == to.corners) return false;
      there[j] = at[i];
    }
    return true;
  };
  std::array<double, 4> there;
  while (!string.crossings.empty() && string.length(all, 0) == 0 &&
         moved(all.cell(string.cells[0]), string.start, all.cell(string.cells[1]), there)) {
    string.cells.erase(string.cells.begin());
    string.crossings.erase(string.crossings.begin());
    string.start = there;
  }
  while (!string.crossings.empty() && string.length(all, string.cells.size() - 1) == 0 &&
         moved(all.cell(string.cells.back()), string.end,
               all.cell(string.cells[string.cells.size() - 2]), there)) {
    string.cells.pop_back();
    string.crossings.pop_back();
    string.end = there;
  }
}

// Triangles at a face that the way crosses but does not enter: it may gain by running along.
void add_sheets(const Cells& all, CellString& string) {
  CellString wider;
  wider.start = string.start, wider.end = string.end;
  wider.cells = {string.cells[0]};
  std::vector<Index> around;
  for (std::size_t k = 0; k < string.crossings.size(); ++k) {
    const CellCrossing& crossing = string.crossings[k];
    const Index one = string.cells[k], other = string.cells[k + 1];
    wider.crossings.push_back(crossing);
    if (crossing.face.corners > 1) {
      all.around(crossing.face, around);
      for (const Index s : around) {
        const bool flat = all.corners(s).size() == 3;
        const bool fits = crossing.face.corners == 3 ||
                          (all.corners(one).size() == 3 && all.corners(other).size() == 3);
        if (!flat || !fits || s == one || s == other) continue;
        wider.cells.push_back(s);
        wider.crossings.push_back(crossing);
      }
    }
    wider.cells.push_back(other);
  }
  string = std::move(wider);
}

}  // namespace

bool improve(const Cells& all, CellString& string) {
  const double before = string.length(all);
  trim(all, string);
  bool any = false;
  // From the last to the first, so that places before stay what they are.
  const std::vector<Contact> contacts = contacts_of(all, string);
  for (std::size_t c = contacts.size(); c-- > 0;) {
    const Contact& contact = contacts[c];
    if (contact.held.face.corners > 2) continue;  // nothing holds it there
    CellString part = part_of(all, string, contact.first, contact.last);
    if (!go_around(all, contact, part) && !run_along(all, contact, part)) continue;
    string = spliced(string, contact.first, contact.last, part);
    any = true;
  }
  for (int end = 0; end < 2; ++end) {
    any |= run_off(all, string);
    turn(string);
  }
  CellString wider = string;
  add_sheets(all, wider);
  pull_taut(all, wider);
  const double after = wider.length(all);
  if (!any && !(after < before * (1 - worth))) return false;
  string = std::move(wider);
  return string.length(all) < before * (1 - worth);
}

}  // namespace plexway
