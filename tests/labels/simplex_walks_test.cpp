#include <catch2/catch.hpp>

#include <cstddef>
#include <random>
#include <vector>

#include "complexes/simplicial/elimination.hpp"
#include "labels/simplex_obstacles.hpp"
#include "labels/simplicial/simplex_string_rule.hpp"

namespace plexway::testing::simplex_walks_test {

namespace {

/// Points of a flat domain in the coordinates of the grid it was made of.
template <int N>
class InGrid {
 public:
  using Point = std::array<double, N>;

  InGrid(const Obstacles<N>& obstacles, const SimplicialComplex<double, N>& domain)
      : obstacles_(obstacles), unit_(domain.unit()) {
    Index v = 0;
    while (domain.corners_at(domain.inside_vertex(v)).empty()) ++v;
    const Point there = obstacles.mapped(obstacles.grid.position(v));
    middle_ = plus(there, -unit_, domain.flat()->positions[domain.inside_vertex(v)]);
  }
  [[nodiscard]] Point of(const Point& inside) const {
    double m[N][N + 1];
    for (std::size_t d = 0; d < N; ++d) {
      for (std::size_t e = 0; e < N; ++e) m[d][e] = obstacles_.map[d][e];
      m[d][N] = unit_ * inside[d] + middle_[d];
    }
    eliminate(m);
    Point p;
    for (std::size_t d = 0; d < N; ++d) p[d] = m[d][N] / m[d][d];
    return p;
  }
  /// How much of a straight way is inside a block, by more than `deep`.
  [[nodiscard]] double blocked(const Point& from, const Point& to, double deep = 1e-6) const {
    const Point p = of(from), q = of(to);
    double most = 0;
    for (const auto& block : obstacles_.blocks) {
      double begin = 0, end = 1;
      for (std::size_t d = 0; d < N; ++d) {
        const double low = obstacles_.low(block, d) + deep - p[d];
        const double high = obstacles_.high(block, d) - deep - p[d], way = q[d] - p[d];
        if (std::abs(way) < 1e-14) {
          if (low > 0 || high < 0) end = begin;
          continue;
        }
        begin = std::max(begin, std::min(low / way, high / way));
        end = std::min(end, std::max(low / way, high / way));
      }
      most = std::max(most, (end - begin) * distance_between(p, q));
    }
    return most;
  }

 private:
  const Obstacles<N>& obstacles_;
  double unit_;
  Point middle_;
};

struct Walked {
  std::size_t offers = 0, ended = 0;  ///< ended: the string could not be pulled taut
  double blocked = 0;                 ///< the most of a leg that is in an obstacle
};

/// Strings from centre to centre along random walks: not the shortest ways, with many ends of
/// edges and ties.
template <int N>
Walked walk(unsigned seed, std::size_t cells, unsigned most, int walks, int steps) {
  struct NoFront {};
  const Obstacles<N> obstacles = random_obstacles<N>(seed, cells, most);
  const auto domain = obstacles.template complex<double>();
  REQUIRE(domain.flat() != nullptr);
  const FlatDomain<N>& flat = *domain.flat();
  const InGrid<N> grid(obstacles, domain);
  NoFront front;
  const SimplexStringRule<double, N, NoFront> rule(domain, front, nullptr, nullptr);
  std::mt19937 random(seed * 7919 + 1);
  Walked all;
  for (int n = 0; n < walks; ++n) {
    Index s = below(random, static_cast<Index>(domain.simplex_count()));
    std::size_t in = N + 1;
    auto label = point_label<N>(flat.centres[s], 0);
    label.centre = 0;
    for (int k = 0; k < steps; ++k) {
      const std::size_t facet = below(random, N + 1);
      const Index across = domain.records()[s].across[facet];
      if (across == none || facet == in) continue;
      const Index t = across >> FacetAcross::simplex_shift;
      SimplexStringLabel<N> next;
      if (!rule.offer_around(label, s, facet, t, 1e300, next)) break;
      ++all.offers;
      all.ended += next.bends == 0 && next.sigma > label.sigma;
      auto at = next.source;
      for (Index i = 0; i <= next.bends; ++i) {
        const auto to =
            i < next.bends ? flat.faces[next.face[i]].at(next.along[i]) : flat.centres[t];
        const double blocked = grid.blocked(at, to);
        CAPTURE(N, seed, n, k, i, blocked);
        if (blocked > 1e-5) FAIL_CHECK("a string goes through an obstacle");
        all.blocked = std::max(all.blocked, blocked);
        at = to;
      }
      if (all.blocked > 1e-5) return all;
      label = next;
      in = across & FacetAcross::facet_mask;
      s = t;
    }
  }
  return all;
}

}  // namespace

TEST_CASE("strings that are pulled along any way stay in the domain") {
  // Strings got through an edge here, where several points of a triangle lie in one place or one
  // over another.
  for (const unsigned seed : {23u, 56u, 63u, 151u})
    CHECK(walk<3>(seed, 8, 4, 200, 200).blocked < 1e-5);
  for (unsigned seed = 1; seed <= 10; ++seed) {
    CHECK(walk<2>(seed, 12, 4, 50, 200).blocked < 1e-5);
    CHECK(walk<4>(seed, 5, 3, 10, 60).blocked < 1e-5);
  }
}

TEST_CASE("strings that need too much are rare") {
  const Walked w = walk<3>(63, 8, 4, 200, 200);
  CAPTURE(w.offers, w.ended);
  CHECK(w.offers > 10000);
  CHECK(w.ended < w.offers / 100);
}

}  // namespace plexway::testing::simplex_walks_test
