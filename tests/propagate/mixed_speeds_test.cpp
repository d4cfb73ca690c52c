#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include <plexway/executors/serial_mixed.hpp>

#include "mixed_domains.hpp"

// Pieces on which paths run at different speeds: Snell's law and head waves.

namespace {

using namespace mixed_domains;

/// Times where slowness is 1 and a line or plane has speed c: r and rho are the distances of the
/// two ends from it, x that of their feet. `direct`: without it.
double along_fast(double r, double rho, double x, double c, double direct) {
  if (c <= 1 || x < (r + rho) / std::sqrt(c * c - 1)) return direct;
  return std::min(direct, x / c + (r + rho) * std::sqrt(1 - 1 / (c * c)));
}

/// From height h over a line at speed v to depth d under it at speed w.
double refracted(double h, double d, double x, double v, double w) {
  double low = 0, high = x;
  const auto way = [&](double s) { return std::hypot(s, h) / v + std::hypot(x - s, d) / w; };
  for (int i = 0; i < 100; ++i) {
    const double a = low + (high - low) / 3, b = high - (high - low) / 3;
    (way(a) < way(b) ? high : low) = way(a) < way(b) ? b : a;
  }
  return way((low + high) / 2);
}

struct Errors {
  double mean = 0, worst = 0, low = 0;
};
Errors errors(const Domain& domain, Index source, const std::function<double(Index)>& exact) {
  const auto field = propagate(Serial{}, domain.complex, PointSource::at(source));
  Errors e;
  for (Index v = 0; v < domain.positions.size(); ++v) {
    const double truth = exact(v);
    if (truth < 1e-12) continue;
    const double off = (field.distance[v] / domain.move.scale - truth) / truth;
    e.mean += std::abs(off) / double(domain.positions.size());
    e.worst = std::max(e.worst, std::abs(off));
    e.low = std::min(e.low, off);
  }
  return e;
}
void check(const Errors& e, double mean, double worst) {
  CAPTURE(e.mean, e.worst, e.low);
  CHECK(e.mean < mean);
  CHECK(e.worst < worst);
  CHECK(e.low > -1e-9);
}

constexpr double speeds[] = {.3, .5, 1, 1.1, 2, 3};

}  // namespace

TEST_CASE("a skin of another speed on a block") {
  constexpr std::size_t n = 12;
  for (const double c : speeds)
    for (const Position& from :
         {Position{0, 0, 1}, Position{.25, .25, 10. / 12}, Position{.25, .5, .5}}) {
      Domain domain(1);
      const auto skin = domain.add(sheet({0, 0, 1}, {1, 0, 0}, {0, 1, 0}, n, n), c);
      const auto solid = domain.add(block({0, 0, 0}, {1, 1, 1}, n));
      domain.weld(skin, solid);
      CAPTURE(c, from[0], from[1], from[2]);
      check(errors(domain, domain.nearest(solid, from),
                   [&](Index v) {
                     const Position& p = domain.positions[v];
                     return along_fast(1 - from[2], 1 - p[2],
                                       std::hypot(p[0] - from[0], p[1] - from[1]), c,
                                       distance(from, p));
                   }),
            2e-4, 1e-2);
    }
}

TEST_CASE("a skin of another speed: finer is better") {
  double coarse = 0;
  for (const std::size_t n : {6, 12}) {
    Domain domain(0);
    const auto skin = domain.add(sheet({0, 0, 1}, {1, 0, 0}, {0, 1, 0}, n, n), 2);
    const auto solid = domain.add(block({0, 0, 0}, {1, 1, 1}, n));
    domain.weld(skin, solid);
    const Position from = {.5, .5, .5};
    const Errors e = errors(domain, domain.nearest(solid, from), [&](Index v) {
      const Position& p = domain.positions[v];
      return along_fast(.5, 1 - p[2], std::hypot(p[0] - .5, p[1] - .5), 2, distance(from, p));
    });
    if (n == 6)
      coarse = e.mean;
    else
      CHECK(e.mean < coarse / 2);
  }
}

