#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include <plexway/complex/ids.hpp>
#include <plexway/complex/neighbours.hpp>

namespace plexway {

struct PairOptions {
  /// Clouds with at least this much noise, in spacings, are smoothed first (see smooth); infinity:
  /// none.
  double least_noise = .06;
  int threads = 0;  ///< for building; 0: all there are
  /// Called with the share that is done; returning false stops with Cancelled.
  std::function<bool(double share)> progress = {};
};

/// What a cloud is made of, counted while it is built.
struct PairSummary {
  std::size_t points = 0;
  std::size_t distinct = 0;         ///< places with a point
  std::size_t duplicates = 0;       ///< points at the place of another
  std::size_t neighbour_pairs = 0;  ///< of places, each counted once
  std::size_t boundary_points = 0;  ///< places where paths may bend
  std::size_t isolated_points = 0;  ///< places without neighbours
  std::size_t components = 0;       ///< of places joined by neighbours, isolated ones included
  std::size_t largest_component = 0;
  double mean_spacing = 0;  ///< mean distance of neighbours, in the points' unit
  double noise = 0;         ///< noise_level before smoothing; 0 where that was not asked for
  bool smoothed = false;
};

/// A place with a point: coordinates in the unit inside and, with its sign bit set at a boundary,
/// how far apart two of its neighbours may be to make a triangle with it, squared.
template <class Real>
struct PairPlace {
  Real x, y, z, reach2;
};

/// A cloud of points on a surface as points and neighbours, no more: the second form of a cloud.
///
/// Its hinges are pairs of neighbours and exist only while they are expanded: the pair (c, a) leads
/// to every neighbour x of c, on the other side of the line c a than the path came from, for which
/// |a x| is at most three times the mean distance of c's neighbours, less where the surface bends
/// (down to 1.1 times), and half of it at a boundary. Without that bound pairs grow, and distances
/// become straight chords through space.
///
/// Points at one place count as one. At places with an angle of more than 126 degrees without
/// neighbours the cloud has a boundary. Immutable once built, so any number of threads may read it.
/// Memory in float: 24 bytes a point and 4 a neighbour.
template <class Real>
class PointPairs {
 public:
  /// From n points in any unit and their neighbours, for example flann::neighbours; 16 are a good
  /// number, 24 halve the largest errors. Throws InputError for no points, a coordinate that is not
  /// finite, and lists that are not of these points; Cancelled as progress says. The result does
  /// not depend on `threads`. Cost: 5 us a point on one thread, 20 more if the cloud is smoothed.
  PointPairs(std::span<const std::array<double, 3>> points, const Neighbours& neighbours,
             const PairOptions& options = {});

  [[nodiscard]] std::size_t point_count() const { return point_to_inside_.size(); }
  [[nodiscard]] const PairSummary& summary() const { return summary_; }
  /// Bytes this complex holds.
  [[nodiscard]] std::size_t bytes() const;
  /// One unit inside, in the points' unit: the mean distance of neighbours.
  [[nodiscard]] double unit() const { return unit_; }

  // What follows serves the floors above and uses the numbers inside, of places.

  /// The neighbours of place i are those from begin()[i] to begin()[i + 1].
  [[nodiscard]] std::span<const Index> begin() const { return begin_; }
  [[nodiscard]] std::span<const Index> neighbours() const { return neighbours_; }
  [[nodiscard]] std::span<const PairPlace<Real>> places() const { return places_; }
  [[nodiscard]] Index inside_vertex(Index point) const { return point_to_inside_[point]; }
  [[nodiscard]] std::span<const Index> vertices_inside() const { return point_to_inside_; }

 private:
  void measure(std::span<const std::array<double, 3>> points, int threads);
  void count_components();

  PairSummary summary_;
  double unit_ = 1;
  std::vector<Index> begin_, neighbours_;
  std::vector<PairPlace<Real>> places_;
  std::vector<Index> point_to_inside_;
};

extern template class PointPairs<float>;
extern template class PointPairs<double>;

}  // namespace plexway
