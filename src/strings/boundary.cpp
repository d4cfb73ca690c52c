#include "strings/boundary.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace plexway::detail::strings {
namespace {

constexpr double pi = std::numbers::pi;

// An edge of the boundary where a string may bend.
struct Bend {
  Index face, edge;  // one of its two faces
  std::array<Index, 2> end;
  std::array<Point, 2> normal;  // of both faces
  double angle;
};

template <class Real>
class Finder {
 public:
  Finder(const TetMesh<Real>& mesh, std::span<const Point> points)
      : tets_(mesh.tets().first(mesh.tet_count())), mesh_(mesh), points_(points) {}

  Boundary find() {
    find_faces();
    for (Index f = 0; f < boundary_.faces.size(); ++f)
      for (Index k = 0; k < 3; ++k) go_around(f, k);
    hold_pinched();
    join_rows();
    auto& rows = boundary_.rows_at;
    std::sort(rows.begin(), rows.end());
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    return std::move(boundary_);
  }

 private:
  using Face = Boundary::Face;

  [[nodiscard]] bool is_open(Index t, Index side) const {
    return tets_[t].across[side] >> TetAcross::tet_shift >= tets_.size();
  }

  void find_faces() {
    constexpr Index order[4][3] = {{1, 3, 2}, {0, 2, 3}, {0, 3, 1}, {0, 1, 2}};  // from inside
    for (Index t = 0; t < tets_.size(); ++t)
      for (Index side = 0; side < 4; ++side) {
        if (!is_open(t, side)) continue;
        Face face;
        for (Index k = 0; k < 3; ++k) face.corner[k] = tets_[t].corner[order[side][k]];
        face.across = face.place = {none, none, none};
        const Point &a = points_[face.corner[0]], &b = points_[face.corner[1]],
                    &c = points_[face.corner[2]];
        face.normal = unit(cross(b - a, c - a));
        boundary_.faces.push_back(face);
        keys_.push_back(4 * t + side);
      }
  }
  [[nodiscard]] Index number(Index tet, Index side) const {
    return static_cast<Index>(std::lower_bound(keys_.begin(), keys_.end(), 4 * tet + side) -
                              keys_.begin());
  }
  static Index corner_of(const TetRecord& tet, Index vertex) {
    return static_cast<Index>(std::find(tet.corner, tet.corner + 4, vertex) - tet.corner);
  }

  // Through the tetrahedra at an edge to the face on their other side.
  void go_around(Index f, Index k) {
    Face& face = boundary_.faces[f];
    if (face.across[k] != none) return;
    const Index a = face.corner[(k + 1) % 3], b = face.corner[(k + 2) % 3];
    Index t = keys_[f] / 4, enter = keys_[f] % 4, leave = corner_of(tets_[t], face.corner[k]);
    double turned = 0;
    for (;;) {
      const Index shared = tets_[t].corner[enter];
      turned += wedge(a, b, tets_[t].corner[leave], shared);
      const Index over = tets_[t].across[leave];
      if (is_open(t, leave)) break;
      t = over >> TetAcross::tet_shift;
      enter = over & TetAcross::face_mask;
      leave = corner_of(tets_[t], shared);
    }
    const Index g = number(t, leave);
    Face& other = boundary_.faces[g];
    Index m = 0;
    while (other.corner[m] == a || other.corner[m] == b) ++m;
    face.across[k] = g;
    other.across[m] = f;
    if (turned > pi + Tolerances::reflex && norm(points_[b] - points_[a]) > 0)
      bends_.push_back({f, k, {a, b}, {face.normal, other.normal}, turned});
  }
  // The angle of a tetrahedron at its edge a b.
  [[nodiscard]] double wedge(Index a, Index b, Index c, Index d) const {
    const Point along = points_[b] - points_[a];
    const Point p = cross(along, points_[c] - points_[a]),
                q = cross(along, points_[d] - points_[a]);
    return std::atan2(norm(cross(p, q)), dot(p, q));
  }

