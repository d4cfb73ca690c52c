#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <plexway/common/detail/storage.hpp>
#include <plexway/common/ids.hpp>
#include <plexway/common/rows_of.hpp>
#include <plexway/domain/concept.hpp>
#include <plexway/surface/detail/triangle_record.hpp>

namespace plexway {

namespace detail {
class FaceLayout;
struct KeptParts;
class TriangleShapes;
}  // namespace detail
class IntrinsicDelaunay;

/// The counts of a surface, made while it is built.
struct SurfaceSummary {
  /// Referenced or not: as many as were given.
  std::size_t vertices = 0;
  /// Triangles.
  std::size_t faces = 0;
  /// Of triangles, each once, however many triangles share it.
  std::size_t edges = 0;
  /// With one triangle only.
  std::size_t boundary_edges = 0;
  std::size_t non_manifold_edges = 0;     ///< more than two triangles
  std::size_t pinched_vertices = 0;       ///< several fans of triangles meet there only
  std::size_t unreferenced_vertices = 0;  ///< in no triangle: unreachable
  std::size_t degenerate_faces = 0;       ///< no area, in the input's precision
  std::size_t violated_faces = 0;  ///< lengths broke the triangle inequality (see the constructor)
  std::size_t refracting_edges = 0;  ///< with another length on either side (SurfaceHints)
  std::size_t components = 0;        ///< of triangles joined by edges or pinched vertices
  /// Can all triangles be turned so that neighbours agree which side is up?
  bool orientable = true;
  double mean_edge = 0;  ///< in the input's unit; the library works in this unit inside
};

/// Which vertices paths may bend at: where the angle around exceeds 2 pi, or on a boundary pi, by
/// more than rounding and chance. In radians.
struct SaddleThresholds {
  /// Less than this more than 2 pi may be rounding of the coordinates: it counts only where the
  /// neighbours agree. However finely a smooth surface is cut, they do
  double interior;
  double boundary;  ///< less more than pi. A smooth arc is made of many that each count a little
  /// A smooth surface is cut into triangles with chance: every other vertex has a little more than
  /// 2 pi around. So a vertex counts if it and its neighbours have more than flat in sum, or by
  /// what it has more than this share of what its neighbours lack, on average,
  double noise_share;
  double most_noise;  ///< but no neighbours make nothing of what is much by itself
  /// Neighbours agree where the sum of their excess, each counted up to the vertex's own, is more
  /// than this share of what it would be if all had one sign.
  double agreement;

  /// docs/log/tuning.md says how they were found.
  static SaddleThresholds standard();
};

/// A straight line on a surface between two vertices, which need not be an edge: an edge of other
/// triangles over the same surface.
struct SurfaceChord {
  ///@{
  /// Its ends, the caller's numbers.
  Index from, to;
  ///@}
  /// In the input's unit.
  double length;
};

/// What the maker of a surface knows better than the constructor.
struct SurfaceHints {
  /// All faces, as they should lie in memory; empty: the constructor looks for an order.
  std::span<const Index> order = {};
  /// The vertices are samples of something smooth, and how the triangles bend at one of them is
  /// half chance: paths bend at an inner vertex only where its neighbourhood is a saddle, too.
  bool samples = false;
  /// Each triangle keeps the lengths given for it, also where a neighbour measures the edge between
  /// differently, as where a speed jumps: paths are refracted there.
  bool refracts = false;
  /// Where the first vertices lie in space, if lengths are given and are such that no path is
  /// shorter than the straight line. (Coordinates given as such need not be repeated.)
  std::span<const std::array<double, 3>> positions = {};
  /// Lines known besides edges: no vertex will be farther than the other end and the line between.
  std::span<const SurfaceChord> chords = {};
  /// Which vertices paths may bend at.
  SaddleThresholds saddles = SaddleThresholds::standard();
  /// That build it; 0: as many as the machine has. The result does not depend on it.
  int threads = 0;
};

/// A triangle surface as a metric space: triangles with edge lengths, glued along edges.
///
/// A Delta-complex: what counts is which halfedge is glued to which, so two vertices may share
/// several edges and a triangle may be glued to itself. Boundary, several components, more than two
/// triangles on an edge, non-orientable surfaces, unreferenced vertices, triangles without area and
/// edges without length are all allowed. Immutable once built, so any number of threads may read
/// it.
///
/// Vertices and faces have the caller's numbers in this interface. Inside they are reordered for
/// locality. Memory: 68 bytes a triangle and 8 a vertex in float, 32 a vertex with coordinates.
template <class Real>
class TriangleMesh {
  static_assert(is_number_of_domains<Real>, "distances are float or double");

