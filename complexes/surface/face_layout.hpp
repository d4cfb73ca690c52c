#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <plexway/common/ids.hpp>

#include "complexes/common/building_blocks.hpp"
#include "complexes/surface/gluing.hpp"

namespace plexway::detail {

class TriangleShapes;

/// The faces of a surface as they lie in memory: numbered inside, vertices named by their first
/// use, glued, and turned so that neighbours run opposite ways wherever that is possible. What a
/// TriangleMesh's records say but for their shapes, in 28 bytes a face.
class FaceLayout {
 public:
  FaceLayout() = default;
  using Triples = Unfilled<std::array<Index, 3>>;
  /// `order` lists all faces. Glued where two corners share both vertices, which in each face are
  /// three. Unless they `may_turn` faces stay as they are, and neighbours may run the same way.
  FaceLayout(std::size_t vertices, Faces faces, std::vector<Index> order, int threads,
             bool may_turn = true);
  /// Glued as `across` says.
  FaceLayout(std::size_t vertices, Faces faces, std::vector<Index> order,
             std::span<const std::array<Index, 3>> across, int threads);
  /// The same with all in this order already: corners by the caller's vertices, halfedges packed as
  /// Across without its marks, or none.
  FaceLayout(std::size_t vertices, std::vector<Index> order, Triples corners, Triples gluing,
             int threads);

  std::vector<Index> face;   ///< the caller's, of each inside
  Triples corner;            ///< vertices inside
  Triples across;            ///< packed as Across; face_count() on a boundary
  std::vector<char> turned;  ///< empty if none is
  std::vector<Index> vertex_to_inside;
  std::vector<Index> face_to_inside;
  std::vector<Index> first_use;  ///< vertices named before each block of faces: tell_vertices
  std::size_t named = 0;         ///< vertices of faces; the others are behind them
  std::size_t edges = 0, boundary_edges = 0, non_manifold_edges = 0;
  bool orientable = true;
  bool flips = false;  ///< is Across::flip set anywhere?

  /// Edges that their triangles measure differently become like those with more than two: neither
  /// is unfolded over. Returns how many. `check` may refuse two faces, by the caller's numbers,
  /// with the lengths they give an edge, and the ratio of the longest to the shortest edge of the
  /// more slender one.
  using RefractionCheck = void (*)(std::size_t face, std::size_t other, double length,
                                   double other_length, double aspect);
  std::size_t mark_refraction(const TriangleShapes& shapes, RefractionCheck check, int threads);

  [[nodiscard]] std::size_t face_count() const { return face.size(); }
  [[nodiscard]] std::size_t vertex_count() const { return vertex_to_inside.size(); }
  /// The caller's vertices, by their numbers inside.
  [[nodiscard]] std::vector<Index> vertices_outside(int threads) const;
  [[nodiscard]] bool is_turned(std::size_t inside) const {
    return !turned.empty() && turned[inside] != 0;
  }

 private:
  void number_faces(int threads);
  void take_gluing(std::size_t vertices, int threads);
  void name_vertices(std::size_t vertices);
  void orient();
};

/// The layout of a surface given by coordinates, in `order` or, where that is empty, along a curve.
/// Throws InputError as TriangleMesh's constructor says.
FaceLayout lay_out(std::span<const std::array<double, 3>> positions, Faces faces,
                   std::span<const Index> order, int threads);

}  // namespace plexway::detail
