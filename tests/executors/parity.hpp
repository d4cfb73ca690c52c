#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <random>
#include <vector>

#include <plexway/solve.hpp>

#include "complexes/test_meshes.hpp"

namespace plexway::testing {

/// The same to the last bit?
template <class Real>
bool same_bits(const DistanceField<Real>& a, const DistanceField<Real>& b) {
  return a.distance.size() == b.distance.size() &&
         std::memcmp(a.distance.data(), b.distance.data(), a.distance.size() * sizeof(Real)) == 0 &&
         a.label == b.label && a.complete == b.complete &&
         a.statistics.expansions == b.statistics.expansions &&
         a.statistics.updates == b.statistics.updates &&
         a.statistics.reached_simplices == b.statistics.reached_simplices;
}

/// How far two fields differ, relatively; vertices that one of them did not reach apart.
struct Parity {
  double mean = 0, worst = 0;
  std::size_t reached_by_one = 0, other_label = 0;
};
template <class Real>
Parity parity(const DistanceField<Real>& a, const DistanceField<Real>& b) {
  Parity p;
  std::size_t count = 0;
  for (std::size_t v = 0; v < a.distance.size(); ++v) {
    const double x = static_cast<double>(a.distance[v]), y = static_cast<double>(b.distance[v]);
    p.reached_by_one += std::isinf(x) != std::isinf(y);
    if (std::isinf(x) || std::isinf(y) || !(x > 0)) continue;
    const double e = std::abs(y / x - 1);
    p.mean += e;
    p.worst = std::max(p.worst, e);
    p.other_label += !a.label.empty() && a.label[v] != b.label[v];
    ++count;
  }
  p.mean /= static_cast<double>(std::max(count, std::size_t{1}));
  return p;
}

/// `count` vertices of a domain.
template <class Domain>
std::vector<PointSource> random_sources(const Domain& domain, std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<PointSource> sources;
  for (std::size_t i = 0; i < count; ++i)
    sources.push_back(PointSource::at(below(random, domain.vertex_count())));
  return sources;
}

/// Chunks and pieces so small that several threads have something to do even here.
inline OpenMP team(int threads) { return {.threads = threads, .chunk = 8, .piece = 64}; }

}  // namespace plexway::testing
