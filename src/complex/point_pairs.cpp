#include <plexway/complex/point_pairs.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <plexway/complex/blocks.hpp>
#include <plexway/complex/distinct_points.hpp>
#include <plexway/complex/normals.hpp>
#include <plexway/complex/smoothing.hpp>
#include <plexway/error.hpp>

#include "complex/local_frame.hpp"
#include "complex/neighbourhood.hpp"

namespace plexway {
namespace {

using Position = std::array<double, 3>;

constexpr double reach = 3;  // of a triangle's third edge, in mean distances of neighbours
constexpr double least_reach = 1.1;
constexpr double gap = 2.2;  // radians without neighbours that make a boundary
constexpr std::size_t block = 4096;

double dot(const Position& a, const Position& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// In mean distances of neighbours: less where the surface bends, so that edges do not cut through
/// it. On a sphere, `variation` is the square of the neighbourhood's radius over the sphere's
/// by 24.
double reach_on(double variation) {
  const double bend = std::sqrt(24 * variation);
  return std::clamp(.5 / std::max(bend, 1e-3), least_reach, reach);
}

/// The largest angle around the normal without an offset.
double widest_gap(const Neighbourhood& around, const LocalFrame& frame,
                  std::vector<double>& angles) {
  angles.clear();
  for (const Position& offset : around.offset)
    angles.push_back(std::atan2(dot(offset, frame.v), dot(offset, frame.u)));
  if (angles.empty()) return 2 * std::numbers::pi;
  std::sort(angles.begin(), angles.end());
  double widest = angles.front() + 2 * std::numbers::pi - angles.back();
  for (std::size_t i = 1; i < angles.size(); ++i)
    widest = std::max(widest, angles[i] - angles[i - 1]);
  return widest;
}

/// The neighbours of places instead of points, both ways.
Neighbours between_places(const Neighbours& neighbours, const DistinctPoints& distinct,
                          std::span<const Index> to_inside, std::span<const Position> places) {
  // Who is where: points by place.
  std::vector<Index> begin(places.size() + 1, 0), points(to_inside.size());
  for (const Index place : to_inside) ++begin[place + 1];
  for (std::size_t i = 0; i < places.size(); ++i) begin[i + 1] += begin[i];
  std::vector<Index> end(begin.begin(), begin.end() - 1);
  for (std::size_t i = 0; i < to_inside.size(); ++i)
    points[end[to_inside[i]]++] = static_cast<Index>(i);

  Neighbours inside;
  inside.begin.reserve(places.size() + 1);
  inside.of.reserve(neighbours.of.size());
  inside.begin.push_back(0);
  std::vector<Index> row;
  for (std::size_t i = 0; i < places.size(); ++i) {
    row.clear();
    for (Index k = begin[i]; k < begin[i + 1]; ++k)
      for (const Index j : neighbours.around(points[k]))
        if (to_inside[j] != i) row.push_back(to_inside[j]);
    if (begin[i + 1] - begin[i] > 1 || distinct.order.size() < distinct.first.size()) {
      std::sort(row.begin(), row.end());
      row.erase(std::unique(row.begin(), row.end()), row.end());
    }
    inside.of.insert(inside.of.end(), row.begin(), row.end());
    inside.begin.push_back(static_cast<Index>(inside.of.size()));
  }
  return symmetric_closure(inside, places);
}

}  // namespace

template <class Real>
PointPairs<Real>::PointPairs(std::span<const Position> points, const Neighbours& neighbours,
                             const PairOptions& options) {
  if (points.empty()) throw InputError("the cloud has no points");
  check(points, neighbours);
  const auto report = [&](double share) {
    if (options.progress && !options.progress(share))
      throw Cancelled("stopped by the progress callback");
  };
  summary_.points = points.size();
  const DistinctPoints distinct = distinct_points(points);
  summary_.distinct = distinct.order.size();
  summary_.duplicates = summary_.points - summary_.distinct;

  point_to_inside_.resize(points.size());
  std::vector<Position> places(distinct.order.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    places[i] = points[distinct.order[i]];
    point_to_inside_[distinct.order[i]] = static_cast<Index>(i);
  }
  for (std::size_t i = 0; i < points.size(); ++i)
    point_to_inside_[i] = point_to_inside_[distinct.first[i]];
  Neighbours inside = between_places(neighbours, distinct, point_to_inside_, places);
  report(.2);

  if (options.least_noise < std::numeric_limits<double>::infinity()) {
    summary_.noise = noise_level(places, inside, options.threads);
    summary_.smoothed = summary_.noise >= options.least_noise;
  }
  report(.4);
  if (summary_.smoothed) {
    SmoothOptions smoothing;
    smoothing.least_noise = 0;
    smoothing.threads = options.threads;
    if (options.progress)
      smoothing.progress = [&](double share) { return options.progress(.4 + .4 * share); };
    places = smooth(places, inside, smoothing);
  }
  begin_ = std::move(inside.begin);
  neighbours_ = std::move(inside.of);
  summary_.neighbour_pairs = neighbours_.size() / 2;
  measure(places, options.threads);
  count_components();
  report(1);
}

template <class Real>
void PointPairs<Real>::measure(std::span<const Position> points, int threads) {
  const Neighbours neighbours{begin_, neighbours_};
  std::vector<double> mean(points.size());  // distance of the neighbours
  std::vector<double> far(points.size());   // a triangle's third edge; below 0 at a boundary
  for_blocks(points.size(), block, threads, {}, [&](std::size_t first, std::size_t last) {
    Neighbourhood around;
    std::vector<double> angles;
    for (std::size_t i = first; i < last; ++i) {
      around.set_neighbours(points, neighbours, static_cast<Index>(i));
      double sum = 0;
      for (const Position& offset : around.offset) sum += std::sqrt(dot(offset, offset));
      mean[i] = around.offset.empty() ? 0 : sum / static_cast<double>(around.offset.size());
      const LocalFrame frame = fit_frame(around.offset, around.weight);
      far[i] = mean[i] * reach_on(frame.variation);
      if (widest_gap(around, frame, angles) > gap) far[i] = -far[i];
    }
  });

  double sum = 0;
  for (const double m : mean) sum += m;
  for (std::size_t i = 0; i < points.size(); ++i) {
    summary_.isolated_points += begin_[i] == begin_[i + 1];
    summary_.boundary_points += std::signbit(far[i]);
  }
  const std::size_t with_neighbours = points.size() - summary_.isolated_points;
  if (with_neighbours > 0) summary_.mean_spacing = sum / static_cast<double>(with_neighbours);
  if (summary_.mean_spacing > 0) unit_ = summary_.mean_spacing;

  // About the middle, so that single precision goes into differences.
  Position low = points[0], high = points[0];
  for (const Position& p : points)
    for (std::size_t d = 0; d < 3; ++d)
      low[d] = std::min(low[d], p[d]), high[d] = std::max(high[d], p[d]);
  places_.resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    Real at[3];
    for (std::size_t d = 0; d < 3; ++d)
      at[d] = static_cast<Real>((points[i][d] - (low[d] / 2 + high[d] / 2)) / unit_);
    const double edge = far[i] / unit_;
    places_[i] = {at[0], at[1], at[2], static_cast<Real>(std::copysign(edge * edge, edge))};
  }
}

template <class Real>
void PointPairs<Real>::count_components() {
  std::vector<Index> parent(places_.size()), size(places_.size(), 1);
  for (std::size_t i = 0; i < parent.size(); ++i) parent[i] = static_cast<Index>(i);
  const auto root = [&](Index i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  summary_.components = places_.size();
  for (Index i = 0; i < parent.size(); ++i)
    for (Index k = begin_[i]; k < begin_[i + 1]; ++k) {
      const Index a = root(i), b = root(neighbours_[k]);
      if (a == b) continue;
      parent[std::max(a, b)] = std::min(a, b);
      size[std::min(a, b)] += size[std::max(a, b)];
      --summary_.components;
    }
  summary_.largest_component = *std::max_element(size.begin(), size.end());
}

template <class Real>
std::size_t PointPairs<Real>::bytes() const {
  const auto of = [](const auto& v) { return v.capacity() * sizeof(v[0]); };
  return sizeof(*this) + of(begin_) + of(neighbours_) + of(places_) + of(point_to_inside_);
}

template class PointPairs<float>;
template class PointPairs<double>;

}  // namespace plexway
