#pragma once

#include <array>
#include <span>
#include <vector>

#include <plexway/solid/tet_mesh.hpp>

namespace plexway {

/// Straight lines through the tetrahedra of a solid in space, in double. Tetrahedra and vertices
/// have the numbers inside, and points are in the frame inside (TetMesh::points).
template <class Real>
class SolidWalk {
 public:
  using Point = Vector3<double>;
  using Barycentric = std::array<double, 4>;

  explicit SolidWalk(const TetMesh<Real>& mesh) : mesh_(mesh) {}

  [[nodiscard]] Point vertex(Index v) const {
    const Vector3<Real>& p = mesh_.points()[v];
    return {static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)};
  }
  [[nodiscard]] Barycentric barycentric(Index t, const Point& p) const;

  /// A part of a line, from `begin` to `end` of its length, in one tetrahedron.
  struct Step {
    Index tet;
    double begin, end;
  };

  /// From p, which lies in one of `from`, straight to q, as long as that is in the closed solid.
  /// Lines may run along its boundary, and be off by 1e-9 (float 1e-5) of a tetrahedron; by more,
  /// to 1e-2, where they do not arrive else. Each step gets on, so it ends. False if it did not
  /// arrive. Cost: 0.2 us a tetrahedron.
  bool walk(std::span<const Index> from, const Point& p, const Point& q,
            std::vector<Step>* steps) const;

  /// All tetrahedra at a point of t: those joined by faces there, and those that have its vertex or
  /// edge, where they may only touch.
  void all_at(Index t, const Point& at, std::vector<Index>& tets) const;

 private:
  static constexpr double finest = sizeof(Real) == 4 ? 1e-5 : 1e-9, coarsest = 1e-2;

  bool walk(std::span<const Index> from, const Point& p, const Point& q, double tolerance,
            std::vector<Step>* steps) const;
  void around(Index t, const Point& at, std::vector<Index>& tets) const;
  /// Up to where does the line from p to q stay in t, which it is in at `at`? And by which face
  /// does it leave. 1: it ends there.
  double leaves(Index t, const Point& p, const Point& q, double at, double tolerance,
                Index& face) const;

  const TetMesh<Real>& mesh_;
};

}  // namespace plexway
