#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <plexway/common/ids.hpp>

#include "complexes/cloud/umbrella.hpp"

namespace plexway::detail {

/// Triangles thrown together one by one, and at each place the wedges of its tangent plane that
/// they take.
class SheetWedges {
 public:
  using Triangle = std::array<Index, 3>;
  /// A triangle as one of its corners has it.
  struct Wedge {
    Index a, b, next, triangle;
  };

  SheetWedges(const Places& places, std::span<const TangentFrame> frames, const SheetRule& rule)
      : places_(places),
        frames_(frames),
        rule_(rule),
        head_(places.at.size(), none),
        unpaired_(head_.size(), 0) {}

  [[nodiscard]] std::span<const Triangle> triangles() const { return triangles_; }
  void reserve(std::size_t triangles);
  void add(const Triangle& t);
  void remove(Index triangle);
  [[nodiscard]] std::size_t place_count() const { return head_.size(); }
  [[nodiscard]] bool used(Index place) const { return head_[place] != none; }
  /// Places that came after the constructor.
  void add_place() {
    head_.push_back(none);
    unpaired_.push_back(0);
  }

  /// Calls visit(wedge) for the triangles at a place.
  template <class Visit>
  void around(Index place, Visit visit) const {
    for (Index w = head_[place]; w != none; w = wedges_[w].next) visit(wedges_[w]);
  }

  /// Is a place on the boundary? (On an edge with one triangle.)
  [[nodiscard]] bool open(Index place) const { return unpaired_[place] != 0; }

  /// The angles of its triangles together.
  [[nodiscard]] double angle_taken(Index place) const;
  /// The only triangle on an edge, or none if there is no such one.
  [[nodiscard]] Index only_triangle(Index a, Index b) const;
  /// Would it overlap none at any of its corners?
  [[nodiscard]] bool has_room(const Triangle& t) const;
  /// From neighbour u away from w to the next neighbour of a place, in its tangent plane.
  [[nodiscard]] Index next_around(Index place, Index u, Index w) const;
  /// At a place on the boundary where more than half a turn is taken: the triangle that would close
  /// what is left, and how deep it is, in the place's reach. Else a depth of infinity.
  [[nodiscard]] double notch(Index place, Triangle& t) const;
  /// Radius of the circumcircle, in the mean reach of the corners.
  [[nodiscard]] double circle(const Triangle& t) const;

 private:
  static std::uint64_t mixed(Index i) {
    const std::uint64_t x = (std::uint64_t{i} + 1) * 0x9E3779B97F4A7C15u;
    return x ^ x >> 29;
  }
  using Plane = std::array<double, 2>;
  struct Axes {
    Point3 x, y;
  };
  [[nodiscard]] Axes axes(Index place) const;
  [[nodiscard]] Plane flat(const Axes& axes, Index place, Index other) const;
  [[nodiscard]] bool has_room(Index place, Index a, Index b) const;

  const Places& places_;
  std::span<const TangentFrame> frames_;
  SheetRule rule_;
  std::vector<Triangle> triangles_;
  std::vector<Index> head_;
  std::vector<std::uint64_t> unpaired_;  // of each place, neighbours: those that occur twice cancel
  std::vector<Wedge> wedges_;
};

/// What hangs together.
struct CloudParts {
  std::vector<Index> part;  ///< of each place, one of its places
  std::size_t bridges = 0;
  std::size_t joints = 0;  ///< of these, between places that were in triangles
};

/// Connects parts of the sheet, and places in no triangle, over neighbours on one sheet, the
/// nearest first, by triangles that have the segment as an edge. A place that no neighbour goes
/// with is connected to the nearest of them. Where neither end is in a triangle, a place halfway is
/// added to `places`.
CloudParts bridge_parts(const SheetRule& rule, std::span<const TangentFrame> frames, Places& places,
                        SheetWedges& sheet);

/// Gives the places on the boundary that paths bend at longer edges, by flips, so that whoever
/// passes one nearby touches a triangle of it.
///
/// A path remembers a saddle only if it crosses an edge that ends there. A line of sight that
/// passes a corner one triangle further out does not know of it, and some way behind the corner its
/// neighbour in the shadow would take the source over. In a flat sheet any triangles do.
void widen_boundary_saddles(const Places& places, std::span<const TangentFrame> frames,
                            const SheetRule& rule, SheetWedges& sheet);

/// How long the edges of a cloud's triangles are, 0 1, 1 2 and 2 0 of each: over creases, in a
/// cloud with `noise` (spacings) over all ridges where planes meet, and without a share `flat` of
/// what is taken for noise (`tangent_length`). None if all are as in space.
std::vector<std::array<double, 3>> sheet_lengths(const Places& places,
                                                 std::span<const TangentFrame> frames,
                                                 const SheetRule& rule,
                                                 std::span<const std::array<Index, 3>> faces,
                                                 double flat, double noise);

/// The places, ascending, with edges that lead from one side of a ridge to the other and are far
/// shorter than the way over it, where so much `height` between neighbours (spacings) may be noise;
/// in a cloud with `noise` those that are on neither side of a ridge as well.
[[nodiscard]] std::vector<Index> chord_places(const Places& places,
                                              std::span<const TangentFrame> frames,
                                              const SheetRule& rule,
                                              std::span<const std::array<Index, 3>> faces,
                                              std::span<const std::array<double, 3>> lengths,
                                              double height, double noise);

/// Heights of neighbours over each other, along the mean normal of both.
///
/// On a smooth surface an edge leaves both tangent planes to the same side, and nothing is left
/// along the mean normal but what curvature and chance in the normals make, which grows with the
/// edge. Noise is as high on short edges as on long ones.
struct HeightNoise {
  double share = 0;   ///< how much of the heights is noise, 0 to 1
  double height = 0;  ///< of noise between two neighbours, its median; 0 if there is none
};

/// By the medians of near and of far neighbours of some thousand places.
HeightNoise height_noise(const Places& places, std::span<const TangentFrame> frames);

/// Length of an edge, without `share` of the square of its height. Normals that differ by more than
/// 25 degrees tell nothing, as across an edge of a solid: the length is that in space.
double tangent_length(const Places& places, std::span<const TangentFrame> frames, Index a, Index b,
                      double share);

}  // namespace plexway::detail
