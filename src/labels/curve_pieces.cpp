#include "labels/curve_pieces.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

#include <plexway/error.hpp>
#include <plexway/source/source.hpp>

namespace plexway::detail {
namespace {

constexpr double tolerance = 1e-9;  // of a triangle's size
// What two triangles may place differently, of their size, and what may count as straight, radians.
template <class Real>
constexpr double apart = std::is_same_v<Real, float> ? 1e-6 : 1e-8;
template <class Real>
constexpr double straight = std::is_same_v<Real, float> ? 3e-5 : 1e-6;

using Weights3 = std::array<double, 3>;

// A point as one of the triangles that share it has it.
struct Spot {
  Index face;
  Weights3 weight;
};

template <class Real>
void spots_at_vertex(const TriangleMesh<Real>& mesh, Index vertex, std::vector<Spot>& spots) {
  std::vector<Index> corners;
  mesh.corners_at(vertex, corners);
  for (const Index c : corners) {
    Spot spot{c / 3, {0, 0, 0}};
    spot.weight[c % 3] = 1;
    spots.push_back(spot);
  }
}

template <class Real>
std::vector<Spot> spots_of(const TriangleMesh<Real>& mesh, const PointSource& point) {
  std::vector<Spot> spots;
  if (point.vertex != none) {
    spots_at_vertex(mesh, mesh.inside_vertex(point.vertex), spots);
    return spots;
  }
  const auto [f, turned] = mesh.inside_face(point.simplex);
  Weights3 b = {point.barycentric[0], point.barycentric[1], point.barycentric[2]};
  if (turned) std::swap(b[1], b[2]);
  double sum = 0;
  for (double& w : b) sum += w = w < tolerance ? 0 : w;
  for (double& w : b) w /= sum;
  for (std::size_t i = 0; i < 3; ++i)
    if (b[i] == 1) {
      spots_at_vertex(mesh, mesh.triangles()[f].corner[i], spots);
      return spots;
    }
  spots.push_back({f, b});
  for (std::size_t i = 0; i < 3; ++i) {
    if (b[i] != 0) continue;
    const std::size_t edge = edge_after(i);
    double first = b[edge], second = b[edge_after(edge)];
    for (Index across = mesh.triangles()[f].across[edge];;) {
      const Index g = across >> Across::face_shift;
      const std::size_t k = across & Across::edge_mask;
      if (g == mesh.face_count() || (g == f && k == edge)) break;
      if (!(across & Across::flip)) std::swap(first, second);
      Spot spot{g, {0, 0, 0}};
      spot.weight[k] = first;
      spot.weight[edge_after(k)] = second;
      spots.push_back(spot);
      if (!(across & Across::fan)) break;
      across = mesh.triangles()[g].across[k];
    }
  }
  return spots;
}

template <class Real>
double extent_of(const TriangleRecord<Real>& t) {
  return static_cast<double>(std::max({t.length[0], t.length[1], t.length[2]}));
}

template <class Real>
double angle_at(const TriangleRecord<Real>& t, std::size_t corner) {
  return std::atan2(static_cast<double>(t.sine(corner)), static_cast<double>(t.cosine[corner]));
}

// From edge `corner` at that corner, counterclockwise, to a direction within the triangle.
template <class Real>
double angle_of(const TriangleRecord<Real>& t, std::size_t corner, const Plane& direction) {
  const auto at = corners_of(t);
  const Plane edge = at[edge_after(corner)] - at[corner];
  return std::clamp(std::arg(direction * std::conj(edge)), 0., angle_at(t, corner));
}

// The angle of `next`'s beginning at a corner of a triangle, if it begins there.
template <class Real>
std::optional<double> begins_at(const TriangleRecord<Real>& t, Index f, std::size_t corner,
                                const CurvePiece& next) {
  if (next.face != f || place_of(t, next.from) != corner) return std::nullopt;
  return angle_of(t, corner, next.to - next.from);
}

// The angle between two pieces around the vertex between them, on one side; none where the surface
// ends or turns over before.
template <class Real>
std::optional<double> angle_between(const TriangleMesh<Real>& mesh, const CurvePiece& piece,
                                    const CurvePiece& next, std::size_t corner, int side) {
  Index f = piece.face;
  double sum = 0, at = angle_of(mesh.triangles()[f], corner, piece.from - piece.to);
  for (int steps = 0; steps < 4096; ++steps) {
    const TriangleRecord<Real>& t = mesh.triangles()[f];
    if (const auto begin = begins_at(t, f, corner, next)) {
      const double turn = side == 0 ? at - *begin : *begin - at;
      if (steps > 0 || turn >= 0) return sum + turn;
    }
    sum += side == 0 ? at : angle_at(t, corner) - at;
    const Index across = t.across[side == 0 ? corner : edge_before(corner)];
    f = across >> Across::face_shift;
    if (f == mesh.face_count() || (across & Across::special)) return std::nullopt;
    const std::size_t k = across & Across::edge_mask;
    corner = side == 0 ? edge_after(k) : k;
    at = side == 0 ? angle_at(mesh.triangles()[f], corner) : 0;
  }
  return std::nullopt;
}

}  // namespace

template <class Real>
std::size_t place_of(const TriangleRecord<Real>& t, const Plane& p) {
  const auto at = corners_of(t);
  const double near = 1e-8 * extent_of(t);
  for (std::size_t i = 0; i < 3; ++i)
    if (std::abs(p - at[i]) < near) return i;
  for (std::size_t e = 0; e < 3; ++e) {
    const Plane edge = at[edge_after(e)] - at[e];
    if (std::abs(cross(edge, p - at[e])) < near * std::abs(edge)) return 3 + e;
  }
  return 6;
}

template <class Real>
std::vector<CurvePiece> cut_curve(const TriangleMesh<Real>& mesh,
                                  std::span<const PointSource> points) {
  std::vector<CurvePiece> pieces;
  std::vector<Spot> here, there;
  if (!names_nothing(points[0])) here = spots_of(mesh, points[0]);
  for (std::size_t n = 1; n < points.size(); ++n, here.swap(there)) {
    there = names_nothing(points[n]) ? std::vector<Spot>() : spots_of(mesh, points[n]);
    if (here.empty() || there.empty()) continue;
    const Spot *from = nullptr, *to = nullptr;
    for (const Spot& a : here)
      for (const Spot& b : there) {
        if (a.face != b.face || from != nullptr) continue;
        if (a.weight == b.weight && here.size() > 1) continue;  // an edge glued to itself
        from = &a, to = &b;
      }
    if (from == nullptr) {
      const bool same = std::any_of(here.begin(), here.end(), [&](const Spot& a) {
        return !there.empty() && a.face == there[0].face && a.weight == there[0].weight;
      });
      if (same) continue;
      throw UsageError("points " + std::to_string(n - 1) + " and " + std::to_string(n) +
                       " of a curve share no face: give points where it passes edges");
    }
    const auto at = corners_of(mesh.triangles()[from->face]);
    CurvePiece piece{from->face, 3, 0, 0, n};
    for (std::size_t i = 0; i < 3; ++i) {
      piece.from += from->weight[i] * at[i];
      piece.to += to->weight[i] * at[i];
      if (from->weight[i] == 0 && to->weight[i] == 0) piece.edge = edge_after(i);
    }
    if (piece.length() > 1e-12) pieces.push_back(piece);
  }
  return pieces;
}

template <class Real>
bool runs_straight(const TriangleMesh<Real>& mesh, const CurvePiece& piece, const CurvePiece& next,
                   int side) {
  const TriangleRecord<Real>& t = mesh.triangles()[piece.face];
  const std::size_t place = place_of(t, piece.to);
  if (place < 3) {
    const auto angle = angle_between(mesh, piece, next, place, side);
    return angle && std::abs(*angle - std::numbers::pi) < straight<Real>;
  }
  const double near = apart<Real> * extent_of(t);
  if (next.face == piece.face)
    return std::abs(next.from - piece.to) < near &&
           std::abs(next.direction() - piece.direction()) < straight<Real>;
  if (place == 6) return false;
  const std::size_t edge = place - 3;
  const Index across = t.across[edge];
  if (across >> Across::face_shift != next.face || (across & Across::special)) return false;
  const std::size_t k = across & Across::edge_mask;
  const auto at = corners_of(t), beyond = corners_of(mesh.triangles()[next.face]);
  const Plane here = at[edge_after(edge)] - at[edge], there = beyond[k] - beyond[edge_after(k)];
  if (std::abs(std::abs(piece.to - at[edge]) - std::abs(next.from - beyond[edge_after(k)])) > near)
    return false;
  return std::abs(piece.direction() * std::conj(here) / std::abs(here) -
                  next.direction() * std::conj(there) / std::abs(there)) < straight<Real>;
}

template <class Real>
std::vector<bool> shows_as_point(const TriangleMesh<Real>& mesh,
                                 std::span<const PointSource> points,
                                 std::span<const CurvePiece> pieces) {
  std::vector<bool> shows(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) shows[i] = !names_nothing(points[i]);
  // All but those that a curve runs through straight, inside a triangle or over an edge.
  for (std::size_t k = 1; k < pieces.size(); ++k) {
    const CurvePiece &piece = pieces[k - 1], &next = pieces[k];
    if (next.end == piece.end + 1 && place_of(mesh.triangles()[piece.face], piece.to) >= 3 &&
        runs_straight(mesh, piece, next, 0) && runs_straight(mesh, piece, next, 1))
      shows[piece.end] = false;
  }
  return shows;
}

#define PLEXWAY_CURVES_ON(Real)                                                                \
  template std::size_t place_of(const TriangleRecord<Real>&, const Plane&);                    \
  template std::vector<CurvePiece> cut_curve(const TriangleMesh<Real>&,                        \
                                             std::span<const PointSource>);                    \
  template bool runs_straight(const TriangleMesh<Real>&, const CurvePiece&, const CurvePiece&, \
                              int);                                                            \
  template std::vector<bool> shows_as_point(                                                   \
      const TriangleMesh<Real>&, std::span<const PointSource>, std::span<const CurvePiece>);
PLEXWAY_CURVES_ON(float)
PLEXWAY_CURVES_ON(double)
#undef PLEXWAY_CURVES_ON

}  // namespace plexway::detail
