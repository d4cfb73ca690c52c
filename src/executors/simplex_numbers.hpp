#pragma once

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include <plexway/solid/tet_mesh.hpp>
#include <plexway/source/point_source.hpp>
#include <plexway/surface/triangle_mesh.hpp>

#include "complexes/common/arrays.hpp"

namespace plexway::detail {

/// A field that goes on from what is there. What is known stays, and each new source is propagated
/// only where it is nearer than those before. Numbers and unit inside. Cost of a source: what it
/// reaches; nothing is read out.
template <class Complex>
class Growth;

/// Weights of a simplex's corners: barycentric coordinates.
using Weights = std::array<double, 4>;

/// Points of simplices between the caller's numbers and those inside, many of them: tables are made
/// once. Vertices, too.
template <class Complex>
class SimplexNumbers {
 public:
  explicit SimplexNumbers(const Complex& complex) : vertex_(vertices_outside(complex)) {
    list(complex);
  }

  [[nodiscard]] Index outside_vertex(Index inside) const { return vertex_[inside]; }
  /// A point of simplex s in the caller's numbers.
  [[nodiscard]] PointSource outside(Index s, Weights w) const {
    if (outside_[s] & turned) turn(w);
    return {.simplex = outside_[s] & ~turned, .barycentric = w};
  }
  [[nodiscard]] std::pair<Index, Weights> inside(const PointSource& point) {
    if (inside_.empty()) {
      inside_.resize(outside_.size());
      for (Index s = 0; s < outside_.size(); ++s) inside_[outside_[s] & ~turned] = s;
    }
    Weights w = point.barycentric;
    const Index s = inside_[point.simplex];
    if (outside_[s] & turned) turn(w);
    return {s, w};
  }

 private:
  static constexpr Index turned = Index{1} << 31;

  template <class Real>
  void list(const TriangleMesh<Real>& mesh) {
    static_assert(reversed == turned);
    outside_.resize(mesh.face_count());
    for (Index f = 0; f < outside_.size(); ++f) outside_[f] = mesh.triangles()[f].face;
    first_ = 1;
  }
  template <class Real>
  void list(const TetMesh<Real>& mesh) {
    outside_.resize(mesh.tet_count());
    for (Index t = 0; t < outside_.size(); ++t) {
      const auto [at, is_turned] = mesh.inside_tet(t);
      outside_[at] = is_turned ? t | turned : t;
    }
    first_ = 2;
  }
  void turn(Weights& w) const { std::swap(w[first_], w[first_ + 1]); }

  std::vector<Index> vertex_, outside_, inside_;
  std::size_t first_ = 1;  // of the two corners that are exchanged where it is turned
};

}  // namespace plexway::detail
