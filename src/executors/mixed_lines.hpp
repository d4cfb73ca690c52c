#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include <plexway/mixed/mixed_complex.hpp>
#include <plexway/solve/distance_field.hpp>
#include <plexway/source/point_source.hpp>

#include "complexes/mixed/joined_pieces.hpp"
#include "labels/straight_lines.hpp"

namespace plexway {

/// Where the pieces of a mixed domain lie, if that is in one space and at their own size: then no
/// path is shorter than the straight line.
template <class Real>
class MixedPlaces {
 public:
  explicit MixedPlaces(const MixedComplex<Real>& domain) : domain_(domain) {
    if (!lie_in_space()) at_.clear();
  }

  /// Distances below the line from every source get its length, +inf beyond the radius. Returns how
  /// many were by more than 1e-4. Cost: linear.
  std::size_t raise(std::span<const PointSource> sources, double radius,
                    DistanceField<Real>& field) const {
    if (at_.empty()) return 0;
    std::vector<SourcePlace> places;
    for (const PointSource& source : sources) places.push_back({place(source), source.offset});
    const StraightLines<Real> lines(at_, places);
    std::size_t raised = 0;
    for (std::size_t v = 0; v < at_.size(); ++v) {
      Real& d = field.distance[v];
      const Real least = lines.raised(v, d, field.label.empty() ? 0 : field.label[v]);
      raised += d < least * Real(1 - 1e-4);
      d = least;
      if (static_cast<double>(d) <= radius) continue;
      d = std::numeric_limits<Real>::infinity();
      if (!field.label.empty()) field.label[v] = none;
    }
    return raised;
  }

 private:
  using Piece = typename MixedComplex<Real>::Piece;
  static constexpr double rounding = sizeof(Real) == 4 ? 1e-5 : 1e-9;

  static double apart(const Point3& p, const Point3& q) {
    return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
  }

  bool lie_in_space() {
    double extent = 0;
    outer_.resize(domain_.vertex_count());
    for (const Piece& piece : domain_.pieces()) {
      const auto own = domain_.positions(piece);
      if (own.empty()) return false;
      at_.insert(at_.end(), own.begin(), own.end());
      for (const Point3& p : own) extent = std::max(extent, apart(p, at_.front()));
      std::visit(
          [&](const auto& complex) {
            for (Index v = 0; v < piece.vertices; ++v)
              outer_[piece.first_vertex + complex.inside_vertex(v)] = piece.first_vertex + v;
          },
          domain_.complex(piece));
    }
    for (const auto& [v, w] : domain_.outer_welds())
      if (apart(at_[v], at_[w]) > 1e-9 * extent) return false;
    const auto fits = [&](const Piece& piece) {
      return std::visit([&](const auto& complex) { return is_at_size(piece, complex); },
                        domain_.complex(piece));
    };
    return std::all_of(domain_.pieces().begin(), domain_.pieces().end(), fits);
  }
  [[nodiscard]] const Point3& inside(const Piece& piece, Index vertex) const {
    return at_[outer_[piece.first_vertex + vertex]];
  }

  bool is_at_size(const Piece& piece, const TetMesh<Real>& solid) const {
    const auto own = domain_.positions(piece);
    const std::vector<Point3> places = places_of(solid, own);
    return std::equal(places.begin(), places.end(), own.begin(), own.end());
  }
  bool is_at_size(const Piece& piece, const TriangleMesh<Real>& surface) const {
    for (const auto& t : surface.triangles().first(surface.face_count()))
      for (std::size_t i = 0; i < 3; ++i) {
        const double there =
                         apart(inside(piece, t.corner[i]), inside(piece, t.corner[(i + 1) % 3])),
                     here = static_cast<double>(t.length[i]) * surface.unit();
        if (!(std::abs(here - there) <= rounding * (there + surface.unit()))) return false;
      }
    return true;
  }
  bool is_at_size(const Piece& piece, const Wireframe<Real>& wires) const {
    for (Index e = 0; e < piece.simplices; ++e) {
      const auto ends = wires.inside_edge(e);
      const double there = apart(inside(piece, ends.from), inside(piece, ends.to));
      if (!(static_cast<double>(ends.length) * wires.unit() >= there * (1 - rounding)))
        return false;
    }
    return true;
  }

  [[nodiscard]] Point3 place(const PointSource& source) const {
    if (source.vertex != none) return at_[source.vertex];
    for (const Piece& piece : domain_.pieces())
      if (source.simplex - piece.first_simplex < piece.simplices)
        return std::visit(
            [&](const auto& complex) {
              return place(piece, complex, source.simplex - piece.first_simplex,
                           source.barycentric);
            },
            domain_.complex(piece));
    return at_.front();
  }
  template <class Corners>
  [[nodiscard]] Point3 weighted(const Piece& piece, const Corners& corner,
                                const std::array<double, 4>& b) const {
    Point3 at = {0, 0, 0};
    for (std::size_t i = 0; i < std::size(corner); ++i)
      for (std::size_t k = 0; k < 3; ++k) at[k] += b[i] * inside(piece, corner[i])[k];
    return at;
  }
  Point3 place(const Piece& piece, const TetMesh<Real>& solid, Index simplex,
               std::array<double, 4> b) const {
    const auto [t, turned] = solid.inside_tet(simplex);
    if (turned) std::swap(b[2], b[3]);
    return weighted(piece, solid.tets()[t].corner, b);
  }
  Point3 place(const Piece& piece, const TriangleMesh<Real>& surface, Index simplex,
               std::array<double, 4> b) const {
    const auto [f, turned] = surface.inside_face(simplex);
    if (turned) std::swap(b[1], b[2]);
    return weighted(piece, surface.triangles()[f].corner, b);
  }
  Point3 place(const Piece& piece, const Wireframe<Real>& wires, Index simplex,
               const std::array<double, 4>& b) const {
    const auto ends = wires.inside_edge(simplex);
    return weighted(piece, std::array{ends.from, ends.to}, b);
  }

  const MixedComplex<Real>& domain_;
  std::vector<Point3> at_;    // in the domain's numbers
  std::vector<Index> outer_;  // by piece and the number inside
};

}  // namespace plexway
