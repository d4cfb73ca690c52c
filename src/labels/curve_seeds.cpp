#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

#include <plexway/error.hpp>
#include <plexway/source/source.hpp>

#include "labels/curve_seeds.hpp"

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

constexpr double far_away = 1e7;  // lengths of a line that its virtual source is behind it
// What light yields to the points at its ends, in units or lengths of the line, whichever is more:
// beyond the ends both offer the same distance, and a point is seen from more sides. It is more
// than rounding does to light.
constexpr double yields = 1e-7;

// In the coordinates of a straight line: s along it, h off it on the side that is lit.
struct LinePoint {
  double s, h;
};

// A straight run of pieces as one of its pieces sees it, lit to one side.
struct LitLine {
  Plane origin, along, up;
  double length;
  LinePoint first, last;  // what hides its light beyond: its ends, or saddles before them

  [[nodiscard]] Plane at(double s, double h) const { return origin + s * along + h * up; }
  [[nodiscard]] LinePoint of(const Plane& p) const {
    return {dot(along, p - origin), dot(up, p - origin)};
  }
};

// May the light go out over an edge from a to b? Its part within the strip must not lie below the
// line, where the light comes from, nor may all of it be beyond the strip.
bool leaves_over(const LitLine& line, const Plane& a, const Plane& b, double size) {
  const Plane far = line.at(line.length / 2, -far_away * line.length);
  if (!(cross(b - a, far - a) > 0)) return false;
  LinePoint p = line.of(a), q = line.of(b);
  if (p.s > q.s) std::swap(p, q);
  const double first = std::max(p.s, 0.), last = std::min(q.s, line.length);
  if (!(last - first > tolerance * size)) return false;
  const auto height = [&](double s) { return p.h + (q.h - p.h) * (s - p.s) / (q.s - p.s); };
  return std::min(height(first), height(last)) >= -tolerance * size;
}

class Lighting {
 public:
  Lighting(std::vector<CurveSeeds::Light>& lights, double sigma, Index number)
      : lights_(lights), sigma_(sigma), number_(number) {}

  void light(const TriangleMesh<double>& mesh, std::span<const CurvePiece> pieces, int side) {
    for (std::size_t begin = 0; begin < pieces.size();) {
      std::size_t end = begin + 1;
      while (end < pieces.size() && runs_straight(mesh, pieces[end - 1], pieces[end], side)) ++end;
      light_run(mesh, pieces.subspan(begin, end - begin), side);
      begin = end;
    }
  }

  // The longest line lit so far.
  [[nodiscard]] double longest() const { return longest_; }

 private:
  // One straight line through several triangles.
  void light_run(const TriangleMesh<double>& mesh, std::span<const CurvePiece> run, int side) {
    start_.assign(run.size() + 1, 0);
    for (std::size_t k = 0; k < run.size(); ++k) start_[k + 1] = start_[k] + run[k].length();
    const double length = start_.back();
    longest_ = std::max(longest_, length);
    // Saddles at the lit ends of the edges that the line crosses.
    first_.assign(run.size(), {0, 0});
    last_.assign(run.size(), {length, 0});
    const auto saddle = [&](std::size_t k, LinePoint& p) {
      const TriangleRecord<double>& t = mesh.triangles()[run[k].face];
      const std::size_t place = place_of(t, run[k].to);
      if (place < 3 || place > 5) return false;
      const auto at = corners_of(t);
      const LitLine line = seen_by(run, k, side);
      for (const std::size_t corner : {place - 3, edge_after(place - 3)}) {
        p = line.of(at[corner]);
        if (p.h > 0 && t.saddle(corner)) return true;
      }
      return false;
    };
    for (std::size_t k = 1; k < run.size(); ++k) {
      first_[k] = first_[k - 1];
      LinePoint p;
      if (saddle(k - 1, p) && p.s > first_[k].s) first_[k] = p;
    }
    for (std::size_t k = run.size() - 1; k-- > 0;) {
      last_[k] = last_[k + 1];
      LinePoint p;
      if (saddle(k, p) && p.s < last_[k].s) last_[k] = p;
    }
    for (std::size_t k = 0; k < run.size(); ++k) {
      LitLine line = seen_by(run, k, side);
      line.first = first_[k];
      line.last = last_[k];
      light_piece(mesh, run[k], line, side);
    }
  }

