#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <vector>

#include <plexway/simplicial/kuhn_grid.hpp>
#include <plexway/solve.hpp>

#include "labels/solving.hpp"

/// Boxes of any dimension, with and without obstacles, and exact distances in them.
namespace plexway::testing {

/// The unit cube in n cells a side, of equal or random width.
template <int N>
KuhnGrid<N> cube_grid(std::size_t n, unsigned seed = 0) {
  std::mt19937 random(seed);
  std::array<std::vector<double>, N> planes;
  for (auto& axis : planes) {
    std::vector<double> width(n, 1);
    if (seed)
      for (double& w : width) w = 1 + 2 * uniform(random);
    const double sum = std::accumulate(width.begin(), width.end(), 0.);
    axis.assign(1, 0);
    for (const double w : width) axis.push_back(axis.back() + w / sum);
  }
  return KuhnGrid<N>(planes);
}

template <std::size_t N>
double distance_between(const std::array<double, N>& a, const std::array<double, N>& b) {
  double sum = 0;
  for (std::size_t d = 0; d < N; ++d) sum += (a[d] - b[d]) * (a[d] - b[d]);
  return std::sqrt(sum);
}

template <int N>
std::vector<double> straight(const KuhnGrid<N>& grid, Index source) {
  std::vector<double> exact(grid.vertex_count());
  for (Index v = 0; v < exact.size(); ++v)
    exact[v] = distance_between(grid.position(v), grid.position(source));
  return exact;
}

/// In the plane around the open square (low, high)^2: over the visibility graph of its corners.
struct SquareHole {
  double low, high;

  [[nodiscard]] bool covers(double x, double y) const {
    return x > low + 1e-9 && x < high - 1e-9 && y > low + 1e-9 && y < high - 1e-9;
  }
  using P = std::array<double, 2>;
  [[nodiscard]] bool sees(const P& a, const P& b) const {
    double from = 0, to = 1;
    for (std::size_t d = 0; d < 2; ++d) {
      if (a[d] == b[d]) {
        if (a[d] <= low + 1e-12 || a[d] >= high - 1e-12) return true;
        continue;
      }
      const double s = (low - a[d]) / (b[d] - a[d]), t = (high - a[d]) / (b[d] - a[d]);
      from = std::max(from, std::min(s, t));
      to = std::min(to, std::max(s, t));
    }
    return from > to - 1e-12;
  }
  [[nodiscard]] double around(const P& a, const P& b) const {
    if (covers(a[0], a[1]) || covers(b[0], b[1])) return std::numeric_limits<double>::infinity();
    const P stops[6] = {a, b, {low, low}, {high, low}, {high, high}, {low, high}};
    double d[6];
    std::fill(d, d + 6, std::numeric_limits<double>::infinity());
    d[0] = 0;
    for (int round = 0; round < 6; ++round)
      for (int i = 0; i < 6; ++i)
        for (int j = 0; j < 6; ++j)
          if (sees(stops[i], stops[j]))
            d[j] = std::min(d[j], d[i] + distance_between(stops[i], stops[j]));
    return d[1];
  }
};

/// The cube with a square hole through axes 0 and 1, all along the others: a product, so that
/// squared distances add up.
template <int N>
struct HoledCube {
  KuhnGrid<N> grid;
  SquareHole hole;

  explicit HoledCube(std::size_t n)
      : grid(cube_grid<N>(n)), hole{grid.planes(0)[n * 3 / 10], grid.planes(0)[n * 7 / 10]} {}

  template <class Real>
  [[nodiscard]] SimplicialComplex<Real, N> complex() const {
    return grid.template complex<Real>([&](const auto& cell) {
      const auto p = grid.centre(cell);
      return hole.covers(p[0], p[1]);
    });
  }
  [[nodiscard]] std::vector<double> exact(Index source) const {
    const auto s = grid.position(source);
    std::vector<double> d(grid.vertex_count());
    for (Index v = 0; v < d.size(); ++v) {
      const auto p = grid.position(v);
      double sum = std::pow(hole.around({s[0], s[1]}, {p[0], p[1]}), 2);
      for (std::size_t a = 2; a < N; ++a) sum += (p[a] - s[a]) * (p[a] - s[a]);
      d[v] = std::sqrt(sum);
    }
    return d;
  }
};

template <class Real, int N>
std::vector<double> solve(const SimplicialComplex<Real, N>& domain, const PointSource& source,
                          const PropagateOptions& options = {}) {
  const auto field = plexway::solve(Serial{}, domain, source, options);
  return {field.distance.begin(), field.distance.end()};
}

}  // namespace plexway::testing
