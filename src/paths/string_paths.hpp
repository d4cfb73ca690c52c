#pragma once

#include <array>

#include <plexway/fields/read_out.hpp>
#include <plexway/paths/path.hpp>
#include <plexway/solid/tet_mesh.hpp>
#include <plexway/source/point_source.hpp>

#include "paths/solved.hpp"
#include "paths/straight_walk.hpp"
#include "strings/solid_strings.hpp"

namespace plexway::detail {

/// The tetrahedra of a solid in space, as lines cross them. Numbers and frame inside.
template <class Real>
struct TetSpace {
  const TetMesh<Real>& mesh;

  [[nodiscard]] std::array<Index, 4> corners(Index t) const {
    return std::to_array(mesh.tets()[t].corner);
  }
  [[nodiscard]] const strings::Point& point(Index v) const { return mesh.points()[v]; }
  [[nodiscard]] bool may_cross(Index) const { return true; }
  [[nodiscard]] std::vector<Index> around(Index t, const std::array<double, 4>& weight) const;
};

/// Paths, and distances of points, in a solid in space: the strings that a solve left in the
/// workspace, to vertices and to points of tetrahedra. Tetrahedra have the numbers inside.
template <class Real>
class StringPaths {
 public:
  StringPaths(const TetMesh<Real>& mesh, const Solved<Real>& solved)
      : mesh_(mesh), solved_(solved), strings_(solved.workspace.strings.get()), walk_({mesh}) {}

  /// The way from a point back to its source, cut where it goes from tetrahedron to tetrahedron.
  /// Empty where none leads.
  [[nodiscard]] Path trace(const PointSource& point) const;
  /// In the solid's unit.
  [[nodiscard]] double at(Index t, const std::array<double, 4>& weight, ReadOut level) const;
  /// Unit direction away from the source at the centre; 0 where that is there, or it is
  /// unreachable.
  [[nodiscard]] std::array<double, 3> gradient(Index t) const;
  /// The nearest source to the centre; none where unreachable.
  [[nodiscard]] Index source(Index t) const;

 private:
  using Point = strings::Point;

  [[nodiscard]] Path cut(const SolidStrings::Found& found, std::vector<Index> tets) const;

  const TetMesh<Real>& mesh_;
  const Solved<Real>& solved_;
  const SolidStrings* strings_;  // none where a field is only read between vertices
  StraightWalk<TetSpace<Real>> walk_;
};

extern template class StringPaths<float>;
extern template class StringPaths<double>;

}  // namespace plexway::detail