  // Where tetrahedra only touch in an edge strings may pass through it from one to the other.
  void hold_pinched() {
    for (const auto& e : mesh_.pinched_edges()) {
      const auto number = static_cast<Index>(boundary_.places.size());
      const Point &a = points_[e.vertex[0]], along = points_[e.vertex[1]] - a, zero = {0, 0, 0};
      Place place = {a, unit(along), 0, 0, zero, zero, zero, 0};
      for (const Index v : e.vertex) extend(place, v);
      place.first_wedge = static_cast<Index>(boundary_.wedges.size());
      for (Index i = e.begin; i < e.end; ++i)
        boundary_.wedges.push_back(wedge_of(mesh_.pinched_edge_tets()[i], e.vertex));
      place.last_wedge = static_cast<Index>(boundary_.wedges.size());
      boundary_.places.push_back(place);
      for (const Index v : e.vertex) boundary_.rows_at.push_back({v, number});
    }
  }
  void extend(Place& row, Index vertex) const {
    const double t = dot(points_[vertex] - row.origin, row.along);
    if (t <= row.low) row.low = t, row.end[0] = vertex;
    if (t >= row.high) row.high = t, row.end[1] = vertex;
  }
  [[nodiscard]] Boundary::Wedge wedge_of(Index t, const Index (&edge)[2]) const {
    const Point along = unit(points_[edge[1]] - points_[edge[0]]);
    Point side[2];
    std::size_t n = 0;
    for (const Index v : tets_[t].corner) {
      if (v == edge[0] || v == edge[1]) continue;
      const Point d = points_[v] - points_[edge[0]];
      side[n++] = unit(d - dot(d, along) * along);
    }
    const auto inward = [&](const Point& in, const Point& off) {
      return unit(off - dot(off, in) * in);
    };
    return {{inward(side[0], side[1]), inward(side[1], side[0])}, unit(side[0] + side[1])};
  }

  [[nodiscard]] bool alike(const Point& a, const Point& b) const {
    const Point d = a - b;
    return dot(d, d) < Tolerances::same * Tolerances::same;
  }
  // Do two edges from a vertex lie in one line, between the same two planes?
  [[nodiscard]] bool in_row(const Bend& a, const Bend& b, Index vertex) const {
    const auto from = [&](const Bend& e) {
      return unit(points_[e.end[0] == vertex ? e.end[1] : e.end[0]] - points_[vertex]);
    };
    if (!alike(from(a), -1. * from(b))) return false;
    return (alike(a.normal[0], b.normal[0]) && alike(a.normal[1], b.normal[1])) ||
           (alike(a.normal[0], b.normal[1]) && alike(a.normal[1], b.normal[0]));
  }
  Index root(Index e) {
    while (row_[e] != e) e = row_[e] = row_[row_[e]];
    return e;
  }
  void join_rows() {
    std::vector<std::pair<Index, Index>> at;  // vertex, edge
    row_.resize(bends_.size());
    for (Index e = 0; e < bends_.size(); ++e) {
      row_[e] = e;
      for (const Index v : bends_[e].end) at.push_back({v, e});
    }
    std::sort(at.begin(), at.end());
    for (std::size_t i = 0; i < at.size(); ++i)
      for (std::size_t j = i + 1; j < at.size() && at[j].first == at[i].first; ++j)
        if (in_row(bends_[at[i].second], bends_[at[j].second], at[i].first))
          row_[root(std::max(at[i].second, at[j].second))] =
              root(std::min(at[i].second, at[j].second));
    std::vector<Index> place(bends_.size(), none);
    for (Index e = 0; e < bends_.size(); ++e) {
      const Index first = root(e);
      if (place[first] == none) {
        place[first] = static_cast<Index>(boundary_.places.size());
        boundary_.places.push_back(place_of(bends_[first]));
      }
      Place& row = boundary_.places[place[first]];
      for (const Index v : bends_[e].end) {
        boundary_.rows_at.push_back({v, place[first]});
        extend(row, v);
      }
      Face& face = boundary_.faces[bends_[e].face];
      Face& other = boundary_.faces[face.across[bends_[e].edge]];
      face.place[bends_[e].edge] = place[first];
      for (Index m = 0; m < 3; ++m)
        if (other.corner[m] != bends_[e].end[0] && other.corner[m] != bends_[e].end[1])
          other.place[m] = place[first];
    }
  }
  [[nodiscard]] Place place_of(const Bend& e) const {
    const Face& face = boundary_.faces[e.face];
    Place place;
    place.origin = points_[e.end[0]];
    place.along = unit(points_[e.end[1]] - place.origin);
    place.low = place.high = 0;
    place.normal = e.normal[0];
    const Point side = points_[face.corner[e.edge]] - place.origin;
    place.floor = unit(side - dot(side, place.along) * place.along);
    if (norm(place.normal) == 0) place.normal = unit(cross(place.along, place.floor));
    place.angle = e.angle;
    place.into = unit(std::cos(e.angle / 2) * place.floor + std::sin(e.angle / 2) * place.normal);
    return place;
  }

  std::span<const TetRecord> tets_;
  const TetMesh<Real>& mesh_;
  std::span<const Point> points_;
  Boundary boundary_;
  std::vector<Index> keys_;  // 4 t + side of each face, ascending
  std::vector<Bend> bends_;
  std::vector<Index> row_;
};

}  // namespace

template <class Real>
Boundary find_boundary(const TetMesh<Real>& mesh, std::span<const Point> points) {
  return Finder<Real>(mesh, points).find();
}

template Boundary find_boundary(const TetMesh<float>&, std::span<const Point>);
template Boundary find_boundary(const TetMesh<double>&, std::span<const Point>);

}  // namespace plexway::detail::strings
