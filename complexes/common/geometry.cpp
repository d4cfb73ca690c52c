#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include <plexway/common/closest.hpp>
#include <plexway/error.hpp>
#include <plexway/solid/detail/tet_record.hpp>
#include <plexway/source/point_source.hpp>

#include "complexes/common/geometry.hpp"

namespace plexway::detail {
namespace {

using Positions = std::span<const Point3>;

// A point of a simplex with N corners. All that follows looks for the one closest to the origin.
template <std::size_t N>
struct ClosestSoFar {
  double squared_distance = std::numeric_limits<double>::infinity();
  std::array<double, N> barycentric = {1};

  // Takes a point of the simplex that has only those corners, if it is closer.
  template <std::size_t M>
  void improve(const ClosestSoFar<M>& other, const std::array<std::size_t, M>& corners) {
    if (!(other.squared_distance < squared_distance)) return;
    squared_distance = other.squared_distance;
    barycentric = {};
    for (std::size_t i = 0; i < M; ++i) barycentric[corners[i]] = other.barycentric[i];
  }
};

ClosestSoFar<2> closest(const std::array<Point3, 2>& corners) {
  const Point3 along = minus(corners[1], corners[0]);
  const double length2 = dot(along, along);
  const double t = length2 > 0 ? std::clamp(-dot(corners[0], along) / length2, 0.0, 1.0) : 0.0;
  Point3 at = corners[0];
  for (std::size_t k = 0; k < 3; ++k) at[k] += t * along[k];
  if (t == 1) at = corners[1];
  return {dot(at, at), {1 - t, t}};
}

// The foot of the perpendicular where it lies inside, else the best of the three edges. A triangle
// without area has only edges.
ClosestSoFar<3> closest(const std::array<Point3, 3>& corners) {
  const Point3 normal = cross(minus(corners[1], corners[0]), minus(corners[2], corners[0]));
  const double normal2 = dot(normal, normal);
  if (normal2 > 0) {
    Point3 weight;
    for (std::size_t i = 0; i < 3; ++i)
      weight[i] = dot(cross(corners[(i + 1) % 3], corners[(i + 2) % 3]), normal);
    const double sum = weight[0] + weight[1] + weight[2];
    const bool inside = weight[0] >= 0 && weight[1] >= 0 && weight[2] >= 0 && sum > 0;
    if (inside) {
      const double height = dot(corners[0], normal);
      return {height * height / normal2, {weight[0] / sum, weight[1] / sum, weight[2] / sum}};
    }
  }
  ClosestSoFar<3> best;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    best.improve(closest(std::array{corners[i], corners[j]}), std::array{i, j});
  }
  return best;
}

// The origin itself where it lies inside, else the best of the four faces.
ClosestSoFar<4> closest(const std::array<Point3, 4>& corners) {
  std::array<double, 4> weight;
  double sum = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto& [a, b, c] = tet_faces_inside[i];
    weight[i] = dot(corners[a], cross(corners[b], corners[c]));
    sum += weight[i];
  }
  if (sum != 0) {
    for (double& w : weight) w /= sum;
    if (*std::min_element(weight.begin(), weight.end()) >= 0) return {0, weight};
  }
  ClosestSoFar<4> best;
  for (const auto& [a, b, c] : tet_faces_inside)
    best.improve(closest(std::array{corners[a], corners[b], corners[c]}),
                 std::array<std::size_t, 3>{a, b, c});
  return best;
}

// Makes the numbers above neither overflow nor underflow, whatever the unit.
double largest_offset(Positions positions, const Point3& point) {
  double largest = 0;
  for (const Point3& position : positions) {
    for (std::size_t k = 0; k < 3; ++k)
      largest = std::max(largest, std::abs(position[k] / 2 - point[k] / 2));
  }
  return largest > 0 ? largest : 1;
}

