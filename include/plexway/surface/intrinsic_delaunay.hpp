#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include <plexway/common/rows_of.hpp>
#include <plexway/source/point_source.hpp>
#include <plexway/surface/triangle_mesh.hpp>

namespace plexway {

/// The shape of the triangles of a surface, as far as it matters to distances.
struct TriangulationShape {
  std::size_t inner_edges = 0;  ///< with two triangles
  std::size_t non_delaunay_edges =
      0;                      ///< the angles opposite exceed 180 degrees, by rounding at least
  double smallest_angle = 0;  ///< degrees
  double largest_angle = 0;   ///< degrees
  double blunt_share = 0;     ///< of triangles with an angle above 150 degrees
  double needle_share = 0;    ///< of triangles with an angle below 5 degrees

  /// Share of the inner edges that are not Delaunay.
  [[nodiscard]] double non_delaunay_share() const {
    return inner_edges > 0
               ? static_cast<double>(non_delaunay_edges) / static_cast<double>(inner_edges)
               : 0;
  }
};

/// Measures it. Cost: linear, about 10 ns a triangle.
template <class Real>
[[nodiscard]] TriangulationShape measure_triangulation(const TriangleMesh<Real>& mesh);

/// What to do about a triangulation before distances are propagated on it.
enum class Retriangulation {
  keep,    ///< nothing pays
  flips,   ///< the intrinsic Delaunay triangulation of the vertices
  refined  ///< that, with more vertices
};

/// What pays, by measured shape: flips if more than 4 % of the inner edges are not Delaunay,
/// refinement as well if more than one triangle in ten has an angle below 5 degrees
/// (docs/contributing/methods/surfaces.md measures it).
[[nodiscard]] Retriangulation what_pays(const TriangulationShape& shape);

/// The flips and new vertices that led there.
struct DelaunaySummary {
  /// Edges flipped.
  std::size_t flips = 0;
  std::size_t stuck_edges = 0;  ///< not Delaunay, and could not be flipped: see IntrinsicDelaunay
  /// By refinement.
  std::size_t inserted_vertices = 0;
};

/// How far to refine: vertices are put in until no angle is smaller, or there are enough.
struct Refinement {
  /// Degrees, less than 60; 0: not at all. Up to 28 it mostly ends by itself; vertices close to a
  /// boundary may keep it going down to `shortest_edge`.
  double smallest_angle = 0;
  /// So many new vertices at most, as a share of those there are; 0 or more, and finite. The
  /// largest triangles come first.
  double most_vertices = 0.25;
  /// Edges shorter than this, in mean edges, are left alone; 0 or more.
  double shortest_edge = 1e-3;

