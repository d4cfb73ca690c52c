#include "apps/cell_detours.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

namespace plexway {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double touching = 1e-5;  // coordinates, and lengths as a share of a cell
constexpr double worth = 1e-10;    // what a change must gain, of the length

double norm(const Point3& a) { return std::sqrt(dot(a, a)); }

// The vertices that a crossing's point has coordinates of.
CellFace held_by(const CellCrossing& crossing) {
  CellFace face;
  for (std::size_t i = 0; i < crossing.face.corners; ++i)
    if (crossing.at[i] > touching) face.add(crossing.face.vertex[i]);
  return face;
}

/// Ways around a vertex or an edge: from one direction to another through the cells there, as seen
/// from a point of it. The shortest is that of the least angle; where cells measure what they share
/// differently, angles count as much as these are slower. Along an edge they are those of what is
/// left across it.
class Around {
 public:
  /// `point`: of crossing `held`, whose face is exactly what is gone around.
  Around(const Cells& all, const CellCrossing& held) : all_(all), held_(held) {
    all.around(held.face, numbers_);
    for (const Index s : numbers_) {
      cells_.push_back(all.cell(s));
      const Cell& cell = cells_.back();
      // Directions: to other vertices, and, around a vertex of a tetrahedron, into the faces.
      for (std::size_t i = 0; i < cell.corners; ++i) {
        if (held.face.has(cell.vertex[i])) continue;
        CellFace one;
        one.add(cell.vertex[i]);
        open(one, {1, 0, 0});
        if (cell.corners < 4 || held.face.corners > 1) continue;
        for (std::size_t j = i + 1; j < cell.corners; ++j) {
          if (held.face.has(cell.vertex[j])) continue;
          CellFace two = one;
          two.add(cell.vertex[j]);
          constexpr int parts = 4;
          for (int k = 1; k < parts; ++k) open(two, {1 - k / double(parts), k / double(parts), 0});
        }
      }
    }
    slowness_.assign(cells_.size(), 1);
    for (std::size_t d = 0; d < directions_.size(); ++d) {
      double least = infinity;
      for (std::size_t c = 0; c < cells_.size(); ++c)
        if (in(d, c)) least = std::min(least, norm(direction(d, c)));
      for (std::size_t c = 0; least > 0 && c < cells_.size(); ++c)
        if (in(d, c)) slowness_[c] = std::max(slowness_[c], norm(direction(d, c)) / least);
    }
    one_speed_ = *std::max_element(slowness_.begin(), slowness_.end()) < 1 + 1e-6;
  }

  /// More cells than a way straight over an edge passes.
  [[nodiscard]] bool any() const { return cells_.size() > 2; }

  struct Way {
    std::vector<Index> cells;      // from the first to the last
    std::vector<CellCrossing> at;  // between them
    double angle = infinity;
  };
  /// Cells that may pay where they are run along: faster than others at the same place.
  [[nodiscard]] std::vector<Index> fast() const {
    std::vector<Index> found;
    for (std::size_t c = 0; !one_speed_ && c < cells_.size(); ++c)
      if (slowness_[c] < 1 + 1e-6) found.push_back(numbers_[c]);
    return found;
  }
  /// Could a way of that angle be shorter than straight to the point and on from there?
  [[nodiscard]] bool may_gain(double angle) const {
    constexpr double coarse = 0.35;  // so much longer is a way over few directions
    return angle < (one_speed_ ? std::numbers::pi + coarse : infinity);
  }

  /// From a point of cell `from` to one of cell `to`. Cells and directions that it passes are left
  /// out by the next one.
  [[nodiscard]] Way find(Index from, const std::array<double, 4>& start, Index to,
                         const std::array<double, 4>& end) {
    Way way = shortest(from, start, to, end);
    for (std::size_t k = 1; k + 1 < way.cells.size(); ++k)
      avoided_cells_[place_of(way.cells[k])] = 1;
    if (way.cells.size() == 2)
      for (std::size_t d = 0; d < directions_.size(); ++d)
        if (in(d, place_of(from)) && in(d, place_of(to))) avoided_[d] = 1;
    return way;
  }
  /// The same, whatever was left out or is by the next one.
  [[nodiscard]] Way any_way(Index from, const std::array<double, 4>& start, Index to,
                            const std::array<double, 4>& end) {
    avoided_cells_.assign(cells_.size(), 0);
    avoided_.assign(directions_.size(), 0);
    return shortest(from, start, to, end);
  }

 private:
  [[nodiscard]] Way shortest(Index from, const std::array<double, 4>& start, Index to,
                             const std::array<double, 4>& end) {
    Way way;
    const std::size_t first = place_of(from), last = place_of(to);
    if (first == cells_.size() || last == cells_.size()) return way;
    const std::size_t n = directions_.size();
    std::vector<double> angle(n, infinity);
    std::vector<std::size_t> before(n, n), by(n, 0);
    std::vector<char> done(n, 0);
    avoided_cells_.resize(cells_.size());
    avoided_.resize(n);
    const auto relax = [&](std::size_t c, const Point3& u, double so_far, std::size_t origin) {
      if (avoided_cells_[c]) return;
      for (std::size_t d = 0; d < n; ++d) {
        if (done[d] || !in(d, c) || avoided_[d]) continue;
        const double there = so_far + slowness_[c] * angle_between(u, direction(d, c));
        if (there < angle[d]) angle[d] = there, before[d] = origin, by[d] = c;
      }
    };
    relax(first, seen(first, start), 0, n);
    const Point3 aim = seen(last, end);
    std::size_t best = n;
    for (;;) {
      std::size_t next = n;
      for (std::size_t d = 0; d < n; ++d)
        if (!done[d] && angle[d] < infinity && (next == n || angle[d] < angle[next])) next = d;
      if (next == n || angle[next] >= way.angle) break;
      done[next] = 1;
      if (in(next, last)) {
        const double whole =
            angle[next] + slowness_[last] * angle_between(direction(next, last), aim);
        if (whole < way.angle) way.angle = whole, best = next;
      }
      for (std::size_t c = 0; c < cells_.size(); ++c)
        if (in(next, c)) relax(c, direction(next, c), angle[next], next);
    }
    if (best == n) return way;
    std::vector<std::size_t> passed;
    for (std::size_t d = best; d != n; d = before[d]) passed.push_back(d);
    std::reverse(passed.begin(), passed.end());
    way.cells = {from};
    for (std::size_t k = 0; k < passed.size(); ++k) {
      const std::size_t behind = k + 1 < passed.size() ? by[passed[k + 1]] : last;
      const Index next = numbers_[behind];
      if (next == way.cells.back()) continue;
      way.at.push_back(crossing(way.cells.back(), next, directions_[passed[k]]));
      way.cells.push_back(next);
    }
    return way;
  }

