#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include <plexway/solve.hpp>

#include "mixed_domains.hpp"

namespace mixed_speeds_test {

// Pieces on which paths run at different speeds: Snell's law and head waves.

namespace {

using namespace mixed_domains;

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
      Welded domain(1);
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
            1e-12, 1e-11);
    }
}

TEST_CASE("two blocks of different speeds on a face") {
  constexpr std::size_t n = 8;
  for (const double c : {.5, 1.1, 2.})
    for (const Position& from : {Position{.25, .5, .5}, Position{1, .5, .5}, Position{0, 0, 0}}) {
      Welded domain(0);
      const auto one = domain.add(block({0, 0, 0}, {1, 1, 1}, n));
      const auto other = domain.add(block({1, 0, 0}, {2, 1, 1}, n), c);
      domain.weld(one, other);
      CAPTURE(c, from[0], from[1], from[2]);
      check(errors(domain, domain.nearest(one, from),
                   [&](Index v) {
                     const Position& p = domain.positions[v];
                     const double x = std::hypot(p[1] - from[1], p[2] - from[2]);
                     if (Welded::of(one, v))
                       return along_fast(1 - from[0], 1 - p[0], x, c, distance(from, p));
                     return refracted(1 - from[0], p[0] - 1, x, 1, c);
                   }),
            1e-12, 1e-11);
    }
}

TEST_CASE("a sheet of another speed stands on a block") {
  constexpr std::size_t n = 12;
  for (const double c : {.5, 1., 2., 3.})
    for (const Position& from : {Position{.5, 0, 1.5}, Position{.25, 0, .5}, Position{.5, 0, 1}}) {
      Welded domain(2);
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
                     const bool above = p[2] > 1 || (p[2] == 1 && Welded::of(plate, v));
                     if (!above && from[2] <= 1) return along_fast(r, rho, x, c, distance(from, p));
                     if (above && from[2] > 1) {
                       const double direct = distance(from, p) / c;
                       return c >= 1 ? direct : along_fast(r / c, rho / c, x / c, 1 / c, direct);
                     }
                     return above ? refracted(rho, r, x, c, 1) : refracted(r, rho, x, c, 1);
                   }),
            1e-12, 1e-11);
    }
}

TEST_CASE("a skin of another speed on a ball") {
  // The ball is a polyhedron: its facets alone make distances 1e-3 short at 16 cells across.
  const Block b = ball(16);
  const Sheet s = skin_of(b);
  for (const double c : {.3, 1., 1.5, 3.})
    for (const double r : {1., .5}) {
      Welded domain(0);
      const auto solid = domain.add(b);
      const auto skin = domain.add(s, c);
      domain.weld(solid, skin);
      Index source = 0;
      const auto off = [&](Index v) {
        return distance(domain.positions[v], {.3 * r, .5 * r, .81 * r});
      };
      for (Index v = 0; v < solid.vertices; ++v)
        if (off(v) < off(source)) source = v;
      const Errors e = errors(domain, source, [&](Index v) {
        return by_the_skin(domain.positions[source], domain.positions[v], c);
      });
      CAPTURE(c, r, e.mean, e.worst, e.low);
      CHECK(e.mean < 2.5e-3);
      CHECK(e.worst < 8e-2);  // `fast`: 1.5e-2 while solids had a rule of their own here
    }
}