  [[nodiscard]] LitLine seen_by(std::span<const CurvePiece> run, std::size_t k, int side) const {
    const Plane along = run[k].direction();
    const Plane up = along * Plane(0, side == 0 ? 1 : -1);
    return {run[k].from - start_[k] * along, along, up, start_.back(), {}, {}};
  }

  void light_piece(const TriangleMesh<double>& mesh, const CurvePiece& piece, const LitLine& line,
                   int side) {
    const TriangleRecord<double>& t = mesh.triangles()[piece.face];
    const auto at = corners_of(t);
    if (piece.edge < 3) {
      // The triangle lies to the left of its own edges.
      const bool forward = dot(piece.direction(), at[edge_after(piece.edge)] - at[piece.edge]) > 0;
      add(piece.face, piece.edge, forward == (side == 0), line, side);
      return;
    }
    const double size = std::max({t.length[0], t.length[1], t.length[2]});
    for (std::size_t e = 0; e < 3; ++e)
      if (leaves_over(line, at[e], at[edge_after(e)], size)) add(piece.face, e, false, line, side);
  }

  void add(Index face, std::size_t edge, bool into, const LitLine& line, int side) {
    // Less than nothing even where the field starts with more.
    const double height = far_away * std::max(line.length, 1e-6 * sigma_);
    Plane left = line.at(line.first.s, line.first.h), right = line.at(line.last.s, line.last.h);
    if (side == 1) std::swap(left, right);
    lights_.push_back({face, edge, into, line.at(line.length / 2, -height), left, right,
                       sigma_ - height + yields * std::max(line.length, 1.), number_});
  }

  std::vector<CurveSeeds::Light>& lights_;
  double sigma_;
  Index number_;
  double longest_ = 0;
  std::vector<double> start_;
  std::vector<LinePoint> first_, last_;
};

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

void CurveSeeds::add_curve(const TriangleMesh<double>& mesh, std::span<const CurvePiece> pieces,
                           double offset, Index number) {
  const double sigma = offset / mesh.unit();
  Lighting lighting(lights_, sigma, number);
  for (int side = 0; side < 2; ++side) lighting.light(mesh, pieces, side);
  // A foot yields to the light: it stands in for it in the one triangle that has both sides.
  const double shade = 2 * yields * std::max(lighting.longest(), 1.);
  for (const CurvePiece& piece : pieces) {
    const TriangleRecord<double>& t = mesh.triangles()[piece.face];
    const auto at = corners_of(t);
    if (piece.edge == 3) {
      const Plane centre = (at[0] + at[1] + at[2]) / 3.;
      const Plane foot = nearest_point(piece, centre);
      feet_.push_back(
          {piece.face, foot, sigma + shade, sigma + shade + std::abs(foot - centre), number});
    }
    for (std::size_t i = 0; i < 3; ++i) {
      const double d = std::abs(nearest_point(piece, at[i]) - at[i]);
      corners_.push_back({t.corner[i], sigma + (d > tolerance * std::abs(at[1]) ? d : 0), number});
    }
  }
}

void CurveSeeds::add_face(const TriangleMesh<double>& mesh, Index face, double offset,
                          Index number) {
  const auto [f, turned] = mesh.inside_face(face);
  const TriangleRecord<double>& t = mesh.triangles()[f];
  const double sigma = offset / mesh.unit();
  const auto at = corners_of(t);
  feet_.push_back({f, (at[0] + at[1] + at[2]) / 3., sigma, sigma, number});
  for (std::size_t e = 0; e < 3; ++e) {
    const CurvePiece piece{f, e, at[e], at[edge_after(e)], 0};
    corners_.push_back({t.corner[e], sigma, number});
    if (piece.length() > 1e-12)
      Lighting(lights_, sigma, number).light(mesh, std::span(&piece, 1), 1);
  }
}

}  // namespace plexway::detail