  struct Direction {
    CellFace towards;
    std::array<double, 3> at;
  };

  void open(const CellFace& towards, const std::array<double, 3>& at) {
    for (const Direction& d : directions_)
      if (d.towards == towards && d.at == at) return;
    directions_.push_back({towards, at});
  }
  [[nodiscard]] std::size_t place_of(Index number) const {
    return static_cast<std::size_t>(std::find(numbers_.begin(), numbers_.end(), number) -
                                    numbers_.begin());
  }
  [[nodiscard]] bool in(std::size_t d, std::size_t c) const {
    const Direction& direction = directions_[d];
    const Cell& cell = cells_[c];
    if (cell.corners == 2) return false;
    for (std::size_t i = 0; i < direction.towards.corners; ++i)
      if (cell.corner(direction.towards.vertex[i]) == cell.corners) return false;
    return true;
  }
  [[nodiscard]] Point3 origin(const Cell& cell) const {
    Point3 p = {0, 0, 0};
    for (std::size_t i = 0; i < held_.face.corners; ++i)
      for (std::size_t k = 0; k < 3; ++k)
        p[k] += held_.at[i] * cell.place[cell.corner(held_.face.vertex[i])][k];
    return p;
  }
  // Across the edge, if it is one.
  [[nodiscard]] Point3 across(const Cell& cell, Point3 u) const {
    if (held_.face.corners < 2) return u;
    const Point3 along = minus(cell.place[cell.corner(held_.face.vertex[1])],
                               cell.place[cell.corner(held_.face.vertex[0])]);
    const double square = dot(along, along);
    if (!(square > 0)) return u;
    const double part = dot(u, along) / square;
    for (std::size_t k = 0; k < 3; ++k) u[k] -= part * along[k];
    return u;
  }
  [[nodiscard]] Point3 seen(std::size_t c, const std::array<double, 4>& at) const {
    return across(cells_[c], minus(place_in(cells_[c], at), origin(cells_[c])));
  }
  [[nodiscard]] Point3 direction(std::size_t d, std::size_t c) const {
    std::array<double, 4> at = {};
    const Direction& direction = directions_[d];
    for (std::size_t i = 0; i < direction.towards.corners; ++i)
      at[cells_[c].corner(direction.towards.vertex[i])] = direction.at[i];
    return seen(c, at);
  }
  static double angle_between(const Point3& a, const Point3& b) {
    return std::atan2(norm(cross(a, b)), dot(a, b));
  }

  // A point of the face between two cells, a little in the direction.
  [[nodiscard]] CellCrossing crossing(Index one, Index other, const Direction& towards) const {
    constexpr double part = 0.2;
    CellFace all = held_.face;
    for (std::size_t i = 0; i < towards.towards.corners; ++i) all.add(towards.towards.vertex[i]);
    CellCrossing made{all_.between(one, other, all), {}};
    for (std::size_t i = 0; i < made.face.corners; ++i) {
      const Index v = made.face.vertex[i];
      for (std::size_t k = 0; k < held_.face.corners; ++k)
        if (held_.face.vertex[k] == v) made.at[i] = (1 - part) * held_.at[k];
      for (std::size_t k = 0; k < towards.towards.corners; ++k)
        if (towards.towards.vertex[k] == v) made.at[i] = part * towards.at[k];
    }
    return made;
  }

  const Cells& all_;
  const CellCrossing held_;
  std::vector<Index> numbers_;
  std::vector<Cell> cells_;
  std::vector<Direction> directions_;
  std::vector<double> slowness_;  // of cells, against the fastest beside
  bool one_speed_ = true;
  std::vector<char> avoided_cells_, avoided_;
};

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
  Around around(all, contact.held);
  if (!around.any()) return false;
  constexpr int ways = 4;
  for (int k = 0; k < ways; ++k) {
    const Around::Way way = around.find(from, part.start, to, part.end);
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
  Around around(all, contact.held);
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
    const Around::Way in = around.any_way(from, part.start, fast, middle);
    const Around::Way out = around.any_way(fast, middle, to, part.end);
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
  Around around(all, start);
  for (const Index fast : around.fast()) {
    const std::size_t corners = all.corners(fast).size();
    if (fast == string.cells[0] || corners == 2) continue;
    const Cell cell = all.cell(fast);
    std::array<double, 4> middle = {}, there = {};
    for (std::size_t i = 0; i < corners; ++i) middle[i] = 1 / static_cast<double>(corners);
    for (std::size_t j = 0; j < start.face.corners; ++j)
      there[cell.corner(start.face.vertex[j])] = start.at[j];
    const Around::Way way = around.any_way(fast, middle, string.cells[0], end);
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