 public:
  /// The precision of lengths inside, and of fields.
  using Number = Real;
  /// A surface.
  static constexpr DomainKind kind = DomainKind::surface;
  /// Of its simplices.
  static constexpr int dimension = 2;

  /// From coordinates. Shapes: n positions in any unit, m triangles of vertex indices < n.
  /// Throws InputError naming the vertex or face for a coordinate that is not finite, an index out
  /// of range, the same vertex twice in a face, no face, or more than 2^28 - 2 faces.
  /// Cost: linear, about 0.2 us a face on one thread; memory for a while is somewhat more with
  /// several.
  ///
  /// Arrays of any kind will do (Given): std::vector<std::array<float, 3>>, Eigen's matrices,
  /// numbers in a row.
  TriangleMesh(const GivenPoints& positions, const GivenSimplices<3>& faces,
               const SurfaceHints& hints = {});

  /// From intrinsic lengths: lengths[f][i] is the length of the edge from corner i of face f to the
  /// next (metric::triangle_edges), and must be the same from both sides (but for 1e-5, of which
  /// the mean is taken; InputError). Triangles are glued where two corners share both vertices. An
  /// edge longer than the way around by the other two is shortened to it, and so on
  /// (SurfaceSummary::violated_faces counts). Throws as above, and for a length that is negative or
  /// not finite. With SurfaceHints::refracts each triangle keeps its own lengths (and is shortened
  /// alone), edges with two are SurfaceSummary::refracting_edges.
  TriangleMesh(std::size_t vertices, const GivenSimplices<3>& faces,
               const Given<std::array<double, 3>>& lengths, const SurfaceHints& hints = {});

  /// From lengths and an explicit gluing, as intrinsic triangulations need: across[f][i] is the
  /// halfedge 3 g + j that edge i of face f is glued to, or `none`. More than two triangles on an
  /// edge form a cycle. Throws as above, and when the gluing is not a set of cycles.
  TriangleMesh(std::size_t vertices, std::span<const std::array<Index, 3>> faces,
               std::span<const std::array<double, 3>> lengths,
               std::span<const std::array<Index, 3>> across, const SurfaceHints& hints = {});

  /// From triangles whose angles are known as well as their lengths, laid out and glued: for makers
  /// inside the library, which answer for all of it. Throws only for a length that is not finite.
  TriangleMesh(detail::FaceLayout&& layout, const detail::TriangleShapes& shapes,
               const SurfaceHints& hints);

  /// n, referenced or not: fields have one distance each.
  [[nodiscard]] std::size_t vertex_count() const { return vertex_to_inside_.size(); }
  /// m, the triangles.
  [[nodiscard]] std::size_t face_count() const { return triangles_.size() - 1; }
  /// The same: triangles are a surface's simplices.
  [[nodiscard]] std::size_t simplex_count() const { return face_count(); }
  /// Refracting where an edge has another length on either side.
  [[nodiscard]] MetricKind metric() const {
    return summary_.refracting_edges > 0 ? MetricKind::refracting : MetricKind::intrinsic;
  }
  /// Its counts, made while it was built.
  [[nodiscard]] const SurfaceSummary& summary() const { return summary_; }
  /// Bytes this complex holds.
  [[nodiscard]] std::size_t bytes() const;

  // What follows serves the layers above and uses the numbers inside.
  /// @name For the layers above
  ///@{

