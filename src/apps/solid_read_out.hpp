#pragma once

#include <array>
#include <cstddef>
#include <limits>

#include <plexway/apps/read_out.hpp>
#include <plexway/complex/tet_mesh.hpp>

#include "apps/solved.hpp"
#include "propagate/solid_rule.hpp"

namespace plexway {

/// Distances of points inside tetrahedra, from the labels that Visibility::saddles left in a solid
/// in space. Numbers and unit inside.
template <class Real>
class SolidReadOut {
 public:
  using Point = Vector3<Real>;

  SolidReadOut(const TetMesh<Real>& mesh, const Solved<Real>& solved)
      : mesh_(mesh), solved_(solved), front_{solved}, rule_(mesh, front_) {}

  [[nodiscard]] double at(Index t, const std::array<double, 4>& weight, ReadOut level) const;
  /// Unit direction away from the source at the centre of a reached tetrahedron; 0 where the source
  /// is there.
  [[nodiscard]] std::array<double, 3> gradient(Index t) const;

 private:
  // The front that the solve left, for a rule that only reads.
  struct Known {
    const Solved<Real>& solved;
    [[nodiscard]] bool reached(Index t) const { return solved.workspace.marks.reached(t); }
    [[nodiscard]] std::size_t hinge(Index t) const { return solved.workspace.marks.hinge(t); }
    [[nodiscard]] const SolidLabel<Real>& label(Index t) const {
      return solved.workspace.solids.labels[t];
    }
    [[nodiscard]] Index source(Index t) const { return solved.source_of(t); }
    void put(Index, const SolidLabel<Real>&) {}
  };

  const TetMesh<Real>& mesh_;
  const Solved<Real>& solved_;
  Known front_;
  SolidRule<Real, Known> rule_;
};

extern template class SolidReadOut<float>;
extern template class SolidReadOut<double>;

}  // namespace plexway
