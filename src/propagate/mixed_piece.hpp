#pragma once

#include <cstddef>
#include <limits>
#include <span>

#include <plexway/complex/mixed_complex.hpp>
#include <plexway/propagate/distance_field.hpp>
#include <plexway/propagate/options.hpp>
#include <plexway/propagate/workspace.hpp>
#include <plexway/source/point_source.hpp>

namespace plexway {

/// A virtual source posed on a hinge between two pieces, in the domain's unit: its foot in the
/// frame of the hinge (vertex 0 the origin, vertex 1 on the x axis, vertex 2 at y > 0), its height,
/// and the way to it.
template <class Real>
struct PosedSource {
  Real x, y, h, sigma;
  Index source;
};

/// One piece of a mixed domain while it is propagated on: what the pieces must know of each other.
/// Numbers are those inside the piece, distances are in the domain's unit.
template <class Real>
class MixedPiece {
 public:
  using Member = typename MixedComplex<Real>::Member;

  MixedPiece() = default;
  MixedPiece(const MixedPiece&) = delete;
  MixedPiece& operator=(const MixedPiece&) = delete;
  virtual ~MixedPiece() = default;

  /// The caller's numbers in the piece.
  virtual void seed(const PointSource& source, Index number) = 0;
  /// Until no label waits or `budget` expansions are spent. Throws Cancelled.
  virtual void run(std::size_t budget) = 0;

  /// K = 0: the best path to a vertex, and its source; and such a path from another piece. False
  /// if nothing got better by it.
  struct Found {
    Real distance;
    Index source;
  };
  virtual Found at_vertex(Index vertex) = 0;
  virtual bool enter_vertex(Index vertex, Real distance, Index source) = 0;

  /// K = 1, 2. `distance` is that of a simplex's centre, +inf where unreached. `ring` is the
  /// hinge's place among those of dimension 1 of this piece.
  virtual Real distance(Index) const = 0;
  virtual PosedSource<Real> leave(const Member&, int dimension) const = 0;
  virtual bool enter(const Member&, int dimension, const PosedSource<Real>&, Index ring) = 0;
  /// K = 1 into a solid: paths from one source may pass the hinge's line from x = low to high.
  /// Gives the `ring` to enter with.
  virtual Index open_ring(const Member&, Real, Real) { return none; }
  /// Nothing was accepted with the ring opened last.
  virtual void close_ring() {}

  /// One a vertex, in the caller's order.
  virtual void read_out(std::span<Real> distance, std::span<Index> label) = 0;
  /// No vertex is farther than a neighbour and the edge between. True if some vertex got nearer.
  virtual bool relax(std::span<Real>, std::span<Index>) { return false; }
  [[nodiscard]] virtual PropagateStatistics statistics() const = 0;
  [[nodiscard]] virtual bool out_of_budget() const = 0;

 protected:
  /// By more than rounding: else offers would go to and fro for ever.
  static bool gains(Real known, Real offer) {
    return offer < known * (1 - 64 * std::numeric_limits<Real>::epsilon());
  }

  // Between the domain's unit in the caller's order and what is read out inside.
  template <class Complex>
  static void take_out(const Complex& complex, const Workspace<Real>& workspace,
                       std::span<Real> distance, std::span<Index> label) {
    const std::span<const Index> inside = complex.vertices_inside();
    for (std::size_t v = 0; v < inside.size(); ++v) {
      distance[v] = workspace.vertex[inside[v]] * static_cast<Real>(complex.unit());
      label[v] = workspace.vertex_source[inside[v]];
    }
  }
  /// `relax` on the distances as they are in the domain by now; only what got nearer changes.
  template <class Complex, class Relax>
  static bool relax_with(const Complex& complex, Workspace<Real>& workspace,
                         std::span<Real> distance, std::span<Index> label, Relax relax) {
    const std::span<const Index> inside = complex.vertices_inside();
    const Real unit = static_cast<Real>(complex.unit());
    for (std::size_t v = 0; v < inside.size(); ++v) {
      workspace.vertex[inside[v]] = distance[v] / unit;
      workspace.vertex_source[inside[v]] = label[v];
    }
    if (!relax()) return false;
    bool any = false;
    for (std::size_t v = 0; v < inside.size(); ++v) {
      const Real d = workspace.vertex[inside[v]] * unit;
      if (!(d < distance[v])) continue;
      distance[v] = d;
      label[v] = workspace.vertex_source[inside[v]];
      any = true;
    }
    return any;
  }
};

}  // namespace plexway
