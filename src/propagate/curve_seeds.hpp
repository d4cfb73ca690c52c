#pragma once

#include <array>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <plexway/complex/triangle_mesh.hpp>
#include <plexway/propagate/saddle_label.hpp>
#include <plexway/source/point_source.hpp>

namespace plexway {

/// A point of the plane of a triangle: corner 0 at the origin, edge 0 on the real axis, the rest
/// above it.
using Plane = std::complex<double>;

/// What curves and triangles on a surface seed it with. Numbers and unit inside.
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

  /// A curve as propagation number `number`; sigma and the mesh's unit are of the caller. Throws
  /// UsageError where a point shares no triangle with the next. Points are checked already.
  template <class Real>
  void add_curve(const TriangleMesh<Real>& mesh, std::span<const PointSource> points, double offset,
                 Index number);
  /// All of one triangle.
  template <class Real>
  void add_face(const TriangleMesh<Real>& mesh, Index face, double offset, Index number);

  /// To the labels, by a rule with limits.
  template <class Rule, class Front>
  void seed(Rule rule, Front& front) const {
    using Label = typename Rule::Label;
    for (const Foot& foot : feet_) {
      using Real = decltype(Label{}.sigma());
      const Real d = static_cast<Real>(foot.distance);
      if (!(d < rule.to_beat(foot.face))) continue;
      const Real x = static_cast<Real>(foot.at.real()), y = static_cast<Real>(foot.at.imag());
      front.accept(foot.face, 0,
                   Label{kernel::Lanes<Real>(x, static_cast<Real>(foot.sigma), 0, 0),
                         kernel::Lanes<Real>(-y, d, 0, 0)},
                   d, foot.number);
    }
    for (const Light& light : lights_) seed_light(rule, light);
  }

  /// The corners of triangles that a curve passes, exactly: offer(vertex, distance, number).
  template <class Offer>
  void offer_corners(const Offer& offer) const {
    for (const Corner& corner : corners_) offer(corner.vertex, corner.distance, corner.number);
  }

  /// Which triangles a curve crosses, 1 or 0 for each of `faces`.
  [[nodiscard]] std::vector<std::uint8_t> crossed(std::size_t faces) const {
    std::vector<std::uint8_t> crossed(faces + 1, 0);
    for (const Foot& foot : feet_) crossed[foot.face] = 1;
    return crossed;
  }

  [[nodiscard]] bool empty() const { return feet_.empty() && lights_.empty(); }

 private:
  template <class Rule>
  static void seed_light(Rule& rule, const Light& light) {
    const auto& t = rule.triangle(light.face);
    const Plane corner[3] = {0,
                             static_cast<double>(t.length[0]),
                             {static_cast<double>(t.apex_x(0)), static_cast<double>(t.apex_h(0))}};
    const std::size_t e = light.edge;
    const double length = std::abs(corner[edge_after(e)] - corner[e]);
    if (!(length > 0)) return;
    const Plane along = (corner[edge_after(e)] - corner[e]) / length;
    using Posed = typename Rule::Posed;
    using Point = typename Rule::Point;
    const auto posed = [&](const Plane& p) {
      const Plane q = std::conj(along) * (p - corner[e]);
      using Number = std::remove_cvref_t<decltype(Point{}.h)>;
      const double x = light.into ? q.real() : length - q.real();
      const double h = light.into ? -q.imag() : q.imag();
      return Point{{static_cast<Number>(x)}, static_cast<Number>(h)};
    };
    Posed p;
    p.source = posed(light.source);
    p.limit[0] = posed(light.left);
    p.limit[1] = posed(light.right);
    p.sigma = static_cast<decltype(p.sigma)>(light.sigma);
    if (light.into)
      rule.enter_posed(light.face, e, p, light.number);
    else
      rule.cross_posed(light.face, e, p, -1, true, light.number);
  }

  std::vector<Light> lights_;
  std::vector<Foot> feet_;
  std::vector<Corner> corners_;
};

}  // namespace plexway
