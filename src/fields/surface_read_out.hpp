#pragma once

#include <array>
#include <optional>

#include <plexway/fields/read_out.hpp>
#include <plexway/surface/triangle_mesh.hpp>

#include "fields/surface_labels.hpp"
#include "fields/window_read_out.hpp"
#include "paths/solved.hpp"

namespace plexway::detail {

/// Distances of points inside triangles, from the labels that Visibility::saddles left. Numbers and
/// unit inside, arithmetic in double.
template <class Real>
class SurfaceReadOut {
 public:
  using Posed = typename SurfaceLabels<Real>::Posed;
  using Point = typename Posed::Point;

  SurfaceReadOut(const TriangleMesh<Real>& mesh, const Solved<Real>& solved)
      : mesh_(mesh), triangles_(mesh.triangles()), solved_(solved), labels_(mesh, solved) {
    if (solved.windows) windows_.emplace(mesh, solved);
  }

  [[nodiscard]] double at(Index f, const std::array<double, 3>& weight, ReadOut level) const;
  /// Where the straight line from a point of f, not on the rim, back to the source leads: a place
  /// in f, which is the point itself where the source is there. Nothing where unreachable.
  [[nodiscard]] std::optional<std::array<double, 3>> towards(
      Index f, const std::array<double, 3>& weight) const;

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
  std::optional<WindowReadOut<Real>> windows_;
};

extern template class SurfaceReadOut<float>;
extern template class SurfaceReadOut<double>;

}  // namespace plexway::detail
