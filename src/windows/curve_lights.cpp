#include "windows/window_sources.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace plexway::detail::windows {
namespace {

/// Of an edge, or as a sine: less is nothing.
constexpr double least = 1e-12;

/// The places of an edge where a + b s >= 0, within what is left of it.
void clip(double a, double b, double& begin, double& end) {
  if (b > 0)
    begin = std::max(begin, -a / b);
  else if (b < 0)
    end = std::min(end, -a / b);
  else if (a < 0)
    end = begin;
}

}  // namespace

template <class Real>
void CurveLights::add_curve(const TriangleMesh<Real>& mesh, std::span<const CurvePiece> pieces,
                            double offset, Index number) {
  const double sigma = offset / mesh.unit();
  for (const CurvePiece& piece : pieces) {
    const TriangleRecord<Real>& t = mesh.triangles()[piece.face];
    const std::array<Plane, 3> at = corners_of(t);
    if (piece.edge < 3) {
      const Index edge = static_cast<Index>(piece.edge);
      const double from = std::abs(piece.from - at[edge]), to = std::abs(piece.to - at[edge]);
      const Beam<double> beam = {0, -1, std::min(from, to), std::max(from, to)};
      for (const bool into : {false, true})
        lights.push_back({piece.face, edge, into, beam, sigma, number});
      continue;
    }
    const double length = piece.length();
    for (const Plane& up : {piece.direction() * Plane(0, 1), piece.direction() * Plane(0, -1)}) {
      for (Index e = 0; e < 3; ++e) {
        const Plane edge = at[edge_after(e)] - at[e];
        const double width = std::abs(edge);
        if (!(width > 0)) continue;
        const Plane unit = edge / width;
        const double along = dot(up, unit), off = cross(up, unit);
        if (!(off > least)) continue;
        const double foot = dot(piece.direction(), at[e] - piece.from);
        const double go_on = dot(piece.direction(), unit), height = dot(up, at[e] - piece.from);
        double begin = 0, end = static_cast<double>(t.length[e]);
        clip(foot, go_on, begin, end);
        clip(length - foot, -go_on, begin, end);
        clip(height, along, begin, end);
        if (end - begin > least * width)
          lights.push_back(
              {piece.face, e, false, parallel(along, off, begin, end), sigma + height, number});
      }
    }
    for (Index i = 0; i < 3; ++i) {
      const Plane back = nearest_point(piece, at[i]) - at[i];
      const double d = std::abs(back), width = std::abs(at[edge_after(i)] - at[i]);
      if (!(d > 0) || !(width > 0)) continue;  // where the curve passes it is a point of its own
      const Plane unit = (at[edge_after(i)] - at[i]) / width;
      corners.push_back(
          {piece.face, i, sigma + d, {dot(back, unit), std::max(cross(unit, back), 0.)}, number});
    }
  }
}

template <class Real>
void CurveLights::add_face(const TriangleMesh<Real>& mesh, Index face, double offset,
                           Index number) {
  const auto [f, turned] = mesh.inside_face(face);
  const TriangleRecord<Real>& t = mesh.triangles()[f];
  for (Index e = 0; e < 3; ++e)
    if (t.length[e] > 0)
      lights.push_back({f,
                        e,
                        false,
                        {0, -1, 0, static_cast<double>(t.length[e])},
                        offset / mesh.unit(),
                        number});
}

template void CurveLights::add_curve(const TriangleMesh<float>&, std::span<const CurvePiece>,
                                     double, Index);
template void CurveLights::add_curve(const TriangleMesh<double>&, std::span<const CurvePiece>,
                                     double, Index);
template void CurveLights::add_face(const TriangleMesh<float>&, Index, double, Index);
template void CurveLights::add_face(const TriangleMesh<double>&, Index, double, Index);

}  // namespace plexway::detail::windows
