#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include <plexway/complex/tet_mesh.hpp>

#include "complex/box_tree.hpp"

namespace plexway {

/// Corners of face i, anticlockwise as seen from outside.
inline constexpr Index tet_face_corners[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};

/// What lines in a solid can run into: the faces of its boundary that have some of the solid behind
/// them, in parts that hang together. Where a plane has all of a part behind it, no line between
/// two points in front of it meets that part. Planes are those of the faces at reflex edges: so for
/// a line from such an edge it is clear which ones to ask, and for others one that faces the line
/// is.
///
/// A plane that has faces of a part in it that look both ways, as a crack's, is none of these.
///
/// Empty where no reflex edge has such a plane: for lengths alone, in convex solids, and where the
/// boundary is one part with dents and bumps. Cost: n log n in vertices of the boundary, about 30
/// ns a tetrahedron; memory: of parts and reflex edges.
template <class Real>
class SolidObstacles {
 public:
  using Point = Vector3<Real>;

  [[nodiscard]] bool empty() const { return sides_.empty(); }
  [[nodiscard]] std::uint64_t identity() const { return identity_; }

  /// Of another solid, in the memory that there is.
  void measure(const TetMesh<Real>& mesh);

  /// Does the line between two points of the solid, or of its boundary, surely meet no face of the
  /// boundary? False: it may. p is a point of that one of the solid's reflex edges; none, or one
  /// beyond them, is of no help.
  [[nodiscard]] bool clear(Index edge, const ReflexEdge<Real>* edges, const Point& p,
                           const Point& q) const {
    if (edge == none) return passes(none, p, q);
    if (edge >= sides_.size() || (sides_[edge] & both) == 0) return false;
    const Index sides = sides_[edge];
    const ReflexEdge<Real>& e = edges[edge];
    const Point off = q - e.end[0];
    const bool before = ((sides & 1) != 0 && dot(e.normal[0], off) >= -on_plane) ||
                        ((sides & 2) != 0 && dot(e.normal[1], off) >= -on_plane);
    return before && (parts_.size() == 1 || passes(sides >> part_shift, p, q));
  }

  /// A tetrahedron at a reflex edge of the solid's own, near the point so far along it.
  [[nodiscard]] Index beside(Index number, const ReflexEdge<Real>& edge, Real along) const {
    const Index begin = rows_[number], count = rows_[number + 1] - begin;
    const Real at = along / edge.extent * static_cast<Real>(count);
    return beside_[begin + std::min(static_cast<Index>(std::max(at, Real(0))), count - 1)];
  }

 private:
  using Tree = BoxTree<3>;
  using Face = std::array<Index, 3>;  // anticlockwise as seen from outside
  static constexpr Index both = 3;    // flags of an edge's two faces, below the number of its part
  static constexpr int part_shift = 2;
  /// In mean edges, far below what lines are walked beside edges: what is no farther in front of a
  /// plane lies in it.
  static constexpr Real on_plane = Real(1e-5);

  struct Plane {
    Point normal;
    Real height;  // dot(normal, p) of its points
  };
  struct Part {
    Box<3> box;
    Point middle, per_size;  // of its box: 1 / half of each side
    Index begin, end;        // of its planes
    Index cells;             // of its cube in facing_, or none
  };
  static constexpr Index few = 12;        // planes that are all asked
  static constexpr int cells_along = 16;  // cells along a side of a cube

  static std::array<double, 3> place(const Point& p) {
    return {static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)};
  }
  /// A tree of points; `at` are the numbers of those in it.
  static Tree tree_of(std::span<const Point> points, std::span<const Index> at);
  static bool behind(const Tree& tree, std::span<const Point> points, std::span<const Index> at,
                     const Point& normal, const Point& on);
  static bool has_lip(const Tree& tree, std::span<const Point> points, std::span<const Face> faces,
                      const Point& normal, const Point& on);
  void fill(const TetMesh<Real>& mesh);
  /// Does the line miss all parts but one?
  [[nodiscard]] bool passes(Index but, const Point& p, const Point& q) const;
  /// Is there a plane, of those looked at, that a part is behind and both points are in front of?
  [[nodiscard]] bool parted(Index part, const Point& p, const Point& q) const;
  void add_part(const Box<3>& box, std::vector<Plane>& planes);
  void line_up(const TetMesh<Real>& mesh);
  static Point way_of(int cell);
  static int cell_of(const Point& way);

  Index part_of(Index vertex) {
    while (parent_[vertex] != vertex) vertex = parent_[vertex] = parent_[parent_[vertex]];
    return vertex;
  }

