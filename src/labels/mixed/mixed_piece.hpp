#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include <plexway/mixed/mixed_complex.hpp>
#include <plexway/solve/distance_field.hpp>
#include <plexway/solve/options.hpp>
#include <plexway/source/point_source.hpp>

#include "labels/mixed/hinge_fermat.hpp"
#include "labels/workspace_state.hpp"

namespace plexway {

/// A virtual source posed on a hinge between two pieces, in the domain's unit: its foot in the
/// frame of the hinge (vertex 0 the origin, vertex 1 on the x axis, vertex 2 at y > 0), its height,
/// and the way to it.
template <class Real>
struct PosedSource {
  Real x, y, h, sigma;
  Index source;
};

template <class Real>
class HingeFront;

/// One piece of a mixed domain while it is propagated on: what the pieces must know of each other.
/// Numbers are those inside the piece, distances are in the domain's unit.
template <class Real>
class MixedPiece {
 public:
  using Member = typename MixedComplex<Real>::Member;
  using Point = Vector3<Real>;

  /// What a path over a hinge that pieces measure differently must gain, of its length: a path that
  /// goes to and fro is then corrected a few times only.
  static constexpr Real crossing_gain = sizeof(Real) == 4 ? Real(1e-5) : Real(1e-7);
  /// So much longer is a path that bends at a vertex of a weld: of two of one length the straight
  /// one wins.
  static constexpr Real bend_loss = sizeof(Real) == 4 ? Real(4e-6) : Real(1e-10);

  MixedPiece() = default;
  MixedPiece(const MixedPiece&) = delete;
  MixedPiece& operator=(const MixedPiece&) = delete;
  virtual ~MixedPiece() = default;

  /// The caller's numbers in the piece.
  virtual void seed(const PointSource& source, Index number) = 0;
  /// Until no nearer label than `horizon` waits or `budget` expansions are spent. Throws Cancelled.
  virtual void run(Real horizon, std::size_t budget) = 0;
  /// No nearer label waits: +inf where none does.
  [[nodiscard]] virtual Real nearest() const = 0;
  /// Nothing waits in any piece: the horizon starts anew.
  virtual void hold() = 0;
  /// Where nothing waits, looks at the whole piece. True if labels wait then.
  virtual bool repair() = 0;
  /// What was expanded since this was emptied, some repeatedly: simplices, of a wireframe vertices.
  [[nodiscard]] std::vector<Index>& expanded() { return expanded_; }

  /// K = 0: the best path to a vertex, and its source; and such a path from another piece. False
  /// if nothing got better by it. A path that `bends` may be of use to some simplices at the vertex
  /// even where the vertex itself gains nothing.
  struct Found {
    Real distance;
    Index source;
  };
  virtual Found at_vertex(Index vertex) = 0;
  virtual bool enter_vertex(Index vertex, Real distance, Index source, bool bends) = 0;

  /// K = 1, 2. `distance` is that of a simplex's centre, +inf where unreached.
  virtual Real distance(Index) const = 0;
  /// The vertex at a simplex's corner.
  virtual Index vertex_of(Index simplex, std::size_t corner) const = 0;
  /// How this piece measures the hinge.
  virtual HingeShape<Real> shape(const Member&, int dimension) const = 0;
  /// The source as a point of the hinge sees it: behind the last bend on the way.
  virtual PosedSource<Real> leave(const Member&, int dimension, const HingePlace<Real>&) const = 0;
  /// A source that is handed on as it is: both pieces measure the hinge alike, and all of the hinge
  /// sees it.
  /// Of an edge on a straight line of them, `line` is where that begins and ends: light into a
  /// surface bends there.
  virtual bool enter(const Member&, int dimension, const PosedSource<Real>&,
                     const std::pair<Real, Real>& line) = 0;
  /// Any other front: a path crosses where it is shortest. A label that starts at the crossing
  /// gets the front's number as its source, and is told to `started`.
  virtual bool enter_front(const Member&, const HingeFront<Real>&, Point& started) = 0;
  /// A point posed on a hinge, and the point at a place of the hinge.
  virtual HingeEnd<Real> pose(const Member&, int, const Point&) const { return {}; }
  virtual Point place(const Member&, int, const HingePlace<Real>&) const { return {}; }
  /// Of the fronts whose crossing simplices around a vertex see straight, the nearest:
  /// `starts(number)` tells where that is.
  virtual Index crossing_seen(Index, const std::function<const Point*(Index)>&) const {
    return none;
  }
  virtual Point place(Index) const { return {}; }
  /// A source in the domain's unit, by the caller's numbers.
  virtual Point place(const PointSource&) const { return {}; }
  /// What a length inside the piece is in the domain's unit.
  [[nodiscard]] virtual Real unit() const { return 1; }
  /// Is a vertex in a straight line from a place of a hinge?
  virtual bool sees(const Member&, int, const HingePlace<Real>&, Index) const { return true; }
  /// Does every point see every other?
  [[nodiscard]] virtual bool sees_all() const { return false; }

  [[nodiscard]] virtual bool is_solid() const { return false; }
  virtual void vertices_around(Index, std::vector<Index>&) const {}

