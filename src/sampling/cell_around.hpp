#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "paths/cell_string.hpp"

namespace plexway {

/// Ways around a vertex or an edge: from one direction to another through the cells there, as seen
/// from a point of it. The shortest is that of the least angle; where cells measure what they share
/// differently, angles count as much as these are slower. Along an edge they are those of what is
/// left across it.
class WaysAround {
 public:
  /// `point`: of crossing `held`, whose face is exactly what is gone around.
  WaysAround(const Cells& all, const CellCrossing& held) : all_(all), held_(held) {
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
      double least = unknown;
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
    double angle = unknown;
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
    return angle < (one_speed_ ? std::numbers::pi + coarse : unknown);
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
  static constexpr double unknown = std::numeric_limits<double>::infinity();

  [[nodiscard]] Way shortest(Index from, const std::array<double, 4>& start, Index to,
                             const std::array<double, 4>& end) {
    Way way;
    const std::size_t first = place_of(from), last = place_of(to);
    if (first == cells_.size() || last == cells_.size()) return way;
    const std::size_t n = directions_.size();
    std::vector<double> angle(n, unknown);
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
        if (!done[d] && angle[d] < unknown && (next == n || angle[d] < angle[next])) next = d;
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
  static double norm(const Point3& a) { return std::sqrt(dot(a, a)); }
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

}  // namespace plexway
