#pragma once

#include <algorithm>
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

/// What is known of a solid before its edges are looked at.
struct TetSolid {
  using Corners = std::span<const std::array<Index, 4>>;
  Corners corner, across;
  const TetCorners& corners;
  const TetPlaces& places;
  std::span<const char> on_boundary;  ///< vertices

  [[nodiscard]] std::size_t vertices() const { return corners.vertices(); }
  [[nodiscard]] TetPoints points(std::size_t t) const { return places.of(t, corner[t]); }
  [[nodiscard]] std::span<const Index> corners_at(Index v) const { return corners.at(v); }
};

/// Which corner of a tetrahedron a vertex of it is.
inline Index corner_of(const std::array<Index, 4>& corner, Index vertex) {
  return static_cast<Index>(corner[1] == vertex) | static_cast<Index>(corner[2] == vertex) * 2 |
         static_cast<Index>(corner[3] == vertex) * 3;
}

/// Is one of a tetrahedron's faces on the boundary? `none` is the highest number.
inline bool has_boundary(const std::array<Index, 4>& across) {
  return std::max(std::max(across[0], across[1]), std::max(across[2], across[3])) == none;
}

/// Fans of tetrahedra around the edges from some vertices to higher ones: where more than pi of
/// solid is around an edge, and where its tetrahedra are not all joined by faces there. Where all
/// is in one frame only the boundary's edges are looked at, as paths bend nowhere else.
class TetEdgeFans {
 public:
  /// What was found, by the ends of edges in ascending order.
  struct Found {
    std::vector<TetTopology::Reflex> reflex;
    std::vector<TetTopology::PinchedEdge> pinched;  ///< into `pinched_tets`
    std::vector<Index> pinched_tets;
  };

  explicit TetEdgeFans(const TetSolid& solid)
      : solid_(solid), degree_(solid.vertices(), 0), embedded_(solid.places.embedded()) {}
  /// Of the vertices from `first` to `last`. Cost: linear in their tetrahedra.
  Found look(Index first, Index last);

 private:
  // A fan of tetrahedra around an edge to `end` starts at a boundary face of one of them and leaves
  // that by another.
  struct Start {
    Index end, tet, enter, leave;
  };
  void look_at(Index v);
  bool look_at_boundary(Index v);
  void around_edge(Index a, Index b, std::span<const Start> starts);
  [[nodiscard]] std::vector<Index> tets_around(Index a, Index b) const;
  std::size_t walk(const Start& start, Index a, Index b);
  [[nodiscard]] bool is_reflex(Index a, Index b) const;
  [[nodiscard]] double dihedral_at(Index t, Index a, Index b) const;
  void closed(Index a, Index b, std::span<const Index> around);
  [[nodiscard]] bool is_crack(Index from, Index to) const;

  const TetSolid& solid_;
  std::vector<Index> degree_;  // tetrahedra around the edge to each vertex
  bool embedded_;
  std::vector<Index> ends_;
  std::vector<Start> starts_;
  std::vector<Index> fan_ends_;  // of the fans around an edge, boundary faces 4 t + k
  std::vector<Index> apexes_;    // vertices around the edge, of the fan being walked
  std::vector<Index> fan_;       // its tetrahedra
  Found found_;
};

}  // namespace plexway::detail
