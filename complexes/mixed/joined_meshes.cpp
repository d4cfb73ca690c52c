#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "complexes/common/arrays.hpp"
#include "complexes/common/disjoint_sets.hpp"
#include "complexes/common/simplex_order.hpp"
#include "complexes/mixed/joined_pieces.hpp"
#include "complexes/surface/face_layout.hpp"
#include "complexes/surface/shape_blocks.hpp"
#include "complexes/surface/triangle_shape.hpp"

namespace plexway::detail {

namespace {

// Edge or corner of a face: as given from as it lies inside.
Index edge_given(bool turned, std::size_t inside) {
  return static_cast<Index>(turned ? 2 - inside : inside);
}
Index corner_given(bool turned, std::size_t inside) {
  return static_cast<Index>(turned && inside != 0 ? 3 - inside : inside);
}

// Shapes as the parts have them.
class ShapesOfParts final : public TriangleShapes {
 public:
  explicit ShapesOfParts(std::span<const TriangleShape> shapes) : shapes_(shapes) {}
  void look_up(std::span<const Index> faces, ShapeBlock& block) const override {
    for (std::size_t k = 0; k < faces.size(); ++k) {
      const TriangleShape& shape = shapes_[faces[k]];
      for (std::size_t i = 0; i < 3; ++i) {
        block.length[i][k] = shape.length[i];
        block.cosine[i][k] = shape.cosine[i];
        block.sine[i][k] = shape.sine[i];
      }
      block.degenerate[k] = shape.degenerate;
      block.violated[k] = shape.violated;
    }
  }

 private:
  std::span<const TriangleShape> shapes_;
};

// What edges of one surface and its faces are called in the whole.
template <class Real>
class CornerNumbers {
 public:
  CornerNumbers(const TriangleMesh<Real>& mesh, Index first_face) : first_(first_face) {
    given_.resize(mesh.face_count());
    for (Index f = 0; f < mesh.face_count(); ++f) {
      const auto [inside, turned] = mesh.inside_face(f);
      given_[inside] = {f, turned};
    }
  }
  [[nodiscard]] Index halfedge(Index inside, std::size_t edge) const {
    const auto [f, turned] = given_[inside];
    return 3 * (first_ + f) + edge_given(turned, edge);
  }

