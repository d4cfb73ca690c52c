#include "paths/cells/cells.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "complexes/common/arrays.hpp"
#include "complexes/common/disjoint_sets.hpp"

namespace plexway::detail {
namespace {

// Corners of a simplex of a piece, vertices inside, in the caller's order.
template <class Real>
std::array<Index, 4> four_corners(const TriangleMesh<Real>& mesh, Index simplex) {
  const auto [f, turned] = mesh.inside_face(simplex);
  const Index* const c = mesh.triangles()[f].corner;
  return {c[0], c[turned ? 2 : 1], c[turned ? 1 : 2], none};
}
template <class Real>
std::array<Index, 4> four_corners(const TetMesh<Real>& mesh, Index simplex) {
  const auto [t, turned] = mesh.inside_tet(simplex);
  const Index* const c = mesh.tets()[t].corner;
  return {c[0], c[1], c[turned ? 3 : 2], c[turned ? 2 : 3]};
}
template <class Real>
std::array<Index, 4> four_corners(const Wireframe<Real>& wireframe, Index simplex) {
  const auto ends = wireframe.inside_edge(simplex);
  return {ends.from, ends.to, none, none};
}

template <class Real>
void place(const TriangleMesh<Real>& mesh, Index simplex, std::array<Point3, 4>& at) {
  const auto [f, turned] = mesh.inside_face(simplex);
  const TriangleRecord<Real>& t = mesh.triangles()[f];
  const double unit = mesh.unit();
  at[0] = {0, 0, 0};
  at[turned ? 2 : 1] = {static_cast<double>(t.length[0]) * unit, 0, 0};
  at[turned ? 1 : 2] = {static_cast<double>(t.apex_x(0)) * unit,
                        static_cast<double>(t.apex_h(0)) * unit, 0};
}
// By its edges (0,1) (0,2) (1,2) (0,3) (1,3) (2,3).
template <class Real>
void place_by_lengths(const TetMesh<Real>& mesh, Index simplex, std::array<Point3, 4>& at) {
  const auto [t, turned] = mesh.inside_tet(simplex);
  std::array<double, 6> squared;
  for (std::size_t e = 0; e < 6; ++e)
    squared[e] = static_cast<double>(mesh.squared_lengths()[t][e]) * mesh.unit() * mesh.unit();
  const auto& [ab, ac, bc, ad, bd, cd] = squared;
  const auto root = [](double x) { return std::sqrt(std::max(x, 0.)); };
  const auto share = [](double of, double by) { return by > 0 ? of / by : 0; };
  Point3& c = at[turned ? 3 : 2];
  Point3& d = at[turned ? 2 : 3];
  const double x = root(ab);
  at[0] = {0, 0, 0};
  at[1] = {x, 0, 0};
  c[0] = share(ab + ac - bc, 2 * x);
  c[1] = root(ac - c[0] * c[0]);
  c[2] = 0;
  d[0] = share(ab + ad - bd, 2 * x);
  d[1] = share(ac + ad - cd - 2 * c[0] * d[0], 2 * c[1]);
  d[2] = root(ad - d[0] * d[0] - d[1] * d[1]);
}
template <class Real>
void place(const TetMesh<Real>& mesh, Index simplex, std::array<Point3, 4>& at) {
  if (!mesh.embedded()) return place_by_lengths(mesh, simplex, at);
  const std::array<Index, 4> corner = four_corners(mesh, simplex);
  const auto point = [&](std::size_t i) {
    const auto& [x, y, z] = mesh.points()[corner[i]];
    return Point3{x, y, z};
  };
  const Point3 origin = point(0);
  for (std::size_t i = 0; i < 4; ++i) {
    at[i] = minus(point(i), origin);
    for (double& x : at[i]) x *= mesh.unit();
  }
}
template <class Real>
void place(const Wireframe<Real>& wireframe, Index simplex, std::array<Point3, 4>& at) {
  at[0] = {0, 0, 0};
  at[1] = {static_cast<double>(wireframe.inside_edge(simplex).length) * wireframe.unit(), 0, 0};
}

template <class Real>
std::vector<CellPiece<Real>> pieces_of(const MixedComplex<Real>& domain) {
  std::vector<CellPiece<Real>> pieces;
  for (const auto& piece : domain.pieces())
    std::visit(
        [&](const auto& complex) {
          pieces.push_back(
              {&complex, piece.first_vertex, piece.vertices, piece.first_simplex, piece.simplices});
        },
        domain.complex(piece));
  return pieces;
}

template <class Real>
std::size_t vertices_of(std::span<const CellPiece<Real>> pieces) {
  return pieces.empty() ? 0 : std::size_t{pieces.back().first_vertex} + pieces.back().vertices;
}

}  // namespace

template <class Real>
Cells::Cells(std::span<const CellPiece<Real>> pieces, Welds welds)
    : outer_(vertices_of(pieces)), vertex_(outer_.size()) {
  DisjointSets same(outer_.size());
  for (const auto& [v, w] : welds) same.unite(v, w);
  std::vector<Index> number(vertex_.size(), none);
  Index count = 0;
  for (Index v = 0; v < vertex_.size(); ++v) {
    Index& n = number[same.find(v)];
    if (n == none) n = count++;
    vertex_[v] = n;
  }
  corner_begin_.push_back(0);
  for (const CellPiece<Real>& piece : pieces)
    std::visit(
        [&](const auto* complex) {
          const std::span<const Index> inside = complex->vertices_inside();
          for (Index v = 0; v < piece.vertices; ++v)
            outer_[piece.first_vertex + inside[v]] = piece.first_vertex + v;
          for (Index s = 0; s < piece.simplices; ++s) {
            for (const Index v : four_corners(*complex, s)) {
              if (v == none) break;
              corner_.push_back(vertex_[outer_[piece.first_vertex + v]]);
            }
            corner_begin_.push_back(static_cast<std::uint32_t>(corner_.size()));
          }
        },
        piece.complex);
  fill_rows(count, around_begin_, around_, [&](const auto& add) {
    for (Index s = 0; s + 1 < corner_begin_.size(); ++s)
      for (const Index v : corners(s)) add(v, s);
  });
}

std::span<const Index> Cells::corners(Index simplex) const {
  return std::span(corner_).subspan(corner_begin_[simplex],
                                    corner_begin_[simplex + 1] - corner_begin_[simplex]);
}

void Cells::around(const CellFace& face, std::vector<Index>& simplices) const {
  simplices.clear();
  for (const Index s : around(face.vertex[0])) {
    const auto own = corners(s);
    if (own.size() < face.corners || (own.size() == 2 && face.corners > 1)) continue;
    bool all = simplices.empty() || simplices.back() != s;  // a loop has its vertex twice
    for (std::size_t i = 1; all && i < face.corners; ++i)
      all = std::find(own.begin(), own.end(), face.vertex[i]) != own.end();
    if (all) simplices.push_back(s);
  }
}

CellFace Cells::between(Index one, Index other, const CellFace& at) const {
  const auto a = corners(one), b = corners(other);
  if (a.size() == 2 || b.size() == 2) return at;
  CellFace shared;
  for (const Index v : a) {
    if (std::find(b.begin(), b.end(), v) == b.end()) continue;
    if (shared.corners == 3) return at;
    shared.add(v);
  }
  return shared;
}

std::size_t Cells::bytes() const {
  return (outer_.capacity() + vertex_.capacity() + corner_.capacity() + around_.capacity()) *
             sizeof(Index) +
         (corner_begin_.capacity() + around_begin_.capacity()) * sizeof(std::uint32_t);
}

template <class Real>
ComplexCells<Real>::ComplexCells(Pieces pieces, Welds welds)
    : Cells(std::span<const CellPiece<Real>>(pieces), welds), pieces_(std::move(pieces)) {}

template <class Real>
ComplexCells<Real>::ComplexCells(const MixedComplex<Real>& domain)
    : ComplexCells(pieces_of(domain), domain.outer_welds()) {}

template <class Real>
ComplexCells<Real>::ComplexCells(const TriangleMesh<Real>& surface)
    : ComplexCells({{&surface, 0, static_cast<Index>(surface.vertex_count()), 0,
                     static_cast<Index>(surface.face_count())}},
                   {}) {}

template <class Real>
ComplexCells<Real>::ComplexCells(const TetMesh<Real>& solid)
    : ComplexCells({{&solid, 0, static_cast<Index>(solid.vertex_count()), 0,
                     static_cast<Index>(solid.tet_count())}},
                   {}) {}

template <class Real>
ComplexCells<Real>::ComplexCells(const Wireframe<Real>& wireframe)
    : ComplexCells({{&wireframe, 0, static_cast<Index>(wireframe.vertex_count()), 0,
                     static_cast<Index>(wireframe.edge_count())}},
                   {}) {}

template <class Real>
const CellPiece<Real>& ComplexCells<Real>::piece_of(Index simplex) const {
  return *(std::upper_bound(
               pieces_.begin(), pieces_.end(), simplex,
               [](Index s, const CellPiece<Real>& piece) { return s < piece.first_simplex; }) -
           1);
}

template <class Real>
Cell ComplexCells<Real>::cell(Index simplex) const {
  Cell cell;
  for (const Index v : corners(simplex)) cell.vertex[cell.corners++] = v;
  const CellPiece<Real>& piece = piece_of(simplex);
  std::visit(
      [&](const auto* complex) { place(*complex, simplex - piece.first_simplex, cell.place); },
      piece.complex);
  return cell;
}

template <class Real>
std::array<Index, 4> ComplexCells<Real>::outer_corners(Index simplex) const {
  const CellPiece<Real>& piece = piece_of(simplex);
  std::array<Index, 4> corner = std::visit(
      [&](const auto* complex) { return four_corners(*complex, simplex - piece.first_simplex); },
      piece.complex);
  for (Index& v : corner)
    if (v != none) v = outer_[piece.first_vertex + v];
  return corner;
}

template class ComplexCells<float>;
template class ComplexCells<double>;

}  // namespace plexway::detail