TEST_CASE("two blocks of different speeds on a face") {
  constexpr std::size_t n = 8;
  for (const double c : {.5, 1.1, 2.})
    for (const Position& from : {Position{.25, .5, .5}, Position{1, .5, .5}, Position{0, 0, 0}}) {
      Domain domain(0);
      const auto one = domain.add(block({0, 0, 0}, {1, 1, 1}, n));
      const auto other = domain.add(block({1, 0, 0}, {2, 1, 1}, n), c);
      domain.weld(one, other);
      CAPTURE(c, from[0], from[1], from[2]);
      check(errors(domain, domain.nearest(one, from),
                   [&](Index v) {
                     const Position& p = domain.positions[v];
                     const double x = std::hypot(p[1] - from[1], p[2] - from[2]);
                     if (Domain::of(one, v))
                       return along_fast(1 - from[0], 1 - p[0], x, c, distance(from, p));
                     return refracted(1 - from[0], p[0] - 1, x, 1, c);
                   }),
            1e-4, 1e-2);
    }
}

TEST_CASE("a sheet of another speed stands on a block") {
  constexpr std::size_t n = 12;
  for (const double c : {.5, 1., 2., 3.})
    for (const Position& from : {Position{.5, 0, 1.5}, Position{.25, 0, .5}, Position{.5, 0, 1}}) {
      Domain domain(2);
      const auto plate = domain.add(sheet({.5, 0, 1}, {0, 1, 0}, {0, 0, 1}, n, n), c);
      const auto solid = domain.add(block({0, 0, 0}, {1, 1, 1}, n));
      domain.weld(plate, solid);
      const auto& foot = [](const Position& p) {
        return p[2] > 1 ? p[2] - 1 : std::hypot(p[0] - .5, 1 - p[2]);
      };
      const Index source = domain.nearest(from[2] > 1 ? plate : solid, from);
      CAPTURE(c, from[0], from[1], from[2]);
      check(errors(domain, source,
                   [&](Index v) {
                     const Position& p = domain.positions[v];
                     const double x = std::abs(p[1] - from[1]), r = foot(from), rho = foot(p);
                     const bool above = p[2] > 1 || (p[2] == 1 && Domain::of(plate, v));
                     if (!above && from[2] <= 1) return along_fast(r, rho, x, c, distance(from, p));
                     if (above && from[2] > 1) {
                       const double direct = distance(from, p) / c;
                       return c >= 1 ? direct : along_fast(r / c, rho / c, x / c, 1 / c, direct);
                     }
                     return above ? refracted(rho, r, x, c, 1) : refracted(r, rho, x, c, 1);
                   }),
            1e-4, 1e-2);
    }
}

TEST_CASE("pieces of any speeds never gain on themselves") {
  // A stack of skins and blocks; whatever a distance is, it is no less than at the greatest speed.
  for (const double c : {.1, .9, 1.5, 20.}) {
    Domain domain(3);
    const auto one = domain.add(block({0, 0, 0}, {1, 1, 1}, 4), c);
    const auto skin = domain.add(sheet({0, 0, 1}, {1, 0, 0}, {0, 1, 0}, 4, 4), 2);
    const auto other = domain.add(block({0, 0, 1}, {1, 1, 2}, 4), .5);
    const auto fin = domain.add(sheet({-1, 0, 1}, {1, 0, 0}, {0, 1, 0}, 4, 4), 7);
    domain.weld(one, skin);
    domain.weld(other, skin);
    domain.weld(one, other);
    domain.weld(fin, skin);
    domain.weld(fin, one);
    const double fastest = std::max(7., c);
    for (const Index source : {one.vertex(3), skin.vertex(7), fin.vertex(0), other.vertex(60)}) {
      const auto field = propagate(Serial{}, domain.complex, PointSource::at(source));
      for (Index v = 0; v < domain.positions.size(); ++v) {
        const double least = distance(domain.positions[source], domain.positions[v]) / fastest;
        CHECK(field.distance[v] / domain.move.scale >= least * (1 - 1e-9));
        CHECK(field.distance[v] < infinity);
      }
    }
  }
}
