#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <plexway/complex/ids.hpp>

#include "complex/gluing.hpp"

namespace plexway {

class TriangleShapes;

/// The faces of a surface as they lie in memory: numbered inside, vertices named by their first
/// use, glued, and turned so that neighbours run opposite ways wherever that is possible. What a
/// TriangleMesh's records say but for their shapes, in 28 bytes a face.
class FaceLayout {
 public:
  FaceLayout() = default;
  /// `order` lists all faces. Glued where two corners share both vertices, which in each face are
  /// three.
  FaceLayout(std::size_t vertices, Faces faces, std::vector<Index> order);
  /// Glued as `across` says.
  FaceLayout(std::size_t vertices, Faces faces, std::vector<Index> order,
             std::span<const std::array<Index, 3>> across);
  /// The same with all in this order already: corners by the caller's vertices, halfedges packed as
  /// Across without its marks, or none.
  FaceLayout(std::size_t vertices, std::vector<Index> order,
             std::vector<std::array<Index, 3>> corners, std::vector<std::array<Index, 3>> gluing);

  std::vector<Index> face;                   ///< the caller's, of each inside
  std::vector<std::array<Index, 3>> corner;  ///< vertices inside
  std::vector<std::array<Index, 3>> across;  ///< packed as Across; face_count() on a boundary
  std::vector<char> turned;                  ///< empty if none is
  std::vector<Index> vertex_to_inside;
  std::vector<Index> face_to_inside;
  std::size_t named = 0;  ///< vertices of faces; the others are behind them
  std::size_t edges = 0, boundary_edges = 0, non_manifold_edges = 0;
  bool orientable = true;
  bool flips = false;  ///< is Across::flip set anywhere?

  /// Edges that their triangles measure differently become like those with more than two: neither
  /// is unfolded over. Returns how many. `check` may refuse two faces, by the caller's numbers,
  /// with the lengths they give an edge, and the ratio of the longest to the shortest edge of the
  /// more slender one.
  using RefractionCheck = void (*)(std::size_t face, std::size_t other, double length,
                                   double other_length, double aspect);
  std::size_t mark_refraction(const TriangleShapes& shapes, RefractionCheck check);

  [[nodiscard]] std::size_t face_count() const { return face.size(); }
  [[nodiscard]] std::size_t vertex_count() const { return vertex_to_inside.size(); }
  /// The caller's vertices, by their numbers inside.
  [[nodiscard]] std::vector<Index> vertices_outside() const;
  [[nodiscard]] bool is_turned(std::size_t inside) const {
    return !turned.empty() && turned[inside] != 0;
  }

 private:
  void number_faces();
  void take_gluing(std::size_t vertices);
  void name_vertices(std::size_t vertices);
  void orient();
};

/// The layout of a surface given by coordinates, in `order` or, where that is empty, along a curve.
/// Throws InputError as TriangleMesh's constructor says.
FaceLayout lay_out(std::span<const std::array<double, 3>> positions, Faces faces,
                   std::span<const Index> order = {});

}  // namespace plexway
