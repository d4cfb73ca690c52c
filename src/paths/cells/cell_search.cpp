#include "paths/cells/cells.hpp"

#include <algorithm>
#include <cmath>
#include <queue>
#include <utility>

#include "complexes/common/number_range.hpp"

namespace plexway::detail {
namespace {

double apart(const Point3& a, const Point3& b) {
  const Point3 d = minus(a, b);
  return std::sqrt(dot(d, d));
}

// So many points an edge, evenly; those inside a triangle are as far apart.
FacePlaces even_places(std::size_t corners, std::size_t places) {
  FacePlaces found;
  const std::size_t n = places + 1;
  const auto step = 1 / static_cast<double>(n);
  const auto share = [&](std::size_t i) { return static_cast<double>(i) * step; };
  for (std::size_t i = 1; i < n; ++i) {
    if (corners == 2) found.push_back({1 - share(i), share(i), 0});
    for (std::size_t j = 1; corners == 3 && i + j < n; ++j)
      found.push_back({1 - share(i + j), share(i), share(j)});
  }
  return found;
}

class Search {
 public:
  // In all cells, or in a corridor.
  Search(const Cells& all, std::span<const double> distance, std::span<const CellGoal> goals,
         std::size_t places, const Corridor* corridor = nullptr)
      : all_(all),
        distance_(distance),
        goals_(goals),
        even_{FacePlaces{{1, 0, 0}}, even_places(2, places), even_places(3, places)},
        corridor_(corridor) {
    for (std::size_t n = 0; n < goals.size(); ++n) {
      const CellPoint& at = goals[n].point;
      if (at.vertex != none)
        goals_at_vertex_[at.vertex].push_back(n);
      else
        goals_in_cell_[at.cell].push_back(n);
    }
  }

  std::optional<CellWay> find(const CellPoint& start) {
    if (start.vertex != none) {
      CellFace face;
      face.add(start.vertex);
      if (const Face& found = open_face(face); found.count > 0) offer(found.first, 0, none, none);
    } else {
      expand(none, 0, start.cell, place_in(all_.cell(start.cell), start.at));
    }
    while (!queue_.empty()) {
      const auto [length, number] = queue_.top();
      if (!(length < best_)) break;
      queue_.pop();
      const Node node = nodes_[number];
      if (length > node.before + node.left) continue;  // there is a shorter one
      const Face& face = *node.face;
      if (face.face.corners == 1)
        if (const auto at = goals_at_vertex_.find(face.face.vertex[0]);
            at != goals_at_vertex_.end())
          for (const std::size_t n : at->second) finish(n, number, none, node.before);
      const std::vector<Index> cells = face.cells;
      for (const Index c : cells) expand(number, node.before, c, {});
    }
    if (!(best_ < infinity)) return std::nullopt;
    return way_from(start);
  }

 private:
  struct Face {
    CellFace face;
    Index first = none, count = 0;  // of its nodes
    std::vector<Index> cells;
  };
  struct Node {
    const Face* face;
    std::array<double, 3> at;  // coordinates on the face
    double before = infinity, left = 0;
    Index from = none, by = none;  // node and cell; none: from the start
  };
  struct CellNodes {
    Cell cell;
    std::vector<std::pair<Index, Point3>> nodes;
  };

  // A face's nodes, made when it is met first.
  Face& open_face(const CellFace& key) {
    const auto [it, is_new] = faces_.try_emplace(key);
    Face& face = it->second;
    if (!is_new) return face;
    face.face = key;
    all_.around(key, face.cells);
    if (corridor_ != nullptr)
      std::erase_if(face.cells, [&](Index c) { return !corridor_->cells.contains(c); });
    face.first = static_cast<Index>(nodes_.size());
    const auto add = [&](const std::array<double, 3>& at) {
      nodes_.push_back({.face = &face, .at = at, .left = least_left(face, at)});
      ++face.count;
    };
    if (key.corners == 1 || face.cells.size() > 1)  // else nothing leads over it
      for (const auto& at : places_on(key)) add(at);
    return face;
  }

  [[nodiscard]] const FacePlaces& places_on(const CellFace& key) const {
    static const FacePlaces nowhere;
    if (corridor_ == nullptr) return even_[key.corners - 1];
    const auto found = corridor_->places.find(key);
    return found == corridor_->places.end() ? nowhere : found->second;
  }

  // By the triangle inequality from the corners of one cell that has the face.
  double least_left(const Face& face, const std::array<double, 3>& at) const {
    if (corridor_ != nullptr) return 0;
    if (face.face.corners == 1) return distance_[face.face.vertex[0]];
    const Cell cell = all_.cell(face.cells[0]);
    std::array<double, 4> in_cell = {};
    for (std::size_t i = 0; i < face.face.corners; ++i)
      in_cell[cell.corner(face.face.vertex[i])] = at[i];
    const Point3 p = place_in(cell, in_cell);
    double least = 0;
    for (std::size_t i = 0; i < cell.corners; ++i) {
      const double d = distance_[cell.vertex[i]];
      if (d < infinity) least = std::max(least, d - apart(p, cell.place[i]));
    }
    return least;
  }