  std::uint64_t identity_ = 0;
  std::vector<Index> sides_;  // by reflex edge
  std::vector<Part> parts_;
  std::vector<Plane> planes_;         // by part
  std::vector<Index> facing_;         // planes by directions: parts with many have a cube of cells
  Tree tree_;                         // of boxes around parts
  std::vector<Index> rows_, beside_;  // tetrahedra along each reflex edge, about one a mean edge
  std::vector<Index> parent_;         // of vertices: while it is made
};

template <class Real>
BoxTree<3> SolidObstacles<Real>::tree_of(std::span<const Point> points, std::span<const Index> at) {
  std::vector<Box<3>> boxes;
  boxes.reserve(at.size());
  for (const Index v : at) boxes.push_back({place(points[v]), place(points[v])});
  return Tree(boxes);
}

// Is none of the points in front of a plane?
template <class Real>
bool SolidObstacles<Real>::behind(const Tree& tree, std::span<const Point> points,
                                  std::span<const Index> at, const Point& normal, const Point& on) {
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

// Does a face in the plane have the solid behind it? It is a crack's then, whose other side points
// in front of the plane, as those on the face are, do not see.
template <class Real>
bool SolidObstacles<Real>::has_lip(const Tree& tree, std::span<const Point> points,
                                   std::span<const Face> faces, const Point& normal,
                                   const Point& on) {
  const auto n = place(normal);
  const double height = static_cast<double>(dot(normal, on));
  constexpr double near = 4 * static_cast<double>(on_plane);
  bool found = false;
  tree.search(
      [&](const Box<3>& box) {
        double low = 0, high = 0;
        for (std::size_t d = 0; d < 3; ++d) {
          low += n[d] * (n[d] > 0 ? box.low[d] : box.high[d]);
          high += n[d] * (n[d] > 0 ? box.high[d] : box.low[d]);
        }
        return !found && low <= height + near && high >= height - near;
      },
      [&](Index i) {
        const auto [a, b, c] = faces[i];
        const auto off = [&](Index v) {
          return std::abs(static_cast<double>(dot(normal, points[v] - on)));
        };
        found = found || (off(a) <= near && off(b) <= near && off(c) <= near &&
                          dot(normal, cross(points[b] - points[a], points[c] - points[a])) > 0);
      });
  return found;
}

template <class Real>
void SolidObstacles<Real>::measure(const TetMesh<Real>& mesh) {
  identity_ = 0;  // of none, should memory run out
  fill(mesh);
  identity_ = mesh.identity();
}

template <class Real>
void SolidObstacles<Real>::fill(const TetMesh<Real>& mesh) {
  sides_.clear();
  parts_.clear();
  planes_.clear();
  facing_.clear();
  if (!mesh.embedded() || mesh.reflex_edges().empty()) return;
  const std::span<const Point> points = mesh.points();
  const std::span<const TetRecord<Real>> tets = mesh.tets();
  const Index sentinel = static_cast<Index>(mesh.tet_count());

  std::vector<Face> faces;
  for (Index t = 0; t < sentinel; ++t)
    for (std::size_t i = 0; i < 4; ++i)
      if (tets[t].across[i] >> TetAcross::tet_shift == sentinel)
        faces.push_back({tets[t].corner[tet_face_corners[i][0]],
                         tets[t].corner[tet_face_corners[i][1]],
                         tets[t].corner[tet_face_corners[i][2]]});
  std::vector<Index> rim;  // vertices of the boundary
  for (const auto& face : faces) rim.insert(rim.end(), face.begin(), face.end());
  std::sort(rim.begin(), rim.end());
  rim.erase(std::unique(rim.begin(), rim.end()), rim.end());
  const Tree all = tree_of(points, rim);

  parent_.resize(points.size());
  std::iota(parent_.begin(), parent_.end(), Index{0});
  std::vector<Index> met;  // vertices of faces that lines can run into, which stay in `faces`
  std::size_t kept = 0;
  for (const Face face : faces) {
    const auto [a, b, c] = face;
    const Point across = cross(points[b] - points[a], points[c] - points[a]);
    const Real size = norm(across);
    if (size > 0 && behind(all, points, rim, Real(1) / size * across, points[a])) continue;
    parent_[part_of(b)] = part_of(a);
    parent_[part_of(c)] = part_of(a);
    met.insert(met.end(), {a, b, c});
    faces[kept++] = face;
  }
  faces.resize(kept);
  std::sort(met.begin(), met.end());
  met.erase(std::unique(met.begin(), met.end()), met.end());
  for (const Index v : met) parent_[v] = part_of(v);
  std::sort(met.begin(), met.end(), [&](Index v, Index w) {
    return parent_[v] != parent_[w] ? parent_[v] < parent_[w] : v < w;
  });
  std::stable_sort(faces.begin(), faces.end(),
                   [&](const Face& a, const Face& b) { return parent_[a[0]] < parent_[b[0]]; });

  std::vector<Tree> trees, face_trees;
  std::vector<std::span<const Index>> of_part;
  std::vector<std::span<const Face>> faces_of;
  std::vector<Box<3>> boxes;
  auto face = faces.begin();
  for (std::size_t begin = 0, end = 0; begin < met.size(); begin = end) {
    const Index root = parent_[met[begin]];
    Box<3> box = Box<3>::empty();
    for (; end < met.size() && parent_[met[end]] == root; ++end) box.add(place(points[met[end]]));
    of_part.push_back(std::span<const Index>(met).subspan(begin, end - begin));
    trees.push_back(tree_of(points, of_part.back()));
    const auto first = face;
    std::vector<Box<3>> around;
    for (; face != faces.end() && parent_[(*face)[0]] == root; ++face) {
      around.push_back(Box<3>::empty());
      for (const Index v : *face) around.back().add(place(points[v]));
    }
    faces_of.push_back(std::span<const Face>(faces).subspan(
        static_cast<std::size_t>(first - faces.begin()), static_cast<std::size_t>(face - first)));
    face_trees.push_back(Tree(around));
    box.widen(10 * static_cast<double>(on_plane));
    boxes.push_back(box);
  }
  std::vector<Index> number(points.size(), none);
  for (Index part = 0; part < of_part.size(); ++part)
    for (const Index v : of_part[part]) number[v] = part;

  std::vector<std::vector<Plane>> planes(of_part.size());
  for (const ReflexEdge<Real>& edge : mesh.reflex_edges()) {
    const Index part = number[edge.vertex[0]];
    Index sides = part << part_shift;
    if (part != none && part == number[edge.vertex[1]])
      for (std::size_t k = 0; k < 2; ++k)
        if (behind(trees[part], points, of_part[part], edge.normal[k], edge.end[0]) &&
            !has_lip(face_trees[part], points, faces_of[part], edge.normal[k], edge.end[0])) {
          sides |= Index{1} << k;
          planes[part].push_back({edge.normal[k], dot(edge.normal[k], edge.end[0])});
        }
    sides_.push_back(sides);
  }
  for (Index part = 0; part < of_part.size(); ++part) add_part(boxes[part], planes[part]);
  if (planes_.empty()) {
    sides_.clear();
    return;
  }
  line_up(mesh);
  tree_ = Tree(boxes);
  std::vector<Index>().swap(parent_);
}

// Of the tetrahedra at an edge the one that lies most in the middle of its fan, where lines to the
// edge are walked to.
template <class Real>
void SolidObstacles<Real>::line_up(const TetMesh<Real>& mesh) {
  const std::span<const ReflexEdge<Real>> edges = mesh.reflex_edges();
  rows_.assign(1, 0);
  for (const ReflexEdge<Real>& edge : edges)
    rows_.push_back(rows_.back() + static_cast<Index>(edge.extent) + 1);
  beside_.assign(rows_.back(), none);
  std::vector<Real> best(rows_.back(), -2);
  for (Index t = 0; t < mesh.tet_count(); ++t) {
    Index e = mesh.tets()[t].reflex;
    if (e == none) continue;
    for (;; ++e) {
      const Index entry = mesh.reflex_list()[e], number = entry >> ReflexEntry::edge_shift;
      const ReflexEdge<Real>& edge = edges[number];
      const Point off = mesh.tets()[t].centre - edge.end[0];
      const Real along = dot(off, edge.direction);
      const Point out = off - along * edge.direction;
      const Index begin = rows_[number], count = rows_[number + 1] - begin;
      const Real at = std::clamp(along / edge.extent, Real(0), Real(1)) * static_cast<Real>(count);
      const Index place = begin + std::min(static_cast<Index>(at), count - 1);
      const Real towards = dot(out, edge.solid) / norm(out);
      if (towards > best[place]) {
        best[place] = towards;
        beside_[place] = t;
      }
      if ((entry & ReflexEntry::last) != 0) break;
    }
  }
  for (std::size_t i = 0; i < edges.size(); ++i) {  // where none has its centre
    for (Index k = rows_[i] + 1; k < rows_[i + 1]; ++k)
      if (beside_[k] == none) beside_[k] = beside_[k - 1];
    for (Index k = rows_[i + 1] - 1; k-- > rows_[i];)
      if (beside_[k] == none) beside_[k] = beside_[k + 1];
  }
}

template <class Real>
void SolidObstacles<Real>::add_part(const Box<3>& box, std::vector<Plane>& planes) {
  // Each once, but for rounding.
  const auto key = [](const Plane& p) {
    const auto near = [](Real x) { return std::round(x / on_plane); };
    return std::array<Real, 4>{near(p.height), near(p.normal.x), near(p.normal.y),
                               near(p.normal.z)};
  };
  std::sort(planes.begin(), planes.end(),
            [&](const Plane& a, const Plane& b) { return key(a) < key(b); });
  planes.erase(std::unique(planes.begin(), planes.end(),
                           [&](const Plane& a, const Plane& b) { return key(a) == key(b); }),
               planes.end());
  Part part = {box, {}, {}, static_cast<Index>(planes_.size()), 0, none};
  planes_.insert(planes_.end(), planes.begin(), planes.end());
  part.end = static_cast<Index>(planes_.size());
  const auto middle = [&](std::size_t d) {
    return static_cast<Real>((box.low[d] + box.high[d]) / 2);
  };
  const auto per_size = [&](std::size_t d) {
    return static_cast<Real>(2 / (box.high[d] - box.low[d]));
  };
  part.middle = {middle(0), middle(1), middle(2)};
  part.per_size = {per_size(0), per_size(1), per_size(2)};
  if (part.end - part.begin > few) {
    part.cells = static_cast<Index>(facing_.size());
    for (int cell = 0; cell < 6 * cells_along * cells_along; ++cell) {
      const Point way = way_of(cell);
      Index best = part.begin;
      for (Index i = part.begin; i < part.end; ++i)
        if (dot(planes_[i].normal, way) > dot(planes_[best].normal, way)) best = i;
      facing_.push_back(best);
    }
  }
  parts_.push_back(part);
}

// Cells of a cube around the origin: six faces, each a square of them.
template <class Real>
Vector3<Real> SolidObstacles<Real>::way_of(int cell) {
  const auto middle = [](int i) { return (2 * static_cast<Real>(i) + 1) / cells_along - 1; };
  const int face = cell / (cells_along * cells_along);
  const Real x = face % 2 == 0 ? Real(1) : Real(-1), y = middle(cell % cells_along),
             z = middle(cell / cells_along % cells_along);
  const Point way = face < 2 ? Point{x, y, z} : face < 4 ? Point{z, x, y} : Point{y, z, x};
  return Real(1) / norm(way) * way;
}
template <class Real>
int SolidObstacles<Real>::cell_of(const Point& way) {
  const Real size[3] = {std::abs(way.x), std::abs(way.y), std::abs(way.z)};
  const int axis = size[0] >= size[1] && size[0] >= size[2] ? 0 : size[1] >= size[2] ? 1 : 2;
  const Real to[5] = {way.x, way.y, way.z, way.x, way.y};
  const auto place_of = [&](Real x) {
    return std::min(static_cast<int>((x / size[axis] + 1) / 2 * cells_along), cells_along - 1);
  };
  const int face = 2 * axis + (to[axis] < 0);
  return (face * cells_along + place_of(to[axis + 2])) * cells_along + place_of(to[axis + 1]);
}

template <class Real>
bool SolidObstacles<Real>::parted(Index number, const Point& p, const Point& q) const {
  const Part& part = parts_[number];
  const auto before = [&](const Plane& plane) {
    const Real least = plane.height - on_plane;
    return dot(plane.normal, p) >= least && dot(plane.normal, q) >= least;
  };
  if (part.cells == none)
    return std::any_of(planes_.begin() + part.begin, planes_.begin() + part.end, before);
  // The plane that faces the line where that is nearest to the middle, the box being a cube.
  const auto scaled = [&](const Point& x) {
    return Point{x.x * part.per_size.x, x.y * part.per_size.y, x.z * part.per_size.z};
  };
  const Point from = scaled(p - part.middle), on = scaled(q - p);
  const Real along2 = dot(on, on);
  const Real share = along2 > 0 ? std::clamp(-dot(from, on) / along2, Real(0), Real(1)) : Real(0);
  const Point way = scaled(from + share * on);
  if (!(dot(way, way) > 0)) return false;
  return before(planes_[facing_[part.cells + static_cast<Index>(cell_of(way))]]);
}

template <class Real>
bool SolidObstacles<Real>::passes(Index but, const Point& p, const Point& q) const {
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
  bool missed = true;
  tree_.search([&](const Box<3>& box) { return missed && meets(box); },
               [&](Index part) {
                 missed = missed && (part == but || !meets(parts_[part].box) || parted(part, p, q));
               });
  return missed;
}

}  // namespace plexway