TEST_CASE("a sheet that is bent to a cylinder stands on a block") {
  // Of 32 facets, more than strings take: pieces share vertices and middles of edges.
  constexpr std::size_t n = 8;
  constexpr double radius = 1.2;
  for (const double c : {.5, 1., 2., 3.})
    for (const bool from_sheet : {false, true}) {
      Welded domain(4);
      Sheet s = sheet({.5, 0, 1}, {0, 1, 0}, {0, 0, 1}, n, 32);
      const std::vector<Position> flat = s.positions;
      for (Position& p : s.positions) {
        const double turn = (p[2] - 1) / radius;
        p = {.5 + radius * (1 - std::cos(turn)), p[1], 1 + radius * std::sin(turn)};
      }
      const auto plate = domain.add(s, c);
      const auto solid = domain.add(block({0, 0, 0}, {1, 1, 1}, n));
      domain.weld(plate, solid);
      const auto foot = [&](Index v) {
        const Position& p = domain.positions[v];
        return Welded::of(plate, v) ? flat[v][2] - 1 : std::hypot(p[0] - .5, 1 - p[2]);
      };
      Index source = domain.nearest(solid, {.25, 0, .5});
      for (Index v = 0; v < plate.vertices && from_sheet; ++v)
        if (distance(flat[v], {.5, 0, 1.5}) < 1e-9) source = v;
      const Errors e = errors(domain, source, [&](Index v) {
        const Position &p = domain.positions[source], &q = domain.positions[v];
        const double x = std::abs(p[1] - q[1]), r = foot(source), rho = foot(v);
        if (Welded::of(plate, v) != from_sheet)
          return from_sheet ? refracted(r, rho, x, c, 1) : refracted(rho, r, x, c, 1);
        if (!from_sheet) return along_fast(r, rho, x, c, distance(p, q));
        const double direct = std::hypot(x, r - rho) / c;
        return c >= 1 ? direct : along_fast(r / c, rho / c, x / c, 1 / c, direct);
      });
      CAPTURE(c, from_sheet, e.mean, e.worst, e.low);
      CHECK(e.mean < 1e-3);
      CHECK(e.worst < 2e-2);
      CHECK(e.low > -5e-5);  // a facet is that much shorter than its arc
    }
}

TEST_CASE("pieces of any speeds never gain on themselves") {
  // A stack of skins and blocks; whatever a distance is, it is no less than at the greatest speed.
  for (const double c : {.1, .9, 1.5, 20.}) {
    Welded domain(3);
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
      const auto field = solve(Serial{}, domain.complex, PointSource::at(source));
      for (Index v = 0; v < domain.positions.size(); ++v) {
        const double least = distance(domain.positions[source], domain.positions[v]) / fastest;
        CHECK(field.distance[v] / domain.move.scale >= least * (1 - 1e-9));
        CHECK(field.distance[v] < infinity);
      }
    }
  }
}

TEST_CASE("in single precision welds make corners and speeds refract as well") {
  // Two rooms with a door, the second one floor up a block with a fast skin.
  for (const float c : {1.F, 2.F}) {
    Block b = block({0, 0, 0}, {1, 1, 1}, 10);
    Sheet s = sheet({0, 0, 1}, {1, 0, 0}, {0, 1, 0}, 10, 10);
    const Sheet beyond = sheet({1, 0, 1}, {1, 0, 0}, {0, .5, 0}, 10, 5);
    const auto timed = [&](const Sheet& sheet, double speed) {
      std::vector<Position> at = sheet.positions;
      for (Position& p : at)
        for (double& x : p) x /= speed;
      return TriangleMesh<float>(at, sheet.faces);
    };
    MixedComplex<float> domain;
    const auto solid = domain.add(TetMesh<float>(b.positions, b.tets), b.positions);
    const auto skin = domain.add(timed(s, c), s.positions);
    const auto out = domain.add(timed(beyond, c), beyond.positions);
    CHECK(domain.weld(solid, skin, {.tolerance = 1e-6}) == 121);
    CHECK(domain.weld(skin, out, {.tolerance = 1e-6}) == 6);
    const Position from = {.5, .9, 1};
    Index source = none;
    for (Index v = 0; v < s.positions.size(); ++v)
      if (distance(s.positions[v], from) < 1e-6) source = skin.vertex(v);
    REQUIRE(source != none);
    const auto field = solve(Serial{}, domain, PointSource::at(source));
    const auto check = [&](double d, double truth) {
      CAPTURE(c, d, truth);
      CHECK(d == Approx(truth).epsilon(c == 1 ? 1e-5 : 1e-2).margin(1e-6));
    };
    for (Index v = 0; v < b.positions.size(); ++v) {
      const Position& p = b.positions[v];
      check(field.distance[solid.vertex(v)],
            along_fast(0, 1 - p[2], std::hypot(p[0] - from[0], p[1] - from[1]), c,
                       distance(from, p)));
    }
    for (Index v = 0; v < beyond.positions.size(); ++v) {
      const Position &p = beyond.positions[v], corner = {1, .5, 1};
      const double y = from[1] + (p[1] - from[1]) * (1 - from[0]) / (p[0] - from[0]);
      const double way = y <= .5 ? distance(from, p) : distance(from, corner) + distance(corner, p);
      check(field.distance[out.vertex(v)], way / c);
    }
  }
}

}  // namespace mixed_speeds_test