 private:
  Index first_;
  std::vector<std::pair<Index, bool>> given_;
};

// Lengths of one edge that differ by rounding, or by what a weld tolerates, become their mean;
// triangles with such an edge get the angles of their lengths.
template <class Real>
bool shapes_agree(std::vector<TriangleShape>& shapes, const std::vector<Index>& after) {
  constexpr double rounding = 64 * std::numeric_limits<Real>::epsilon(), alike = 1e-6;
  bool refracts = false;
  std::vector<char> changed(shapes.size(), 0);
  const auto length = [&](Index h) -> double& { return shapes[h / 3].length[h % 3]; };
  for (Index h = 0; h < after.size(); ++h) {
    double least = length(h), most = least, sum = least;
    std::size_t count = 1;
    bool first = true;
    for (Index k = after[h]; k != h; k = after[k], ++count) {
      first &= h < k;
      least = std::min(least, length(k));
      most = std::max(most, length(k));
      sum += length(k);
    }
    if (!first || most - least <= rounding * most) continue;
    if (most - least > std::max(alike, rounding) * most) {
      refracts = true;
      continue;
    }
    Index k = h;
    do {
      length(k) = sum / static_cast<double>(count);
      changed[k / 3] = 1;
      k = after[k];
    } while (k != h);
  }
  for (std::size_t f = 0; f < shapes.size(); ++f)
    if (changed[f]) shapes[f] = shape_from_lengths(shapes[f].length);
  return refracts;
}

}  // namespace

template <class Real>
TriangleMesh<Real> join_surfaces(std::size_t vertices, std::span<const JoinedPart<Real>> parts,
                                 std::span<const SurfaceSeam> seams) {
  std::vector<std::array<Index, 3>> faces;
  std::vector<TriangleShape> shapes;
  std::vector<Index> after;  // the next halfedge around an edge, itself if there is none
  std::vector<CornerNumbers<Real>> numbering;
  for (const auto& part : parts) {
    const TriangleMesh<Real>& mesh = *part.mesh;
    const auto first = static_cast<Index>(faces.size());
    numbering.emplace_back(mesh, first);
    std::vector<Index> vertex(mesh.vertex_count());
    for (Index v = 0; v < vertex.size(); ++v) vertex[mesh.inside_vertex(v)] = part.vertex[v];
    faces.resize(first + mesh.face_count());
    shapes.resize(faces.size());
    after.resize(3 * faces.size());
    for (Index f = 0; f < mesh.face_count(); ++f) {
      const auto [inside, turned] = mesh.inside_face(f);
      const TriangleRecord<Real>& t = mesh.triangles()[inside];
      TriangleShape& shape = shapes[first + f];
      for (std::size_t i = 0; i < 3; ++i) {
        const Index c = corner_given(turned, i), e = edge_given(turned, i);
        faces[first + f][c] = vertex[t.corner[i]];
        shape.cosine[c] = t.cosine[i];
        shape.sine[c] = t.sine(i);
        shape.length[e] = static_cast<double>(t.length[i]) * mesh.unit();
        const Index across = t.across[i], g = across >> Across::face_shift;
        after[3 * (first + f) + e] = g == mesh.face_count()
                                         ? 3 * (first + f) + e
                                         : numbering.back().halfedge(g, across & Across::edge_mask);
      }
      shape.degenerate = shape.sine[0] < 1e-14 || shape.sine[1] < 1e-14 || shape.sine[2] < 1e-14;
    }
  }

  DisjointSets edges(after.size());
  for (Index h = 0; h < after.size(); ++h) edges.unite(h, after[h]);
  for (const SurfaceSeam& seam : seams)
    for (const SharedFace& face : seam.shared) {
      if (face.dimension() != 1) continue;
      Index one = none;
      for (const std::size_t side : {0U, 1U})
        for (const SharedMember& m : face.members[side]) {
          const std::size_t i = m.corner[0], j = m.corner[1];
          const Index h =
              numbering[seam.part[side]].halfedge(m.simplex, j == edge_after(i) ? i : j);
          if (one == none) one = h;
          if (edges.find(one) == edges.find(h)) continue;
          std::swap(after[one], after[h]);  // two cycles become one
          edges.unite(one, h);
        }
    }

  SurfaceHints hints;
  hints.refracts = shapes_agree<Real>(shapes, after);
  std::vector<std::array<Index, 3>> across(faces.size());
  for (Index h = 0; h < after.size(); ++h) across[h / 3][h % 3] = after[h] == h ? none : after[h];
  const std::span<const std::array<Index, 3>> gluing = across;
  return {FaceLayout(vertices, faces, breadth_first(gluing), gluing, hints.threads),
          ShapesOfParts(shapes), hints};
}

template TriangleMesh<float> join_surfaces(std::size_t, std::span<const JoinedPart<float>>,
                                           std::span<const SurfaceSeam>);
template TriangleMesh<double> join_surfaces(std::size_t, std::span<const JoinedPart<double>>,
                                            std::span<const SurfaceSeam>);

namespace {

// Along the first edge, across it in the plane, and off the plane.
std::array<Point3, 3> axes_of(const std::array<Point3, 3>& t, const Point3& inside, double side) {
  const Point3 u = unit(minus(t[1], t[0]));
  Point3 n = unit(cross(u, minus(t[2], t[0])));
  const Point3 w = cross(n, u);
  if (dot(n, minus(inside, t[0])) * side < 0) n = {-n[0], -n[1], -n[2]};
  return {u, w, n};
}

double gap(const Point3& a, const Point3& b) {
  const Point3 d = minus(a, b);
  return std::sqrt(dot(d, d));
}

}  // namespace

Placing place_onto(const std::array<Point3, 3>& at, const Point3& inside,
                   const std::array<Point3, 3>& onto, const Point3& onto_inside, double tolerance) {
  const auto from = axes_of(at, inside, 1), to = axes_of(onto, onto_inside, -1);
  if (std::max({gap(at[0], onto[0]), gap(at[1], onto[1]), gap(at[2], onto[2])}) <= tolerance &&
      dot(from[2], to[2]) > 0)
    return {};
  Placing placing;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      placing.turn[i][k] = 0;
      for (std::size_t a = 0; a < 3; ++a) placing.turn[i][k] += to[a][i] * from[a][k];
    }
  placing.move = minus(onto[0], placing(at[0]));
  return placing;
}

template <class Real>
std::vector<Point3> places_of(const TetMesh<Real>& mesh, std::span<const Point3> given) {
  std::vector<Point3> own(mesh.vertex_count());
  Point3 shift = {0, 0, 0};
  double size = 0;
  for (Index v = 0; v < own.size(); ++v) {
    const auto& [x, y, z] = mesh.points()[mesh.inside_vertex(v)];
    own[v] = {x * mesh.unit(), y * mesh.unit(), z * mesh.unit()};
    size = std::max({size, std::abs(own[v][0]), std::abs(own[v][1]), std::abs(own[v][2])});
  }
  if (given.empty()) return own;
  shift = minus(given[0], own[0]);
  const double rounding = 1e-9 * (size + std::sqrt(dot(shift, shift)));
  for (Index v = 0; v < own.size(); ++v)
    if (!(gap(minus(given[v], own[v]), shift) <= rounding)) return own;
  return {given.begin(), given.end()};
}

template <class Real>
std::vector<std::array<Index, 4>> tets_of(const TetMesh<Real>& mesh) {
  const std::vector<Index> given = vertices_outside(mesh);
  std::vector<std::array<Index, 4>> tets(mesh.tet_count());
  for (Index t = 0; t < tets.size(); ++t) {
    const auto [inside, turned] = mesh.inside_tet(t);
    for (std::size_t i = 0; i < 4; ++i) tets[t][i] = given[mesh.tets()[inside].corner[i]];
    if (turned) std::swap(tets[t][2], tets[t][3]);
  }
  return tets;
}

template std::vector<Point3> places_of(const TetMesh<float>&, std::span<const Point3>);
template std::vector<Point3> places_of(const TetMesh<double>&, std::span<const Point3>);
template std::vector<std::array<Index, 4>> tets_of(const TetMesh<float>&);
template std::vector<std::array<Index, 4>> tets_of(const TetMesh<double>&);

}  // namespace plexway::detail
