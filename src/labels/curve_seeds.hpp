#pragma once

#include <algorithm>
#include <array>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <plexway/source/point_source.hpp>
#include <plexway/surface/triangle_mesh.hpp>

#include "kernel/lanes.hpp"

namespace plexway::detail {

/// A point of the plane of a triangle: corner 0 at the origin, edge 0 on the real axis, the rest
/// above it.
using Plane = std::complex<double>;

template <class Real>
std::array<Plane, 3> corners_of(const TriangleRecord<Real>& t) {
  const double second = static_cast<double>(t.length[2]);
  return {
      0, static_cast<double>(t.length[0]),
      Plane{second * static_cast<double>(t.cosine[0]), second * static_cast<double>(t.sine(0))}};
}

inline double cross(const Plane& a, const Plane& b) { return (std::conj(a) * b).imag(); }
inline double dot(const Plane& a, const Plane& b) { return (std::conj(a) * b).real(); }

/// A straight piece of a curve, in one triangle.
struct CurvePiece {
  Index face;
  std::size_t edge;  ///< along this edge, or 3
  Plane from, to;    ///< in the triangle's plane
  std::size_t end;   ///< the point of the curve that `to` is

  [[nodiscard]] double length() const { return std::abs(to - from); }
  [[nodiscard]] Plane direction() const { return (to - from) / length(); }
};

/// The point of a piece that is nearest to another one of its plane.
inline Plane nearest_point(const CurvePiece& piece, const Plane& p) {
  const double s = dot(piece.direction(), p - piece.from);
  return piece.from + std::clamp(s, 0., piece.length()) * piece.direction();
}

/// A curve cut into pieces. Throws UsageError where two points in a row share no triangle.
template <class Real>
std::vector<CurvePiece> cut_curve(const TriangleMesh<Real>& mesh,
                                  std::span<const PointSource> points);

/// Which points of a curve, beside its light, count as sources of their own: its ends, those at
/// vertices, and those where it bends, for beyond a bend neither piece lights anything.
template <class Real>
std::vector<bool> shows_as_point(const TriangleMesh<Real>& mesh,
                                 std::span<const PointSource> points,
                                 std::span<const CurvePiece> pieces);

/// Does the curve run straight on from one piece to the next, as seen from its left (side 0) or
/// right (side 1)? That is: has it pi of surface there.
template <class Real>
bool runs_straight(const TriangleMesh<Real>& mesh, const CurvePiece& piece, const CurvePiece& next,
                   int side);

/// Where a piece ends in its triangle: at corner i (i), inside edge e (3 + e), or inside (6).
template <class Real>
std::size_t place_of(const TriangleRecord<Real>& t, const Plane& p);

/// What curves and triangles on a surface seed labels with. Numbers and unit inside.
///
/// A straight line sends parallel light to both sides. Its virtual source is put 10^7 lengths of
/// the line behind it, at a distance of minus as much: within the width of the line that is the
/// height over it to 2e-8 of the line's length. Its ends are the limits of the label. Where a
/// curve runs straight through several triangles, each has the light of the whole line, up to the
/// saddles beside it.
class CurveSeeds {
 public:
  /// Light over an edge of a triangle: out of it, or into it from beyond.
  struct Light {
    Index face;
    std::size_t edge;
    bool into;
    Plane source, left, right;  ///< in the plane of the triangle
    double sigma;
    Index number;
  };
  /// The point of a curve nearest to the centre of a triangle that it crosses.
  struct Foot {
    Index face;
    Plane at;
    double sigma, distance;
    Index number;
  };
  struct Corner {
    Index vertex;
    double distance;
    Index number;
  };

  /// A curve (its pieces) as propagation number `number`; sigma and the mesh's unit are of
  /// the caller.
  void add_curve(const TriangleMesh<double>& mesh, std::span<const CurvePiece> pieces,
                 double offset, Index number);
  /// All of one triangle.
  void add_face(const TriangleMesh<double>& mesh, Index face, double offset, Index number);

  /// To the labels.
  template <class Rule, class Front>
  void seed(Rule rule, Front& front) const {
    for (const Foot& foot : feet_) {
      if (!(foot.distance < rule.to_beat(foot.face))) continue;
      front.accept(foot.face, 0,
                   {kernel::Lanes<double>(foot.at.real(), foot.sigma, 0, 0),
                    kernel::Lanes<double>(-foot.at.imag(), foot.distance, 0, 0)},
                   foot.distance, foot.number);
    }
    for (const Light& light : lights_) seed_light(rule, light);
  }

  /// The corners of triangles that a curve passes, exactly: offer(vertex, distance, number).
  template <class Offer>
  void offer_corners(const Offer& offer) const {
    for (const Corner& corner : corners_) offer(corner.vertex, corner.distance, corner.number);
  }

  /// Does the curve with this number run through the triangle's inside? To be asked after `sort`;
  /// any number will do where there is a single source.
  [[nodiscard]] bool crosses(Index number, Index face) const {
    if (!is_crossed_[face]) [[likely]]
      return false;
    return single_ || std::binary_search(crossed_.begin(), crossed_.end(), std::pair(face, number));
  }
  /// After the last curve. `single`: there is one source only.
  void sort(std::size_t faces, bool single) {
    is_crossed_.assign(faces + 1, 0);
    for (const Foot& foot : feet_) {
      is_crossed_[foot.face] = 1;
      crossed_.emplace_back(foot.face, foot.number);
    }
    std::sort(crossed_.begin(), crossed_.end());
    single_ = single;
  }

 private:
  template <class Rule>
  static void seed_light(Rule& rule, const Light& light) {
    const auto corner = corners_of(rule.triangle(light.face));
    const std::size_t e = light.edge;
    const double length = std::abs(corner[edge_after(e)] - corner[e]);
    if (!(length > 0)) return;
    const Plane along = (corner[edge_after(e)] - corner[e]) / length;
    const auto posed = [&](const Plane& p) {
      const Plane q = std::conj(along) * (p - corner[e]);
      return typename Rule::Point{{light.into ? q.real() : length - q.real()},
                                  light.into ? -q.imag() : q.imag()};
    };
    typename Rule::Posed p;
    p.source = posed(light.source);
    p.limit[0] = posed(light.left);
    p.limit[1] = posed(light.right);
    p.sigma = light.sigma;
    if (light.into)
      rule.enter_posed(light.face, e, p, light.number);
    else
      rule.cross_posed(light.face, e, p, -1, true, light.number);
  }

  std::vector<Light> lights_;
  std::vector<Foot> feet_;
  std::vector<Corner> corners_;
  bool single_ = false;
  std::vector<std::uint8_t> is_crossed_;
  std::vector<std::pair<Index, Index>> crossed_;  ///< triangle, number
};

}  // namespace plexway::detail
