#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>

#include <plexway/simplicial/simplicial_complex.hpp>
#include <plexway/solve/options.hpp>
#include <plexway/source/point_source.hpp>

namespace plexway {

/// A source that is no vertex, N < 4: its coordinates by the corners of the record.
template <class Real, int N>
std::array<double, N + 1> inside_coordinates(const SimplicialComplex<Real, N>& domain, Index inside,
                                             const PointSource& source) {
  std::array<double, N + 1> b{};
  for (std::size_t k = 0; k <= N && k < source.barycentric.size(); ++k)
    b[domain.place(inside, k)] = source.barycentric[k];
  return b;
}

/// One propagation over a complex of any dimension, from seeds to the last label.
template <class Real, int N, class Rule, class Front>
class SimplexPropagation {
 public:
  SimplexPropagation(const SimplicialComplex<Real, N>& domain, Rule rule, Front& front,
                     const PropagateOptions& options)
      : domain_(domain),
        rule_(rule),
        front_(front),
        radius_(static_cast<Real>(options.radius / domain.unit())) {
    front.expect_slow_steps();
  }

  void seed(const PointSource& source, Index number) {
    const Real sigma = static_cast<Real>(source.offset / domain_.unit());
    if (source.vertex != none) {
      seed_vertex(domain_.inside_vertex(source.vertex), sigma, number);
      return;
    }
    const Index s = domain_.inside_simplex(source.simplex);
    const std::array<double, N + 1> b = inside_coordinates(domain_, s, source);
    // To all simplices that have the corners it lies between: over a facet that holds the source
    // its height would come out as the square root of rounding.
    const auto* const corner = domain_.records()[s].corner;
    const std::size_t support = static_cast<std::size_t>(
        std::find_if(b.begin(), b.end(), [](double x) { return x > 0; }) - b.begin());
    for (const Index c : domain_.corners_at(corner[support])) {
      const auto& there = domain_.records()[c / sides].corner;
      std::array<double, N + 1> b_there{};
      bool holds = true;
      for (std::size_t i = 0; i <= N && holds; ++i) {
        if (b[i] == 0) continue;
        const auto at = std::find(std::begin(there), std::end(there), corner[i]);
        holds = at != std::end(there);
        if (holds) b_there[static_cast<std::size_t>(at - std::begin(there))] = b[i];
      }
      if (!holds) continue;
      rule_.seed_inside(c / sides, b_there, sigma, number);
    }
  }

  void run() {
    do {
      spread();
    } while (!front_.out_of_budget() && pass_vertices());
  }

  [[nodiscard]] const Rule& rule() const { return rule_; }

 private:
  static constexpr Index sides = N + 1;

  void seed_vertex(Index vertex, Real sigma, Index number) {
    for (const Index c : domain_.corners_at(vertex))
      rule_.seed_corner(c / sides, c % sides, sigma, number);
  }

  void spread() {
    const auto distance_of = [&](Index s) { return rule_.distance(s); };
    Index s = 0;
    for (;;) {
      while (front_.next(s, distance_of)) expand(s);
      if (!front_.share_spent() || !front_.take_stock(rule_.distance(s))) return;
      limit(front_.updates());
    }
  }

  /// One simplex, as far as the radius allows.
  void expand(Index s) {
    if (rule_.distance(s) > radius_) [[unlikely]]
      if (rule_.distance(s) - longest(s) > radius_) return;
    rule_.expand(s);
  }

  /// One or two updates a simplex are usual, ten are many. Lengths that no flat simplices have can
  /// make a path shorter each time around, without end: from 128 updates a simplex on they must
  /// gain more and more.
  void limit(std::size_t updates) {
    if (updates / 128 < domain_.simplex_count()) [[likely]]
      return;
    const double usual = 128 * static_cast<double>(domain_.simplex_count());
    const double more = static_cast<double>(updates) / usual;
    if (more > 1) rule_.set_patience(std::max(static_cast<Real>(2 - more), Real(1e-20)));
  }

  [[nodiscard]] Real longest(Index s) const {
    const auto& l = domain_.records()[s].length2;
    return std::sqrt(*std::max_element(std::begin(l), std::end(l)));
  }

  /// A path may pass a vertex where parts only touch: it bends there (a hinge of dimension 0).
  /// True if some simplex got a better label.
  bool pass_vertices() {
    bool any = false;
    for (const Index v : domain_.pinched()) any |= pass(v);
    return any;
  }
  bool pass(Index v) {
    Real best = std::numeric_limits<Real>::infinity();
    Index number = none;
    for (const Index c : domain_.corners_at(v)) {
      if (!front_.reached(c / sides)) continue;
      const Real d = rule_.corner_distance(c / sides, c % sides);
      if (d < best) best = d, number = front_.source(c / sides);
    }
    if (!(best < std::numeric_limits<Real>::infinity()) || best > radius_) return false;
    bool any = false;
    for (const Index c : domain_.corners_at(v)) {
      // Within rounding of its own path it stays with that one; else this would not end.
      const Real enough = best * (1 + 64 * std::numeric_limits<Real>::epsilon());
      if (front_.reached(c / sides) && rule_.corner_distance(c / sides, c % sides) <= enough)
        continue;
      any |= rule_.seed_corner(c / sides, c % sides, best, number);
    }
    return any;
  }

  const SimplicialComplex<Real, N>& domain_;
  Rule rule_;
  Front& front_;
  Real radius_;
};

}  // namespace plexway
