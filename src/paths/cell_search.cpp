#include "paths/cell_search.hpp"

#include <algorithm>
#include <cmath>
#include <queue>
#include <unordered_map>
#include <utility>

#include "paths/infinity.hpp"

namespace plexway {
namespace {

double apart(const Point3& a, const Point3& b) {
  const Point3 d = minus(a, b);
  return std::sqrt(dot(d, d));
}

struct FaceHash {
  std::size_t operator()(const CellFace& face) const {
    std::uint64_t h = face.corners;
    for (const Index v : face.vertex) h = (h ^ v) * 0x9e3779b97f4a7c15ull, h ^= h >> 29;
    return static_cast<std::size_t>(h);
  }
};

class Search {
 public:
  Search(const Cells& all, std::span<const double> distance, std::span<const CellGoal> goals,
         std::size_t places)
      : all_(all), distance_(distance), goals_(goals), places_(places) {
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
      const auto& found = open_face(face, none);
      offer(found.first, 0, none, none);
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
  Face& open_face(const CellFace& key, Index) {
    const auto [it, is_new] = faces_.try_emplace(key);
    Face& face = it->second;
    if (!is_new) return face;
    face.face = key;
    all_.around(key, face.cells);
    face.first = static_cast<Index>(nodes_.size());
    const auto add = [&](const std::array<double, 3>& at) {
      Node node;
      node.face = &face;
      node.at = at;
      node.left = least_left(face, at);
      nodes_.push_back(node);
      ++face.count;
    };
    if (key.corners == 1) {
      add({1, 0, 0});
    } else if (face.cells.size() > 1) {  // else nothing leads over it
      const auto step = 1 / static_cast<double>(places_ + 1);
      if (key.corners == 2) {
        for (std::size_t i = 1; i <= places_; ++i) {
          const double s = static_cast<double>(i) * step;
          add({1 - s, s, 0});
        }
      } else {
        const std::size_t n = places_ + 1;
        for (std::size_t i = 1; i < n; ++i)
          for (std::size_t j = 1; i + j < n; ++j)
            add({1 - static_cast<double>(i + j) * step, static_cast<double>(i) * step,
                 static_cast<double>(j) * step});
        if (n == 2) add({1. / 3, 1. / 3, 1. / 3});
      }
    }
    return face;
  }

  // By the triangle inequality from the corners of one cell that has the face.
  double least_left(const Face& face, const std::array<double, 3>& at) const {
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
      const Face& face = open_face(key, number);
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
  std::size_t places_;
  std::unordered_map<Index, std::vector<std::size_t>> goals_at_vertex_, goals_in_cell_;
  std::unordered_map<CellFace, Face, FaceHash> faces_;  // whose elements stay where they are
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

}  // namespace plexway
