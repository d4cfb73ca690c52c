#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include <plexway/cloud/neighbours.hpp>
#include <plexway/common/ids.hpp>
#include <plexway/common/rows_of.hpp>
#include <plexway/domain/concept.hpp>
#include <plexway/surface/triangle_mesh.hpp>

namespace plexway {

namespace detail {
struct KeptParts;
}  // namespace detail

/// How long an edge of a cloud is.
enum class EdgeLengths {
  /// As in space on clean clouds. On noisy ones, as far as they are: without its height along the
  /// mean normal of its ends. What is noise shows in the heights of near and far neighbours.
  automatic,
  /// Always as in space.
  in_space,
  tangential,  ///< always without the heights, detail of the size of the spacing included
};

/// How a cloud becomes a sheet.
struct CloudOptions {
  /// Neighbours are refused where their normals differ by more (degrees), or where the segment
  /// between them is steeper than half of it: so sheets across a thin gap stay apart.
  double max_normal_angle = 60;
  /// One a point, of any length, pointing outward everywhere; a zero or NaN stands for unknown.
  /// Empty: estimated, and then inside and outside are not distinguished.
  std::span<const std::array<double, 3>> normals = {};
  /// How long the sheet's edges are.
  EdgeLengths lengths = EdgeLengths::automatic;
  /// Holes that a circle of so many spacings fits in stay holes.
  double widest_circle = 3;
  /// The same at the boundary of the cloud, where chance leaves no such voids.
  double widest_boundary_circle = 1.15;
  int threads = 0;  ///< 0: as many as the machine has
  /// Called with the share that is done; returning false stops with Cancelled.
  std::function<bool(double share)> progress = {};
};

/// The counts of a cloud, made while it is built.
struct CloudSummary {
  /// As given.
  std::size_t points = 0;
  std::size_t distinct = 0;         ///< places
  std::size_t duplicates = 0;       ///< points - distinct
  std::size_t near_duplicates = 0;  ///< of these, at another place, but `without_near_twins`
  std::size_t neighbour_pairs = 0;  ///< of places
  std::size_t refused_pairs = 0;    ///< of these, not on one sheet
  /// Of the sheet.
  std::size_t triangles = 0;
  std::size_t bridges = 0;          ///< pairs that only an edge connects, not a sheet
  std::size_t joints = 0;           ///< of these, between two parts that are sheets
  std::size_t boundary_points = 0;  ///< places on the boundary of the sheet
  /// Of these, around holes of at most 24 edges where places could not agree on a sheet: as a rule
  /// near a crease with another side close by.
  std::size_t torn_points = 0;
  Index first_torn = none;  ///< the lowest of these points
  /// Places with edges from one side of a sharp ridge to the other that are well short of the path
  /// over it, or that noise puts off their side's plane: the place of the ridge is unknown.
  std::size_t chord_points = 0;
  Index first_chord = none;                  ///< the lowest of these points
  std::size_t isolated_points = 0;           ///< places that are connected to no other
  std::size_t components = 0;                ///< places that paths connect; isolated ones count
  std::size_t largest_component = 0;         ///< its points
  std::vector<std::size_t> component_sizes;  ///< points of each, descending
  double noise = 0;  ///< median height of neighbours over each other, if that is noise; else 0
  double mean_spacing = 0;  ///< 1 / sqrt(points per area) about a place, the mean of all
};

/// A cloud of points on a surface as a metric space: one sheet of triangles with the points as
/// vertices.
///
/// Each point's neighbours make a Delaunay umbrella in its tangent plane; the sheet is made of
/// triangles that umbrellas agree on, as far as they do, and what closes the holes between them.
/// Lengths are as in space. Points at one place are one vertex. Immutable once built.
///
/// Memory: about 140 bytes a point in float; up to four times that while it is built.
template <class Real>
class PointCloud {
  static_assert(is_number_of_domains<Real>, "distances are float or double");

 public:
  /// The precision of lengths inside, and of fields.
  using Number = Real;
  /// A cloud.
  static constexpr DomainKind kind = DomainKind::cloud;
  /// Of its simplices, the sheet's triangles.
  static constexpr int dimension = 2;

  /// From n points in any unit and their neighbours (about 16 each; `symmetric_closure` first).
  /// Throws InputError naming the point for a coordinate that is not finite or a neighbour >= n,
  /// for no points, and if there is not one row or normal a point; UsageError for options out of
  /// range; Cancelled as progress says. The result does not depend on the number of threads. Cost:
  /// 2 to 4 us a point on one thread, of which half is done in parallel.
  PointCloud(const GivenPoints& points, const Neighbours& neighbours,
             const CloudOptions& options = {});

  /// Does not compile, and says why.
  template <detail::AnyRows Points>
  explicit PointCloud(const Points&) : PointCloud({}, {}, {}) {
    static_assert(!detail::AnyRows<Points>,
                  "a cloud needs the neighbours of its points: PointCloud<float>(points, "
                  "flann::surface_neighbours(points)), or lists of your own");
  }

  /// n, twins included.
  [[nodiscard]] std::size_t point_count() const { return summary_.points; }
  /// The points: fields have one distance each.
  [[nodiscard]] std::size_t vertex_count() const { return summary_.points; }
  /// Triangles of the sheet.
  [[nodiscard]] std::size_t simplex_count() const { return surface_.face_count(); }
  /// Intrinsic: the lengths of the sheet's edges are all that counts.
  [[nodiscard]] MetricKind metric() const { return MetricKind::intrinsic; }
  /// Its counts, made while it was built.
  [[nodiscard]] const CloudSummary& summary() const { return summary_; }
  /// Bytes this complex holds.
  [[nodiscard]] std::size_t bytes() const;
  /// The mean edge of the triangles, in the points' unit.
  [[nodiscard]] double unit() const { return surface_.unit(); }

  /// The sheet. Its vertices are the points, in the caller's numbers, and a few more behind them
  /// where points hang together by a single edge. A point with a twin of lower number is in no
  /// triangle.
  [[nodiscard]] const TriangleMesh<Real>& surface() const { return surface_; }
  /// The vertex of a point: itself, or its first twin.
  /// Cost: a binary search among twins.
  [[nodiscard]] Index of_point(Index point) const;
  /// Points that are not the first at their place, ascending, and who is.
  [[nodiscard]] std::span<const std::array<Index, 2>> twins() const { return twins_; }
  /// Where the surface's vertices behind the points are, in the points' unit; mostly none.
  [[nodiscard]] std::span<const std::array<double, 3>> more_places() const { return more_; }

 private:
  friend struct detail::KeptParts;
  explicit PointCloud(TriangleMesh<Real>&& surface) : surface_(std::move(surface)) {}

  CloudSummary summary_;
  std::vector<std::array<Index, 2>> twins_;
  std::vector<std::array<double, 3>> more_;
  TriangleMesh<Real> surface_;
};

/// Of the numbers that the points are: float, or double.
template <detail::AnyRows Points, class... Rest>
PointCloud(const Points&, const Rest&...) -> PointCloud<detail::NumberOf<Points>>;

extern template class PointCloud<float>;
extern template class PointCloud<double>;

}  // namespace plexway