  const CellNodes& open_cell(Index number) {
    const auto [it, is_new] = cells_.try_emplace(number);
    CellNodes& own = it->second;
    if (!is_new) return own;
    own.cell = all_.cell(number);
    const std::size_t corners = own.cell.corners;
    const std::size_t most = corners == 2 ? 1 : 3;  // wires meet others at vertices
    for (unsigned set = 1; set < (1u << corners); ++set) {
      CellFace key;
      std::size_t size = 0;
      for (std::size_t i = 0; i < corners; ++i) size += set >> i & 1;
      if (size > most) continue;
      bool twice = false;  // a loop
      for (std::size_t i = 0; i < corners; ++i) {
        if (!(set >> i & 1)) continue;
        twice = twice || key.has(own.cell.vertex[i]);
        key.add(own.cell.vertex[i]);
      }
      if (twice) continue;
      const Face& face = open_face(key);
      for (Index n = face.first; n < face.first + face.count; ++n) {
        std::array<double, 4> at = {};
        for (std::size_t i = 0; i < corners; ++i)
          for (std::size_t k = 0; k < key.corners; ++k)
            if ((set >> i & 1) && key.vertex[k] == own.cell.vertex[i]) at[i] = nodes_[n].at[k];
        own.nodes.emplace_back(n, place_in(own.cell, at));
      }
    }
    return own;
  }

  // From a node, or from a point of the cell, to all others of the cell.
  void expand(Index from, double before, Index cell, const Point3& point) {
    const CellNodes& own = open_cell(cell);
    if (from == none) {
      leave(own, none, before, cell, point);
      return;
    }
    for (const auto& [n, p] : own.nodes)
      if (n == from) leave(own, from, before, cell, p);
  }
  void leave(const CellNodes& own, Index from, double before, Index cell, const Point3& p) {
    for (const auto& [n, q] : own.nodes)
      if (n != from) offer(n, before + apart(p, q), from, cell);
    if (const auto in = goals_in_cell_.find(cell); in != goals_in_cell_.end())
      for (const std::size_t n : in->second)
        finish(n, from, cell, before + apart(p, place_in(own.cell, goals_[n].point.at)));
  }

  void offer(Index number, double before, Index from, Index by) {
    Node& node = nodes_[number];
    if (!(before < node.before) || !(node.left < infinity)) return;
    node.before = before, node.from = from, node.by = by;
    if (before + node.left < best_) queue_.emplace(before + node.left, number);
  }
  void finish(std::size_t goal, Index from, Index by, double length) {
    length += goals_[goal].offset;
    if (!(length < best_)) return;
    best_ = length, goal_ = goal, last_ = from, last_cell_ = by;
  }

  [[nodiscard]] std::optional<CellWay> way_from(const CellPoint& start) const {
    CellWay way;
    way.goal = goal_;
    // Back from the goal: nodes, and the cell behind each.
    std::vector<Index> nodes, cells;
    if (last_cell_ != none) cells.push_back(last_cell_);
    for (Index n = last_; n != none; n = nodes_[n].from) {
      nodes.push_back(n);
      if (nodes_[n].by != none) cells.push_back(nodes_[n].by);
    }
    std::reverse(nodes.begin(), nodes.end());
    std::reverse(cells.begin(), cells.end());
    if (start.vertex != none) nodes.erase(nodes.begin());
    CellString& string = way.string;
    if (cells.empty()) {  // there already
      string.cells = {all_.around(start.vertex)[0]};
      string.start = corner(string.cells[0], start.vertex);
      string.end = string.start;
      return way;
    }
    const CellPoint& goal = goals_[goal_].point;
    if (goal.vertex != none) nodes.pop_back();
    string.start = start.vertex != none ? corner(cells[0], start.vertex) : start.at;
    string.end = goal.vertex != none ? corner(cells.back(), goal.vertex) : goal.at;
    string.cells = {cells[0]};
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      if (cells[k + 1] == string.cells.back()) continue;
      const Node& node = nodes_[nodes[k]];
      CellCrossing crossing{all_.between(cells[k], cells[k + 1], node.face->face), {}};
      for (std::size_t i = 0; i < crossing.face.corners; ++i)
        for (std::size_t j = 0; j < node.face->face.corners; ++j)
          if (crossing.face.vertex[i] == node.face->face.vertex[j]) crossing.at[i] = node.at[j];
      string.crossings.push_back(crossing);
      string.cells.push_back(cells[k + 1]);
    }
    return way;
  }
  [[nodiscard]] std::array<double, 4> corner(Index cell, Index vertex) const {
    std::array<double, 4> at = {};
    at[all_.cell(cell).corner(vertex)] = 1;
    return at;
  }

  const Cells& all_;
  std::span<const double> distance_;
  std::span<const CellGoal> goals_;
  std::array<FacePlaces, 3> even_;  // of vertices, edges, triangles
  const Corridor* corridor_;
  std::unordered_map<Index, std::vector<std::size_t>> goals_at_vertex_, goals_in_cell_;
  std::unordered_map<CellFace, Face, Corridor::Hash> faces_;  // whose elements stay where they are
  std::unordered_map<Index, CellNodes> cells_;
  std::vector<Node> nodes_;
  std::priority_queue<std::pair<double, Index>, std::vector<std::pair<double, Index>>,
                      std::greater<>>
      queue_;
  double best_ = infinity;
  std::size_t goal_ = 0;
  Index last_ = none, last_cell_ = none;
};

}  // namespace

std::optional<CellWay> search_cells(const Cells& all, std::span<const double> distance,
                                    std::span<const CellGoal> goals, const CellPoint& start,
                                    std::size_t places) {
  return Search(all, distance, goals, places).find(start);
}

std::optional<CellWay> search_cells(const Cells& all, const Corridor& corridor,
                                    std::span<const CellGoal> goals, const CellPoint& start) {
  return Search(all, {}, goals, 0, &corridor).find(start);
}

}  // namespace plexway::detail