template <std::size_t N>
bool has_twice(const std::array<std::uint32_t, N>& corners) {
  for (std::size_t i = 1; i < N; ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (corners[i] == corners[j]) return true;
  return false;
}

template <std::size_t N>
SimplexPoint closest_of_all(Positions positions,
                            std::span<const std::array<std::uint32_t, N>> simplices,
                            const Point3& point) {
  const double scale = largest_offset(positions, point);
  SimplexPoint best;
  for (std::size_t simplex = 0; simplex < simplices.size(); ++simplex) {
    if (N > 2 && has_twice(simplices[simplex])) continue;  // others have its edges
    std::array<Point3, N> corners;
    for (std::size_t i = 0; i < N; ++i) {
      const Point3& position = positions[simplices[simplex][i]];
      for (std::size_t k = 0; k < 3; ++k) corners[i][k] = (position[k] / 2 - point[k] / 2) / scale;
    }
    const ClosestSoFar<N> found = closest(corners);
    if (found.squared_distance < best.squared_distance) {
      best = {simplex, {}, found.squared_distance};
      std::copy(found.barycentric.begin(), found.barycentric.end(), best.barycentric.begin());
    }
  }
  return best;
}

std::array<double, 3> column(const Eigen::Matrix3d& m, int i) {
  return {m(0, i), m(1, i), m(2, i)};
}

}  // namespace

SimplexPoint closest_point(Positions positions, std::span<const std::array<std::uint32_t, 2>> edges,
                           const Point3& point) {
  return closest_of_all(positions, edges, point);
}

SimplexPoint closest_point(Positions positions,
                           std::span<const std::array<std::uint32_t, 3>> triangles,
                           const Point3& point) {
  return closest_of_all(positions, triangles, point);
}

SimplexPoint closest_point(Positions positions, std::span<const std::array<std::uint32_t, 4>> tets,
                           const Point3& point) {
  return closest_of_all(positions, tets, point);
}

PointSource source_at(const SimplexPoint& found, std::span<const Index> corners) {
  constexpr double corner_share = 1 - 1e-12;
  for (std::size_t i = 0; i < corners.size(); ++i)
    if (found.barycentric[i] >= corner_share) return PointSource::at(corners[i]);
  return PointSource::in(static_cast<Index>(found.simplex), found.barycentric);
}

double squared_distance(const std::array<Point3, 3>& corners) {
  return closest(corners).squared_distance;
}

LocalFrame fit_frame(std::span<const std::array<double, 3>> offsets,
                     std::span<const double> weights) {
  const auto vector = [&](std::size_t i) {
    return Eigen::Vector3d(offsets[i][0], offsets[i][1], offsets[i][2]);
  };
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  double sum = 1;
  for (std::size_t i = 0; i < offsets.size(); ++i)
    mean += weights[i] * vector(i), sum += weights[i];
  mean /= sum;
  Eigen::Matrix3d spread = mean * mean.transpose();
  for (std::size_t i = 0; i < offsets.size(); ++i) {
    const Eigen::Vector3d d = vector(i) - mean;
    spread.noalias() += weights[i] * d * d.transpose();
  }
  // In proportion, so that neither the unit nor a tiny neighbourhood matters.
  const double largest = spread.diagonal().maxCoeff();
  if (!(largest > 0)) return {};
  spread /= largest;

  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(spread);
  // The closed form loses its vectors where eigenvalues are equal.
  const auto orthonormal = [&] {
    const Eigen::Matrix3d& m = solver.eigenvectors();
    return ((m.transpose() * m - Eigen::Matrix3d::Identity()).array().abs() < 1e-9).all();
  };
  if (!orthonormal()) solver.compute(spread);
  const Eigen::Vector3d& values = solver.eigenvalues();
  const double all = values.cwiseMax(0).sum();
  return {column(solver.eigenvectors(), 0), column(solver.eigenvectors(), 2),
          column(solver.eigenvectors(), 1), std::max(values[0], 0.0) / all};
}

}  // namespace plexway::detail

namespace plexway {
using namespace detail;
namespace {

template <std::size_t N>
PointSource closest_source(Positions positions, std::span<const std::array<Index, N>> simplices,
                           const Point3& point) {
  if (simplices.empty()) throw UsageError("there is no simplex to be close to");
  for (const double x : point)
    if (!std::isfinite(x)) throw UsageError("the point is not finite");
  const SimplexPoint found = closest_point(positions, simplices, point);
  return source_at(found, simplices[found.simplex]);
}

}  // namespace

PointSource closest(const GivenPoints& positions, std::span<const std::array<Index, 2>> edges,
                    const Point3& point) {
  return closest_source(positions, edges, point);
}
PointSource closest(const GivenPoints& positions, std::span<const std::array<Index, 3>> triangles,
                    const Point3& point) {
  return closest_source(positions, triangles, point);
}
PointSource closest(const GivenPoints& positions, std::span<const std::array<Index, 4>> tets,
                    const Point3& point) {
  return closest_source(positions, tets, point);
}

}  // namespace plexway
