#include "complexes/common/local_frame.hpp"

#include <Eigen/Dense>
#include <algorithm>

namespace plexway::detail {
namespace {

std::array<double, 3> column(const Eigen::Matrix3d& m, int i) {
  return {m(0, i), m(1, i), m(2, i)};
}

}  // namespace

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