  /// One a vertex, in the caller's order.
  virtual void read_out(std::span<Real> distance, std::span<Index> label) = 0;
  /// No vertex is farther than a neighbour and the edge between. True if some vertex got nearer.
  virtual bool relax(std::span<Real>, std::span<Index>) { return false; }
  [[nodiscard]] virtual PropagateStatistics statistics() const = 0;
  [[nodiscard]] virtual bool out_of_budget() const = 0;

 protected:
  std::vector<Index> expanded_;

  /// By more than rounding: else offers would go to and fro for ever.
  static bool gains(Real known, Real offer) {
    return offer < known * (1 - 64 * std::numeric_limits<Real>::epsilon());
  }

  // Between the domain's unit in the caller's order and what is read out inside.
  template <class Complex>
  static void take_out(const Complex& complex, const WorkspaceState<Real>& workspace,
                       std::span<Real> distance, std::span<Index> label) {
    const std::span<const Index> inside = complex.vertices_inside();
    for (std::size_t v = 0; v < inside.size(); ++v) {
      distance[v] = workspace.vertex[inside[v]] * static_cast<Real>(complex.unit());
      label[v] = workspace.vertex_source[inside[v]];
    }
  }
  /// `relax` on the distances as they are in the domain by now; only what got nearer changes.
  template <class Complex, class Relax>
  static bool relax_with(const Complex& complex, WorkspaceState<Real>& workspace,
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

/// What a label of one piece offers over a hinge: a distance for each point of it.
template <class Real>
class HingeFront {
 public:
  using Piece = MixedPiece<Real>;
  using Member = typename Piece::Member;

  HingeFront(const Piece& from, const Member& member, int of_dimension, Index of_source,
             Index of_front)
      : dimension(of_dimension),
        source(of_source),
        number(of_front),
        shape(from.shape(member, of_dimension)),
        from_(from),
        member_(member) {}

  const int dimension;
  const Index source;  ///< the caller's
  const Index number;  ///< of this front: the source of labels that start on the hinge
  const HingeShape<Real> shape;

  [[nodiscard]] PosedSource<Real> seen_from(const HingePlace<Real>& b) const {
    return from_.leave(member_, dimension, b);
  }
  [[nodiscard]] Real distance(const HingePlace<Real>& b) const {
    const PosedSource<Real> eye = seen_from(b);
    const auto p = shape.place(b);
    return eye.sigma + std::sqrt((p[0] - eye.x) * (p[0] - eye.x) + (p[1] - eye.y) * (p[1] - eye.y) +
                                 eye.h * eye.h);
  }

  /// The shortest path to a point beyond, posed as a piece with the hinge's shape `to` has it.
  struct Path {
    HingePlace<Real> crossing;
    Real before, extent;  ///< to the crossing, and all of it
  };
  [[nodiscard]] Path shortest(const HingeShape<Real>& to, const HingeEnd<Real>& target) const {
    const HingeFermat<Real> fermat(shape, to, dimension);
    const HingePlace<Real> middle = dimension == 1 ? HingePlace<Real>{Real(0.5), 0}
                                                   : HingePlace<Real>{Real(1) / 3, Real(1) / 3};
    Path best = {middle, 0, std::numeric_limits<Real>::infinity()};
    PosedSource<Real> eye = seen_from(middle);
    // Where the path bends before the hinge the eye depends on the crossing. Whatever is taken is
    // a path.
    for (int i = 0; i < 4; ++i) {
      const HingePlace<Real> b = fermat.crossing({eye.x, eye.y, eye.h}, target);
      const PosedSource<Real> seen = seen_from(b);
      const Real extent = seen.sigma + fermat.way({seen.x, seen.y, seen.h}, target, b);
      if (!(extent < best.extent)) break;
      const auto p = shape.place(b);
      best = {b,
              seen.sigma + std::sqrt((p[0] - seen.x) * (p[0] - seen.x) +
                                     (p[1] - seen.y) * (p[1] - seen.y) + seen.h * seen.h),
              extent};
      if (seen.x == eye.x && seen.y == eye.y && seen.h == eye.h) break;
      eye = seen;
    }
    return best;
  }

  /// If all of the hinge sees one source: that.
  [[nodiscard]] bool is_one_source(PosedSource<Real>& eye) const {
    constexpr Real close = sizeof(Real) == 4 ? Real(1e-5) : Real(1e-10);
    eye = seen_from(dimension == 1 ? HingePlace<Real>{Real(0.5), 0}
                                   : HingePlace<Real>{Real(1) / 3, Real(1) / 3});
    const Real size =
        close * (std::abs(eye.x) + std::abs(eye.y) + eye.h + eye.sigma + shape.length);
    for (int corner = 0; corner <= dimension; ++corner) {
      const PosedSource<Real> seen =
          seen_from({corner == 1 ? Real(1) : Real(0), corner == 2 ? Real(1) : Real(0)});
      if (!(std::abs(seen.x - eye.x) <= size && std::abs(seen.y - eye.y) <= size &&
            std::abs(seen.h - eye.h) <= size && std::abs(seen.sigma - eye.sigma) <= size))
        return false;
    }
    return true;
  }

 private:
  const Piece& from_;
  const Member& member_;
};

}  // namespace plexway
