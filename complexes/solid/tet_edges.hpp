#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <plexway/common/ids.hpp>
#include <plexway/solid/detail/tet_record.hpp>

#include "complexes/solid/tet_gluing.hpp"

namespace plexway::detail {

/// Four corners of a tetrahedron in space.
using TetPoints = std::array<Vector3<double>, 4>;

/// What is at edges and vertices of a solid whose tetrahedra are in positive order.
struct TetTopology {
  struct PinchedEdge {
    std::array<Index, 2> vertex;
    Index begin, end;  ///< in pinched_edge_tets
  };
  struct Reflex {
    std::array<Index, 2> vertex;
    bool crack = false;  ///< do both faces at it lie on each other?
    double angle = 0;    ///< of solid around; found where tetrahedra have a pose each
  };
  std::vector<Reflex> reflex;
  std::vector<PinchedEdge> pinched_edges;
  std::vector<Index> pinched_edge_tets;
  std::vector<Index> pinched_vertices;
  std::size_t reflex_vertices = 0;
};

/// Where the corners of tetrahedra are, in units of about an edge: all in one frame by their
/// vertices, or each tetrahedron in its own.
struct TetPlaces {
  std::span<const Vector3<double>> vertex;
  std::span<const TetPoints> posed;  ///< empty if in one frame

  [[nodiscard]] bool embedded() const { return posed.empty(); }
  [[nodiscard]] TetPoints of(std::size_t tet, const std::array<Index, 4>& corner) const {
    if (!embedded()) return posed[tet];
    return {vertex[corner[0]], vertex[corner[1]], vertex[corner[2]], vertex[corner[3]]};
  }
};

/// From corners and across (4 u + j, or none) of each tetrahedron. The same by any number of
/// threads.
TetTopology find_tet_topology(std::span<const std::array<Index, 4>> corner,
                              std::span<const std::array<Index, 4>> across,
                              const TetCorners& corners, const TetPlaces& places, int threads);

}  // namespace plexway::detail
