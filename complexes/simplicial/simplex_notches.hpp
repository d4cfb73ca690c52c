#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include <plexway/simplicial/simplicial_complex.hpp>

namespace plexway::detail {

/// The angles between the facets of a simplex, [i][j] between those opposite corners i and j; 0
/// where it has no volume. By the inner products of the gradients of its barycentric coordinates.
template <class Real, int N>
std::array<std::array<double, N + 1>, N + 1> facet_angles(const SimplexRecord<Real, N>& record) {
  using Layout = SimplexLayout<N>;
  std::array<std::array<double, N + 1>, N + 1> angle{}, product{};
  std::array<std::array<double, 2 * N>, N> rows{};  // inner products of edges, then their inverse
  const auto square = [&](std::size_t a, std::size_t b) {
    return a == b ? 0. : static_cast<double>(record.length2[Layout::edge(a, b)]);
  };
  for (std::size_t a = 0; a < N; ++a) {
    for (std::size_t b = 0; b < N; ++b)
      rows[a][b] = .5 * (square(0, a + 1) + square(0, b + 1) - square(a + 1, b + 1));
    rows[a][N + a] = 1;
  }
  for (std::size_t k = 0; k < N; ++k) {
    std::size_t pivot = k;
    for (std::size_t a = k; a < N; ++a)
      if (std::abs(rows[a][k]) > std::abs(rows[pivot][k])) pivot = a;
    if (!(std::abs(rows[pivot][k]) > 1e-9)) return angle;
    std::swap(rows[k], rows[pivot]);
    const double by = rows[k][k];
    for (double& x : rows[k]) x /= by;
    for (std::size_t a = 0; a < N; ++a) {
      const double times = a == k ? 0 : rows[a][k];
      for (std::size_t b = 0; b < 2 * N; ++b) rows[a][b] -= times * rows[k][b];
    }
  }
  for (std::size_t a = 1; a <= N; ++a)
    for (std::size_t b = 1; b <= N; ++b) {
      const double x = rows[a - 1][N + b - 1];
      product[a][b] = x;
      product[0][b] -= x, product[a][0] -= x, product[0][0] += x;
    }
  for (std::size_t i = 0; i <= N; ++i)
    for (std::size_t j = 0; j <= N; ++j)
      if (i != j)
        angle[i][j] = std::acos(
            std::clamp(-product[i][j] / std::sqrt(product[i][i] * product[j][j]), -1., 1.));
  return angle;
}

/// How many faces of dimension N - 2 lie on the boundary and have clearly more than pi of the
/// complex around them: there paths bend. Where several parts touch in one face it is none. Cost:
/// O(n log n).
template <class Real, int N>
std::size_t count_notches(const SimplicialComplex<Real, N>& complex) {
  constexpr double notch = 0.25;  // more than a metric that varies bends a flat boundary
  const auto records = complex.records();
  struct Wedge {
    std::array<Index, N - 1> face;
    double angle;
    int sides;  // on the boundary
  };
  std::vector<char> outer(complex.vertex_count(), 0);
  for (const auto& record : records)
    for (std::size_t i = 0; i <= N; ++i)
      for (std::size_t k = 0; k <= N; ++k)
        if (record.across[i] == none && k != i) outer[record.corner[k]] = 1;
  std::vector<Wedge> wedges;
  for (const auto& record : records) {
    const auto angle = facet_angles<Real, N>(record);
    for (std::size_t j = 1; j <= N; ++j)
      for (std::size_t i = 0; i < j; ++i) {
        Wedge wedge{{}, angle[i][j], (record.across[i] == none) + (record.across[j] == none)};
        bool on = true;
        for (std::size_t k = 0, n = 0; k <= N; ++k) {
          if (k == i || k == j) continue;
          on = on && outer[record.corner[k]] != 0;
          wedge.face[n++] = record.corner[k];
        }
        if (on) wedges.push_back(wedge);
      }
  }
  std::sort(wedges.begin(), wedges.end(),
            [](const Wedge& a, const Wedge& b) { return a.face < b.face; });
  std::size_t notches = 0;
  for (auto run = wedges.begin(); run != wedges.end();) {
    double sum = 0;
    int sides = 0;
    const auto face = run->face;
    for (; run != wedges.end() && run->face == face; ++run) sum += run->angle, sides += run->sides;
    notches += sides == 2 && sum > std::numbers::pi + notch;
  }
  return notches;
}

}  // namespace plexway::detail
