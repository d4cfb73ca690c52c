#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <plexway/solid/tet_mesh.hpp>
#include <plexway/surface/triangle_mesh.hpp>
#include <plexway/wireframe/wireframe.hpp>

namespace plexway {

/// A simplex at a shared face, and which of its corners are the face's vertices.
struct SharedMember {
  Index simplex;
  std::array<std::uint8_t, 3> corner;
  bool in_larger = false;  ///< of an edge: this simplex has a shared triangle there
};

/// An edge or a triangle that two welded complexes both have, with the simplices at it.
struct SharedFace {
  std::uint8_t dimension;  ///< 1 or 2
  bool contained;          ///< an edge of a shared triangle
  std::vector<SharedMember> members[2];
};

struct SharedFaces {
  std::vector<SharedFace> faces;
  std::vector<char> vertex_contained;  ///< one a pair: part of a shared edge or triangle
};

/// `pairs` are the welded vertices (of a, of b), numbers inside, sorted. A wireframe keeps what it
/// knows at its vertices, so that with one of them only vertices are shared.
/// Cost: linear in the simplices, n log n in what is shared.
template <class A, class B>
SharedFaces find_shared_faces(const A& a, const B& b, std::span<const std::array<Index, 2>> pairs);

}  // namespace plexway
