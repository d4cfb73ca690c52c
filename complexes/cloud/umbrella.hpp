#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include <plexway/cloud/neighbours.hpp>
#include <plexway/common/ids.hpp>

#include "complexes/common/geometry.hpp"

namespace plexway::detail {

class SheetWedges;

/// The places of a cloud along a curve, numbered in that order, with their neighbours.
struct Places {
  std::vector<Point3> at;
  Neighbours near;  ///< between places, without the place itself, nearest first
};

/// How the surface lies at a place.
struct TangentFrame {
  std::array<float, 3> normal;  ///< unit
  float spacing = 0;            ///< 1 / sqrt(points per area), about
  float reach = 0;              ///< what the circles of triangles are measured in: see set_reach
};

inline Point3 normal_of(const TangentFrame& frame) {
  return {frame.normal[0], frame.normal[1], frame.normal[2]};
}

/// Which neighbours are on the same sheet.
struct SheetRule {
  double most_offset;   ///< from the tangent planes, in spacings
  double least_cosine;  ///< of the angle between two normals
  bool oriented;        ///< normals tell inside from outside
};

/// Delaunay umbrellas: the neighbours that a place shares triangles with, in order around it.
struct Umbrellas {
  static constexpr Index gap = Index{1} << 31;  ///< no triangle between this one and the next
  std::vector<std::size_t> begin;
  std::vector<Index> ring;
  std::size_t refused = 0;  ///< pairs of neighbours that are not on the same sheet

  [[nodiscard]] std::span<const Index> around(Index place) const {
    return std::span<const Index>(ring).subspan(begin[place], begin[place + 1] - begin[place]);
  }
};

/// Normals by the directions in which a place's neighbours spread least, those across a gap left
/// out as far as that can be seen. `given` has one a place that goes before, or is empty.
std::vector<TangentFrame> tangent_frames(const Places& places, std::span<const Point3> given,
                                         const SheetRule& rule, int threads,
                                         const std::function<bool(double)>& progress);

/// The umbrella of each place: the triangles around it in the Delaunay triangulation of its
/// neighbours on the same sheet, in its tangent plane. None has a circumcircle of more than
/// `widest` spacings.
Umbrellas local_umbrellas(const Places& places, std::span<const TangentFrame> frames,
                          const SheetRule& rule, double widest, int threads,
                          const std::function<bool(double)>& progress);

/// The circles of triangles are about 0.7 spacings wide where points lie by chance, but in rows
/// far apart half the distance of two rows, many spacings. Where the usual circle about a place
/// is wider than a spacing, its reach is that much more; else it is the spacing.
void set_reach(const Places& places, const Umbrellas& umbrellas, int threads,
               std::span<TangentFrame> frames);

/// One sheet of triangles out of all umbrellas: no two overlap at a common corner, so that no edge
/// has more than two.
///
/// A triangle gets a vote from each corner whose umbrella has it. Those with three votes are always
/// in; no two of them overlap, since an umbrella's triangles do not. Then, where there is room,
/// those with two votes, and with one, the smallest circles first.
void add_umbrellas(const Umbrellas& umbrellas, int threads, SheetWedges& sheet);

/// Closes holes of few edges where umbrellas could not agree, ear by ear, with circles of at most
/// `widest` spacings.
void fill_holes(double widest, SheetWedges& sheet);

/// Closes holes of at most eight edges where places leave no room in their tangent planes, with
/// circles of at most `widest` spacings: what is around a corner of several sides fits no plane.
void close_tears(double widest, SheetWedges& sheet);

/// The places around holes of few edges that circles of less than `widest` spacings would close, if
/// the places left room; ascending.
[[nodiscard]] std::vector<Index> torn_places(double widest, SheetWedges& sheet);

/// Takes triangles with circles of more than `widest` spacings away from the boundary: there they
/// stand for places where the cloud has no points. Inside they close what chance left open.
void trim_boundary(double widest, SheetWedges& sheet);

/// Fills notches of the boundary that are at most `deepest` spacings deep: chance leaves them, and
/// a way along the rim would go in and out of each.
void fill_notches(double deepest, SheetWedges& sheet);

/// A neighbour in the tangent plane of a place, and its image in the circle around the place.
struct Spoke {
  double x, y, u, v;
  Index place;
};

/// The hull of the images of a place's neighbours: the Delaunay umbrella of the place.
class SpokeHull {
 public:
  SpokeHull() = default;
  /// Where all places are in space: so that the places of a circle agree that it is one, though
  /// each sees it in a tangent plane of its own.
  explicit SpokeHull(std::span<const Point3> at) : at_(at) {}

  /// Numbers of spokes, counterclockwise from the nearest neighbour; none where rounding leaves no
  /// way around. Places on one circle are dealt with in the same way from all of them. Valid until
  /// the next call.
  std::span<const std::size_t> wrap(Index place, std::span<const Spoke> spokes);

 private:
  bool wrap_without_ties(std::size_t first, double largest);
  std::size_t next_of_ties(Index place, std::size_t at);
  std::size_t break_ties(Index place, std::size_t at, std::size_t best);
  [[nodiscard]] bool on_one_circle(std::array<Index, 4> places) const;

  std::span<const Point3> at_;

  std::span<const Spoke> spokes_;
  std::vector<std::size_t> hull_, ties_;
};

}  // namespace plexway::detail
