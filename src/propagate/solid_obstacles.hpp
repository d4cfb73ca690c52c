#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include <plexway/complex/tet_mesh.hpp>

#include "complex/box_tree.hpp"

namespace plexway {

/// What lines in a solid can run into: the faces of its boundary that have some of the solid behind
/// them, in parts that hang together. Where a plane has all of a part on one side, no line between
/// two points on its other side meets that part. So for a reflex edge with such planes, those of its
/// two faces, it is known without a walk that its own part is not in the way of a line from it.
///
/// Empty where no reflex edge has such a plane: for lengths alone, in convex solids, and where the
/// boundary is one part with dents and bumps. Cost: n log n in vertices of the boundary, about 30 ns
/// a tetrahedron; memory: of parts and reflex edges.
template <class Real>
class SolidObstacles {
 public:
  using Point = Vector3<Real>;

  [[nodiscard]] bool empty() const { return sides_.empty(); }
  [[nodiscard]] std::uint64_t identity() const { return identity_; }

  /// Of another solid, in the memory that there is.
  void measure(const TetMesh<Real>& mesh);

  /// Does the line between a point of reflex edge `number`, which is `edge`, and another point of
  /// the solid, or of the boundary, surely meet no face of the boundary? False: it may.
  [[nodiscard]] bool clear(Index number, const ReflexEdge<Real>& edge, const Point& at,
                           const Point& other) const {
    const Index sides = sides_[number];
    if ((sides & both) == 0) return false;
    const Point off = other - edge.end[0];
    const bool before = ((sides & 1) != 0 && dot(edge.normal[0], off) >= -on_plane) ||
                        ((sides & 2) != 0 && dot(edge.normal[1], off) >= -on_plane);
    return before && (boxes_.size() == 1 || passes_others(sides >> part_shift, at, other));
  }

 private:
  using Tree = BoxTree<3>;
  static constexpr Index both = 3;  // flags of an edge's two faces, below the number of its part
  static constexpr int part_shift = 2;
  /// In mean edges, far below what lines are walked beside edges: what is no farther in front of a
  /// plane lies in it.
  static constexpr Real on_plane = Real(1e-5);

  static std::array<double, 3> place(const Point& p) {
    return {static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)};
  }
  /// A tree of points; `at` are the numbers of those in it.
  static Tree tree_of(std::span<const Point> points, std::span<const Index> at);
  static bool behind(const Tree& tree, std::span<const Point> points, std::span<const Index> at,
                     const Point& normal, const Point& on);
  [[nodiscard]] bool passes_others(Index own, const Point& p, const Point& q) const;

  Index part_of(Index vertex) {
    while (parent_[vertex] != vertex) vertex = parent_[vertex] = parent_[parent_[vertex]];
    return vertex;
  }

  std::uint64_t identity_ = 0;
  std::vector<Index> sides_;    // by reflex edge
  std::vector<Box<3>> boxes_;   // by part
  Tree tree_;                   // of them
  std::vector<Index> parent_;   // of vertices: while it is made
};

template <class Real>
BoxTree<3> SolidObstacles<Real>::tree_of(std::span<const Point> points,
                                         std::span<const Index> at) {
  std::vector<Box<3>> boxes;
  boxes.reserve(at.size());
  for (const Index v : at) boxes.push_back({place(points[v]), place(points[v])});
  return Tree(boxes);
}

// Is none of the points in front of a plane?
template <class Real>
bool SolidObstacles<Real>::behind(const Tree& tree, std::span<const Point> points,
                                  std::span<const Index> at, const Point& normal,
                                  const Point& on) {
  const auto n = place(normal);
  const double most = static_cast<double>(dot(normal, on) + on_plane);
  bool all = true;
  tree.search(
      [&](const Box<3>& box) {
        double farthest = 0;
        for (std::size_t d = 0; d < 3; ++d)
          farthest += n[d] * (n[d] > 0 ? box.high[d] : box.low[d]);
        return all && farthest > most;
      },
      [&](Index i) { all = all && !(dot(normal, points[at[i]] - on) > on_plane); });
  return all;
}

