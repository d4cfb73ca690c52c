#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <random>
#include <vector>

#include <plexway/solve.hpp>

#include "data/pierced_layers.hpp"
#include "data/random_stacks.hpp"
#include "fuzz/fuzz_pierced.hpp"
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

// Two speeds where something is cut out of both, and many in coarse slabs: bench random_plans has
// more of them.

TEST_CASE("holes and cracks through the face between two speeds are never too near") {
  std::mt19937 random(3);
  for (const bool cracks : {false, true}) {
    double low = 0, high = 0, sum = 0, count = 0;
    for (int plans = 40; plans > 0;) {
      std::array<std::uint8_t, 16> bytes;
      for (std::uint8_t& b : bytes) b = static_cast<std::uint8_t>(random() >> 24);
      fuzz::Choices choices(bytes.data(), bytes.size());
      auto plan = fuzz::plan_of(choices);
      if (!plan) continue;
      if (cracks) plan->blocks = fuzz::slits_of(plan->blocks);
      bool from_crack = false;
      for (const auto& b : plan->blocks)
        from_crack |= cracks && std::abs(plan->source[0] - b.left) < 1e-9;
      if (from_crack) continue;
      const auto solved = fuzz::solve_pierced(*plan, choices);
      if (!solved) continue;
      --plans;
      for (std::size_t v = 0; v < solved->found.size(); ++v) {
        if (!(solved->truth[v] > 1e-12)) continue;
        const double off = solved->found[v] / solved->truth[v] - 1;
        low = std::min(low, off);
        high = std::max(high, off);
        sum += std::abs(off);
        ++count;
      }
    }
    CAPTURE(cracks, low, high, sum / count);
    CHECK(low > -5e-5);  // what the truth is good for; it was -.27
    // Set after seeing: 300 plans have .017 and 6e-6, .070 and 1.8e-4; 700 others .067 and .090.
    CHECK(high < (cracks ? .12 : .08));
    CHECK(sum / count < (cracks ? 1e-3 : 1e-4));
  }
}

TEST_CASE("vertices of coarse slabs do not miss head waves") {
  std::mt19937 random(5);
  std::size_t off = 0, far = 0, vertices = 0;
  double low = 0;
  for (int plans = 0; plans < 30; ++plans) {
    const samples::Stack stack = samples::random_stack(random, 20, .7, 1.5);
    const samples::StackDomain whole(stack);
    const auto& [domain, pieces, places] = whole;
    plexway::Index source = pieces[1].first_vertex;  // on a plane
    while (places[source][2] != stack.layers.z[0] || random() % 8 != 0)
      source = pieces[1].first_vertex + (source + 1 - pieces[1].first_vertex) % pieces[1].vertices;
    const auto field = plexway::solve(plexway::Serial{}, domain, plexway::PointSource::at(source));
    plexway::PropagateOptions near;
    near.radius = .5;
    const auto within =
        plexway::solve(plexway::Serial{}, domain, plexway::PointSource::at(source), near);
    for (std::size_t v = 0; v < places.size(); ++v) {
      const double truth = stack.layers.time(places[source], places[v]);
      CHECK(within.distance[v] >= field.distance[v] * (1 - 1e-12));
      CHECK((within.distance[v] <= near.radius || std::isinf(within.distance[v])));
      // What is near may be offered from beyond the radius.
      if (field.distance[v] <= near.radius)
        CHECK(within.distance[v] <= field.distance[v] * (1 + 1e-9));
      if (!(truth > 1e-12)) continue;
      const double by = field.distance[v] / truth - 1;
      low = std::min(low, by);
      off += by > 1e-3;
      far += by > 2e-2;
      ++vertices;
    }
  }
  CAPTURE(vertices, off, far, low);
  CHECK(low > -1e-12);
  CHECK(static_cast<double>(off) < 2e-4 * static_cast<double>(vertices));  // 2 % missed them
  CHECK(far == 0);
}

TEST_CASE("a source on the plane of thin slabs is known on both sides of it") {
  // Where the layers above and below are faster, ways through each of them are the shortest in
  // turn: vertices that are far from each other have to keep them all.
  std::mt19937 random(1);
  for (int plan = 0; plan <= 89; ++plan) {
    const samples::Stack stack = samples::random_stack(random, 20, .02, 1.5);
    std::vector<samples::Position> places;
    for (const auto& b : stack.blocks)
      places.insert(places.end(), b.positions.begin(), b.positions.end());
    const auto& planes = stack.layers.z;
    std::size_t source = 0;
    do {
      source = random() % places.size();
    } while (std::find(planes.begin(), planes.end(), places[source][2]) == planes.end());
    constexpr int hard[] = {5, 12, 26, 31, 34, 37, 89};
    if (std::find(std::begin(hard), std::end(hard), plan) == std::end(hard)) continue;
    const samples::StackDomain whole(stack);
    const auto field =
        plexway::solve(plexway::Serial{}, whole.domain,
                       plexway::PointSource::at(static_cast<plexway::Index>(source)));
    CHECK(field.complete);
    for (std::size_t v = 0; v < places.size(); ++v) {
      const double truth = stack.layers.time(places[source], places[v]);
      CAPTURE(plan, v, truth, field.distance[v]);
      CHECK(field.distance[v] >= truth * (1 - 1e-12));
      CHECK(field.distance[v] <= truth * (1 + 1e-6) + 1e-15);
    }
  }
}

// Of several sources the one that is told is the one that the distance is from.
TEST_CASE("sources that vertices of slabs are told are those of their distances") {
  std::mt19937 random(31);
  std::size_t vertices = 0, others = 0;
  double low = 0;
  for (int plans = 0; plans < 6; ++plans) {
    const samples::Stack stack = samples::random_stack(random, 8, plans % 2 == 0 ? .7 : .05, 1.5);
    const samples::StackDomain whole(stack);
    const auto time = [&](const plexway::PointSource& source, std::size_t v) {
      return source.offset + stack.layers.time(whole.places[source.vertex], whole.places[v]);
    };
    std::vector<plexway::PointSource> sources;
    for (int n = plans % 3 == 0 ? 2 : plans % 3 == 1 ? 5 : 30; n > 0; --n) {
      sources.push_back(
          plexway::PointSource::at(static_cast<plexway::Index>(random() % whole.places.size())));
      sources.back().offset = samples::between(random, 0, .3);
    }
    const auto field = plexway::solve(plexway::Serial{}, whole.domain, sources);
    for (std::size_t v = 0; v < whole.places.size(); ++v) {
      double truth = std::numeric_limits<double>::infinity();
      for (const auto& source : sources) truth = std::min(truth, time(source, v));
      if (!(truth > 1e-9)) continue;
      ++vertices;
      low = std::min(low, field.distance[v] / truth - 1);
      others += field.distance[v] < time(sources[field.label[v]], v) * (1 - 1e-5);
    }
  }
  CAPTURE(vertices, others, low);
  CHECK(low > -1e-9);
  CHECK(others <= 1);  // 30 of 2,400 before; one in 6,000 is left
}

}  // namespace mixed_speeds_test
