#pragma once

#include <array>
#include <span>
#include <vector>

#include <plexway/complex/tet_mesh.hpp>

namespace plexway {

/// A solid in space, in double, and straight lines through it. Tetrahedra and vertices have the
/// numbers inside.
template <class Real>
class SolidWalk {
 public:
  using Point = Vector3<double>;
  using Barycentric = std::array<double, 4>;

  /// In the caller's unit: from the caller's positions where there are some, else from those that
  /// propagation uses (about the middle of the solid).
  SolidWalk(const TetMesh<Real>& mesh, std::span<const std::array<double, 3>> positions,
            std::span<const Index> outer)
      : mesh_(mesh), positions_(positions), outer_(outer) {}

  [[nodiscard]] Point vertex(Index v) const {
    if (!positions_.empty()) {
      const auto& p = positions_[outer_[v]];
      return {p[0], p[1], p[2]};
    }
    const Vector3<Real>& p = mesh_.points()[v];
    const double u = mesh_.unit();
    return {u * static_cast<double>(p.x), u * static_cast<double>(p.y),
            u * static_cast<double>(p.z)};
  }
  [[nodiscard]] Point place(Index t, const Barycentric& b) const;
  [[nodiscard]] Barycentric barycentric(Index t, const Point& p) const;

  /// A part of a line, from `begin` to `end` of its length, in one tetrahedron.
  struct Step {
    Index tet;
    double begin, end;
  };
  struct Walk {
    bool arrived = false;
    Index tet = none;  ///< where it ends
  };

  /// From p, which lies in one of `from`, straight to q, as long as that is in the closed solid.
  /// Lines may run along its boundary; they may be off by 1e-9 of a tetrahedron. `steps`, if not
  /// null, tells the way. Each step gets on, so it ends. Cost: 0.2 us a tetrahedron.
  Walk walk(std::span<const Index> from, const Point& p, const Point& q,
            std::vector<Step>* steps = nullptr) const;

  /// All tetrahedra at a point of t that are joined by faces there.
  void around(Index t, const Point& at, std::vector<Index>& tets) const;

  [[nodiscard]] const TetMesh<Real>& mesh() const { return mesh_; }

  static constexpr double tolerance = 1e-9;

 private:
  /// Up to where does the line from p to q stay in t, which it is in at `at`? And by which face
  /// does it leave. 1: it ends there.
  double leaves(Index t, const Point& p, const Point& q, double at, Index& face) const;

  const TetMesh<Real>& mesh_;
  std::span<const std::array<double, 3>> positions_;
  std::span<const Index> outer_;
};

}  // namespace plexway