template <class Real>
void SolidObstacles<Real>::measure(const TetMesh<Real>& mesh) {
  constexpr Index corners[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};  // from outside
  identity_ = mesh.identity();
  sides_.clear();
  boxes_.clear();
  if (!mesh.embedded() || mesh.reflex_edges().empty()) return;
  const std::span<const Point> points = mesh.points();
  const std::span<const TetRecord<Real>> tets = mesh.tets();
  const Index sentinel = static_cast<Index>(mesh.tet_count());

  std::vector<std::array<Index, 3>> faces;
  for (Index t = 0; t < sentinel; ++t)
    for (std::size_t i = 0; i < 4; ++i)
      if (tets[t].across[i] >> TetAcross::tet_shift == sentinel)
        faces.push_back({tets[t].corner[corners[i][0]], tets[t].corner[corners[i][1]],
                         tets[t].corner[corners[i][2]]});
  std::vector<Index> rim;  // vertices of the boundary
  for (const auto& face : faces) rim.insert(rim.end(), face.begin(), face.end());
  std::sort(rim.begin(), rim.end());
  rim.erase(std::unique(rim.begin(), rim.end()), rim.end());
  const Tree all = tree_of(points, rim);

  parent_.resize(points.size());
  std::iota(parent_.begin(), parent_.end(), Index{0});
  std::vector<Index> met;  // vertices of faces that lines can run into
  for (const auto& [a, b, c] : faces) {
    const Point across = cross(points[b] - points[a], points[c] - points[a]);
    const Real size = norm(across);
    if (size > 0 && behind(all, points, rim, Real(1) / size * across, points[a])) continue;
    parent_[part_of(b)] = part_of(a);
    parent_[part_of(c)] = part_of(a);
    met.insert(met.end(), {a, b, c});
  }
  std::sort(met.begin(), met.end());
  met.erase(std::unique(met.begin(), met.end()), met.end());
  for (const Index v : met) parent_[v] = part_of(v);
  std::sort(met.begin(), met.end(), [&](Index v, Index w) {
    return parent_[v] != parent_[w] ? parent_[v] < parent_[w] : v < w;
  });

  std::vector<Tree> trees;
  std::vector<std::span<const Index>> of_part;
  for (std::size_t begin = 0, end = 0; begin < met.size(); begin = end) {
    const Index root = parent_[met[begin]];
    Box<3> box = Box<3>::empty();
    for (; end < met.size() && parent_[met[end]] == root; ++end) box.add(place(points[met[end]]));
    of_part.push_back(std::span<const Index>(met).subspan(begin, end - begin));
    trees.push_back(tree_of(points, of_part.back()));
    box.widen(10 * static_cast<double>(on_plane));
    boxes_.push_back(box);
  }
  std::vector<Index> number(points.size(), none);
  for (Index part = 0; part < of_part.size(); ++part)
    for (const Index v : of_part[part]) number[v] = part;

  bool any = false;
  for (const ReflexEdge<Real>& edge : mesh.reflex_edges()) {
    const Index part = number[edge.vertex[0]];
    Index sides = part << part_shift;
    // Through a crack's end a plane has the crack in it, and both of its sides.
    if (part != none && part == number[edge.vertex[1]] && !is_crack(edge))
      for (std::size_t k = 0; k < 2; ++k)
        if (behind(trees[part], points, of_part[part], edge.normal[k], edge.end[0]))
          sides |= Index{1} << k;
    any |= (sides & both) != 0;
    sides_.push_back(sides);
  }
  if (!any) sides_.clear();
  tree_ = Tree(boxes_);
  std::vector<Index>().swap(parent_);
}

template <class Real>
bool SolidObstacles<Real>::passes_others(Index own, const Point& p, const Point& q) const {
  const auto from = place(p), to = place(q);
  const auto meets = [&](const Box<3>& box) {
    double begin = 0, end = 1;
    for (std::size_t d = 0; d < 3; ++d) {
      const double way = to[d] - from[d];
      if (way == 0) {
        if (from[d] < box.low[d] || from[d] > box.high[d]) return false;
        continue;
      }
      const double a = (box.low[d] - from[d]) / way, b = (box.high[d] - from[d]) / way;
      begin = std::max(begin, std::min(a, b));
      end = std::min(end, std::max(a, b));
    }
    return begin <= end;
  };
  bool any = false;
  tree_.search([&](const Box<3>& box) { return !any && meets(box); },
               [&](Index part) { any |= part != own && meets(boxes_[part]); });
  return !any;
}

}  // namespace plexway