  /// The records, and one sentinel behind them that stands for "no triangle".
  [[nodiscard]] std::span<const detail::TriangleRecord<Real>> triangles() const {
    return triangles_;
  }
  /// The number inside of a vertex, which must be one (not checked).
  [[nodiscard]] Index inside_vertex(Index vertex) const { return vertex_to_inside_[vertex]; }
  /// The second is true if its corners run backwards here.
  [[nodiscard]] std::pair<Index, bool> inside_face(Index face) const {
    if (face >= face_to_inside_.size()) return {none, false};
    const Index inside = face_to_inside_[face];
    return {inside, (triangles_[inside].face & detail::reversed) != 0};
  }
  /// The number inside of each vertex, in the caller's order.
  [[nodiscard]] std::span<const Index> vertices_inside() const { return vertex_to_inside_; }
  /// Corners 3 f + i at a vertex, all fans.
  void corners_at(Index inside_vertex, std::vector<Index>& corners) const;
  /// One corner 3 f + i at a vertex, or none.
  [[nodiscard]] Index corner_at(Index inside_vertex) const {
    return corner_of_vertex_[inside_vertex];
  }
  /// Vertices (inside) where several fans meet, ascending.
  [[nodiscard]] std::span<const Index> pinched() const { return pinched_; }
  /// One unit inside, in the input's: the mean edge.
  [[nodiscard]] double unit() const { return summary_.mean_edge; }
  /// Where vertices (inside) lie in space, in units of the mean edge and about some origin; NaN
  /// where that is not known. Empty where it has none: intrinsic lengths, or a metric.
  [[nodiscard]] std::span<const std::array<double, 3>> positions() const { return positions_; }
  /// Are triangles flat in space, with their corners at `positions`?
  [[nodiscard]] bool faces_are_in_space() const { return in_space_; }
  /// Ends of the chords at a vertex, all inside.
  struct ChordEnd {
    /// The other end.
    Index vertex;
    /// In units of the mean edge.
    Real length;
  };
  /// The chords at a vertex (inside) by their other ends; empty if there are none.
  [[nodiscard]] std::span<const ChordEnd> chords_at(Index inside_vertex) const {
    if (chords_.empty()) return {};
    return std::span(chords_).subspan(
        chord_begin_[inside_vertex], chord_begin_[inside_vertex + 1] - chord_begin_[inside_vertex]);
  }
  /// Does it have any?
  [[nodiscard]] bool has_chords() const { return !chords_.empty(); }
  /// Of the content: a copy has the same, everything else another (Identity).
  [[nodiscard]] std::uint64_t identity() const { return identity_.value(); }
  ///@}

 private:
  friend struct detail::KeptParts;
  friend class IntrinsicDelaunay;
  TriangleMesh() = default;

  void assemble(detail::FaceLayout layout, const detail::TriangleShapes& shapes,
                const SurfaceHints& hints);
  std::vector<double> take_shapes(const detail::TriangleShapes& shapes,
                                  std::span<const Index> first_use, int threads);
  void place(std::span<const std::array<double, 3>> positions, int threads);
  void take_chords(std::span<const SurfaceChord> chords);

  SurfaceSummary summary_;
  detail::Identity identity_;
  detail::Rows<detail::TriangleRecord<Real>, detail::Unfilled<detail::TriangleRecord<Real>>>
      triangles_;
  detail::Rows<Index> vertex_to_inside_;
  detail::Rows<Index> face_to_inside_;
  detail::Rows<Index> corner_of_vertex_;  // one corner a vertex (inside), or none
  // Vertices whose corners one walk around cannot find: pinched, or on a non-manifold edge.
  detail::Rows<Index> irregular_, irregular_begin_, irregular_corners_;
  detail::Rows<Index> pinched_;
  detail::Rows<std::array<double, 3>> positions_;
  bool in_space_ = false;
  detail::Rows<Index> chord_begin_;  // a row a vertex, each chord in two of them
  detail::Rows<ChordEnd> chords_;
};

/// Of the numbers that the points are: float, or double.
template <detail::AnyRows Points, detail::AnyRows Faces>
TriangleMesh(const Points&, const Faces&, const SurfaceHints& = {})
    -> TriangleMesh<detail::NumberOf<Points>>;

extern template class TriangleMesh<float>;
extern template class TriangleMesh<double>;

}  // namespace plexway
