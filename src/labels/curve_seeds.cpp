#include "labels/curve_seeds.hpp"

#include <algorithm>
#include <cmath>

namespace plexway::detail {
namespace {

constexpr double far_away = 1e7;  // lengths of a line that its virtual source is behind it
// What light yields to the points at its ends, in units or lengths of the line, whichever is more:
// beyond the ends both offer the same distance, and a point is seen from more sides. It is more
// than rounding does to light.
constexpr double yields = 1e-7;
constexpr double seed_tolerance = 1e-9;

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
  if (!(last - first > seed_tolerance * size)) return false;
  const auto height = [&](double s) { return p.h + (q.h - p.h) * (s - p.s) / (q.s - p.s); };
  return std::min(height(first), height(last)) >= -seed_tolerance * size;
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

  /// The longest line lit so far.
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
      corners_.push_back(
          {t.corner[i], sigma + (d > seed_tolerance * std::abs(at[1]) ? d : 0), number});
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
