#pragma once

#include <array>

#include <plexway/apps/read_out.hpp>
#include <plexway/complex/triangle_mesh.hpp>

#include "apps/solved.hpp"
#include "apps/surface_labels.hpp"

namespace plexway {

/// Distances of points inside triangles, from the labels that Visibility::saddles left. Numbers and
/// unit inside, arithmetic in double.
template <class Real>
class SurfaceReadOut {
 public:
  using Posed = typename SurfaceLabels<Real>::Posed;
  using Point = typename Posed::Point;

  SurfaceReadOut(const TriangleMesh<Real>& mesh, const Solved<Real>& solved)
      : mesh_(mesh), triangles_(mesh.triangles()), solved_(solved), labels_(mesh, solved) {}

  [[nodiscard]] double at(Index f, const std::array<double, 3>& weight, ReadOut level) const;
  /// Unit direction away from the source at the centre of a reached triangle: along its edge 0 and
  /// off it. 0 where the source is there.
  [[nodiscard]] std::array<double, 2> gradient(Index f) const;

 private:
  struct Step {  // from one triangle over its edge `out` to the next, whose edge is `in`
    Index from;
    std::size_t out, in;
    Index to;
    bool flip;
  };
  [[nodiscard]] bool step_over(Index f, std::size_t edge, Step& step) const;
  [[nodiscard]] Point point_over(Index f, std::size_t edge,
                                 const std::array<double, 3>& weight) const;
  [[nodiscard]] Posed turned(Index f, const Posed& label, std::size_t from, std::size_t to,
                             int& pivot) const;
  [[nodiscard]] double own(Index f, const std::array<double, 3>& weight) const;
  [[nodiscard]] double from_where_it_came(const Step& step, const Point& q) const;
  [[nodiscard]] double offered(const Step* steps, int count, const Point& q) const;

  const TriangleMesh<Real>& mesh_;
  std::span<const TriangleRecord<Real>> triangles_;
  const Solved<Real>& solved_;
  SurfaceLabels<Real> labels_;
};

extern template class SurfaceReadOut<float>;
extern template class SurfaceReadOut<double>;

}  // namespace plexway
