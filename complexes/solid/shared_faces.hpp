#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <plexway/solid/detail/tet_record.hpp>
#include <plexway/solid/tet_mesh.hpp>
#include <plexway/surface/triangle_mesh.hpp>
#include <plexway/wireframe/wireframe.hpp>

namespace plexway::detail {

/// A simplex at a shared face, and which of its corners are the face's vertices.
struct SharedMember {
  Index simplex;
  std::array<std::uint8_t, 3> corner;
};

/// An edge or a triangle that two welded complexes both have, with the simplices at it.
struct SharedFace {
  bool inner;                  ///< an edge of a shared triangle
  std::array<Index, 3> pairs;  ///< the places of its vertices, the last none for an edge
  std::vector<SharedMember> members[2];

  [[nodiscard]] std::uint8_t dimension() const { return pairs[2] == none ? 1 : 2; }
};

/// Triangles first. `pairs` are the welded vertices (of a, of b), numbers inside, sorted. A
/// wireframe keeps what it knows at its vertices, so that with one of them only vertices are
/// shared. Cost: linear in the simplices, n log n in what is shared.
template <class A, class B>
std::vector<SharedFace> find_shared_faces(const A& a, const B& b,
                                          std::span<const std::array<Index, 2>> pairs);

/// The faces that one tetrahedron alone has, anticlockwise as seen from outside, ordered by their
/// vertices. `corner(t, i)` is a vertex of tetrahedron t; `inverted(t)` if its corners are in
/// negative order. Cost: n log n.
template <class Corner, class Inverted>
std::vector<std::array<Index, 3>> outer_faces(std::size_t tets, const Corner& corner,
                                              const Inverted& inverted) {
  using Row = std::array<Index, 3>;
  std::vector<std::pair<Row, Row>> faces;  // sorted, as it is
  faces.reserve(4 * tets);
  for (std::size_t t = 0; t < tets; ++t) {
    const bool other_way = inverted(t);
    for (const auto& [i, j, k] : tet_faces) {
      const Row row = {corner(t, i), corner(t, other_way ? k : j), corner(t, other_way ? j : k)};
      Row sorted = row;
      std::sort(sorted.begin(), sorted.end());
      faces.emplace_back(sorted, row);
    }
  }
  std::sort(faces.begin(), faces.end());
  std::vector<Row> outer;
  for (std::size_t f = 0; f < faces.size();) {
    std::size_t end = f + 1;
    while (end < faces.size() && faces[end].first == faces[f].first) ++end;
    if (end == f + 1) outer.push_back(faces[f].second);
    f = end;
  }
  return outer;
}

}  // namespace plexway::detail