  /// What pays where refinement pays at all: a quarter more vertices where triangles are worst.
  static Refinement moderate() { return {.smallest_angle = 20}; }
};

/// That for `refined`, none for the others.
[[nodiscard]] Refinement refinement_for(Retriangulation wanted);

template <class Real>
struct TriangulatedSurface;

/// Builds a surface from coordinates on the triangles that pay (what_pays), or those wanted,
/// without a mesh of the others: the same as
///
/// @code
///   TriangleMesh<Real> mesh(positions, faces);
///   IntrinsicDelaunay delaunay(TriangleMesh<double>(positions, faces), refinement_for(...));
///   mesh = delaunay.mesh<Real>();
///
/// @endcode
/// in a third of the time. `threads` as SurfaceHints::threads. Throws InputError as TriangleMesh
/// does.
template <class Real>
[[nodiscard]] TriangulatedSurface<Real> triangulate(
    const GivenPoints& positions, const GivenSimplices<3>& faces,
    std::optional<Retriangulation> wanted = std::nullopt, int threads = 0);

/// The intrinsic Delaunay triangulation of a surface: other triangles over the same vertices in
/// the same metric, such that the two angles opposite to an inner edge never exceed 180 degrees.
///
/// @code
///   TriangleMesh<double> input(positions, faces);
///   IntrinsicDelaunay delaunay(input);
///   auto mesh = delaunay.mesh<float>();
///   auto field = solve(Serial{}, mesh, delaunay.to_intrinsic(PointSource::in(17, b)));
///
/// @endcode
/// Vertices keep their numbers, so distances at vertices need no translation. Triangles do not:
/// those that no flip touched have the number they had, each other has that of some triangle. Two
/// vertices may share several edges, and a triangle may be glued to itself. Edges with one triangle
/// or more than two stay. Areas, and the angles around each vertex, stay but for rounding.
///
/// Flips in any order lead there, and end (Indermitte, Liebling, Troyanov, Clemencon: Voronoi
/// diagrams on piecewise flat surfaces and an application to biological growth, 2001; Bobenko,
/// Springborn: A discrete Laplace-Beltrami operator for simplicial surfaces, 2007). What rounding
/// might do to that is bounded: an edge counts as Delaunay up to a tolerance, 1e-11 rad (1e-5 if
/// the input is float), which doubles for each 16 flips of a slot beyond 4096, so that no slot is
/// flipped more than 4700 times. Always the same result for the same input.
///
/// Stuck edges are a curiosity of surfaces that are not orientable: the flip would make a loop (an
/// edge from a vertex to itself) of which a Delta-complex does not know on which side it is glued.
class IntrinsicDelaunay {
 public:
  /// Cost: a few flips a vertex at most on usual meshes, 0.1 us each, and 0.1 us a triangle;
  /// quadratic at worst. Memory while it lives: 120 bytes a triangle, 64 a flip.
  ///
  /// With a refinement, circumcentres of bad triangles become vertices, numbered after the input's,
  /// or middles of boundary edges that are in between (Chew: Guaranteed-quality mesh generation for
  /// curved surfaces, 1993; on intrinsic triangulations Sharp, Soliman, Crane: Navigating intrinsic
  /// triangulations, 2019, section 4.2). Throws UsageError for one that is out of range. Flips are
  /// one thread's work; meshes are made by `threads`, as SurfaceHints::threads.
  template <class Real>
  explicit IntrinsicDelaunay(const TriangleMesh<Real>& input, const Refinement& refinement = {},
                             int threads = 0);
  /// Moves the triangulation; what is left may be assigned to or destroyed, no more.
  IntrinsicDelaunay(IntrinsicDelaunay&&) noexcept;
  /// Likewise.
  IntrinsicDelaunay& operator=(IntrinsicDelaunay&&) noexcept;
  ~IntrinsicDelaunay();

  /// The triangulation, in the input's unit.
  template <class Real>
  [[nodiscard]] TriangleMesh<Real> mesh(
      const SaddleThresholds& saddles = SaddleThresholds::standard()) const;
  /// Once the meshes wanted are made: frees what they were made from, 96 bytes a triangle and more.
  /// mesh() then throws UsageError; points are mapped as before.
  void release_triangles();
  /// The flips and new vertices.
  [[nodiscard]] const DelaunaySummary& summary() const;
  /// Bytes held.
  [[nodiscard]] std::size_t bytes() const;

  /// The place that a vertex, or a point of an input triangle, has in the triangulation. Exact to
  /// rounding. Throws UsageError for a triangle that does not exist. Cost: the flips that its
  /// triangles went through, mostly a few.
  [[nodiscard]] PointSource to_intrinsic(const PointSource& point) const;
  /// And back: the place of a point of the triangulation, or of a vertex that was put in, in the
  /// input's triangles.
  /// Throws UsageError for a triangle that does not exist. Cost: as there.
  [[nodiscard]] PointSource to_input(const PointSource& point) const;

  /// A straight line in one triangle of the triangulation, as straight lines in triangles of the
  /// input: from the first of each to the second.
  struct Piece {
    Index face;  ///< of the input
    ///@{
    /// Barycentric coordinates in that triangle.
    std::array<double, 3> from, to;
    ///@}
  };
  /// Between two points of a triangle, in barycentric coordinates; the pieces come in order.
  /// Throws UsageError for a triangle that does not exist. Cost: as there, for each piece.
  [[nodiscard]] std::vector<Piece> line_to_input(Index face, const std::array<double, 3>& from,
                                                 const std::array<double, 3>& to) const;

 private:
  template <class Real>
  friend TriangulatedSurface<Real> triangulate(const GivenPoints& positions,
                                               const GivenSimplices<3>& faces,
                                               std::optional<Retriangulation> wanted, int threads);
  friend struct detail::KeptParts;
  IntrinsicDelaunay();

  struct State;
  std::unique_ptr<State> state_;
};

/// A surface on the triangles that it is solved on.
template <class Real>
struct TriangulatedSurface {
  /// The input's triangles, or the others.
  TriangleMesh<Real> mesh;
  /// Translates points where other triangles than the input's were taken; its own are released.
  std::optional<IntrinsicDelaunay> delaunay;
  /// The flips and new vertices.
  Retriangulation done = Retriangulation::keep;
};

}  // namespace plexway
