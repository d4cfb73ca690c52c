#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/solve.hpp>

#include "labels/solving.hpp"
#include "mixed_domains.hpp"

namespace mixed_test {

namespace {

using namespace mixed_domains;

constexpr unsigned motions = 4;

// Unfolded about an edge along y: places along it and distances from it.
double around(double y0, double h0, double y1, double h1) { return std::hypot(y0 - y1, h0 + h1); }

}  // namespace

TEST_CASE("a rod on a sheet on the edge of a block") {
  for (unsigned seed = 0; seed < motions; ++seed) {
    Welded domain(seed);
    const auto wire = domain.add(rod({{-2, .5, 1}, {-1.5, .5, 1}, {-1, .5, 1}}));
    const auto plate = domain.add(sheet({-1, 0, 1}, {1, 0, 0}, {0, 1, 0}, 4, 4));
    const auto solid = domain.add(block({0, 0, 0}, {1, 1, 1}, 4));
    CHECK(domain.weld(wire, plate) == 1);
    CHECK(domain.weld(plate, solid) == 5);
    CHECK(domain.complex.summary().hinges == std::array<std::size_t, 3>{1, 4, 0});
    const auto place = [&](Index v) -> const Position& { return domain.positions[v]; };
    const auto off_edge = [&](Index v) { return std::hypot(place(v)[0], place(v)[2] - 1); };
    CAPTURE(seed);
    // From the rod's far end.
    CHECK(domain.worst(wire.vertex(0), [&](Index v) {
      if (Welded::of(wire, v)) return place(v)[0] + 2;
      if (Welded::of(plate, v)) return 1 + std::hypot(place(v)[0] + 1, place(v)[1] - .5);
      return 1 + around(.5, 1, place(v)[1], off_edge(v));
    }) < 1e-9);
    // From a corner and from the inside of the block.
    for (const Position& from : {Position{1, 0, 0}, Position{.5, .75, .25}}) {
      const Index source = domain.nearest(solid, from);
      const double h = off_edge(source);
      CHECK(domain.worst(source, [&](Index v) {
        if (Welded::of(solid, v)) return distance(from, place(v));
        if (Welded::of(plate, v)) return around(from[1], h, place(v)[1], -place(v)[0]);
        return around(from[1], h, .5, 1) - 1 - place(v)[0];
      }) < 1e-9);
    }
  }
}

TEST_CASE("a sheet glued on the face of a block and beyond it") {
  for (unsigned seed = 0; seed < motions; ++seed) {
    Welded domain(seed);
    const auto plate = domain.add(sheet({-1, 0, 1}, {2, 0, 0}, {0, 1, 0}, 8, 4));
    const auto solid = domain.add(block({0, 0, 0}, {1, 1, 1}, 4));
    CHECK(domain.weld(plate, solid) == 25);
    CHECK(domain.complex.summary().hinges == std::array<std::size_t, 3>{0, 0, 32});
    const auto place = [&](Index v) -> const Position& { return domain.positions[v]; };
    const auto exact = [&](const Position& from, Index v) {
      const Position& to = place(v);
      const bool out = from[0] < 0, to_out = to[0] < 0;
      if (out == to_out) return distance(from, to);
      const Position &outside = out ? from : to, &inside = out ? to : from;
      return around(outside[1], -outside[0], inside[1], std::hypot(inside[0], 1 - inside[2]));
    };
    CAPTURE(seed);
    for (const Position& from : {Position{-1, .5, 1}, Position{-.5, 0, 1}}) {
      const Index source = domain.nearest(plate, from);
      CHECK(domain.worst(source, [&](Index v) { return exact(from, v); }) < 1e-9);
    }
    for (const Position& from : {Position{1, .5, 0}, Position{.5, .25, .5}}) {
      const Index source = domain.nearest(solid, from);
      CHECK(domain.worst(source, [&](Index v) { return exact(from, v); }) < 1e-9);
    }
  }
}

TEST_CASE("a rod through a sheet") {
  for (unsigned seed = 0; seed < motions; ++seed) {
    Welded domain(seed);
    const auto plate = domain.add(sheet({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, 6, 6));
    const auto wire = domain.add(rod({{0, 0, -1}, {0, 0, 0}, {0, 0, 1}, {0, 0, 2}}));
    CHECK(domain.weld(plate, wire) == 1);
    const auto place = [&](Index v) -> const Position& { return domain.positions[v]; };
    CAPTURE(seed);
    CHECK(domain.worst(wire.vertex(3), [&](Index v) {
      if (Welded::of(wire, v)) return 2 - place(v)[2];
      return 2 + std::hypot(place(v)[0], place(v)[1]);
    }) < 1e-9);
    const Index source = domain.nearest(plate, {-1, 1. / 3, 0});
    CHECK(domain.worst(source, [&](Index v) {
      if (Welded::of(plate, v)) return distance(place(source), place(v));
      return std::hypot(1, 1. / 3) + std::abs(place(v)[2]);
    }) < 1e-9);
  }
}

TEST_CASE("two blocks joined by a wire") {
  for (unsigned seed = 0; seed < motions; ++seed) {
    Welded domain(seed);
    const auto one = domain.add(block({0, 0, 0}, {1, 1, 1}, 3));
    const auto other = domain.add(block({3, 0, 0}, {4, 1, 1}, 3));
    const auto wire = domain.add(rod({{1, 1, 1}, {2, 2, 1}, {2, 0, 0}, {3, 0, 0}}));
    CHECK(domain.weld(one, wire) == 1);
    CHECK(domain.weld(wire, other) == 1);
    const auto place = [&](Index v) -> const Position& { return domain.positions[v]; };
    const double legs[3] = {std::sqrt(2.), std::sqrt(5.), 1};
    const double along[4] = {0, legs[0], legs[0] + legs[1], legs[0] + legs[1] + legs[2]};
    CAPTURE(seed);
    const Index source = domain.nearest(one, {0, 0, 1. / 3});
    const double exit = distance(place(source), {1, 1, 1});
    CHECK(domain.worst(source, [&](Index v) {
      if (Welded::of(one, v)) return distance(place(source), place(v));
      if (Welded::of(wire, v)) return exit + along[v - wire.first_vertex];
      return exit + along[3] + distance({3, 0, 0}, place(v));
    }) < 1e-9);
    CHECK(domain.worst(wire.vertex(1), [&](Index v) {
      if (Welded::of(one, v)) return legs[0] + distance({1, 1, 1}, place(v));
      if (Welded::of(wire, v)) return std::abs(along[v - wire.first_vertex] - along[1]);
      return along[3] - along[1] + distance({3, 0, 0}, place(v));
    }) < 1e-9);
  }
}

TEST_CASE("a fan of three sheets on one edge") {
  for (unsigned seed = 0; seed < motions; ++seed) {
    Welded domain(seed);
    std::vector<Welded::Piece> blades;
    for (int k = 0; k < 3; ++k) {
      const double a = 2.1 * k + .3;
      blades.push_back(
          domain.add(sheet({0, 0, 0}, {std::cos(a), 0, std::sin(a)}, {0, 2, 0}, 3, 5)));
    }
    // A chain of welds is enough: a path may leave a blade by the edge it came in by.
    CHECK(domain.weld(blades[0], blades[1]) == 6);
    CHECK(domain.weld(blades[1], blades[2]) == 6);
    const auto place = [&](Index v) -> const Position& { return domain.positions[v]; };
    const auto off_edge = [&](Index v) { return std::hypot(place(v)[0], place(v)[2]); };
    CAPTURE(seed);
    for (const auto& blade : blades)
      for (const Index own : {Index(20), Index(15), Index(0), Index(2)}) {
        const Index source = blade.vertex(own);
        CHECK(domain.worst(source, [&](Index v) {
          if (Welded::of(blade, v)) return distance(place(source), place(v));
          return around(place(source)[1], off_edge(source), place(v)[1], off_edge(v));
        }) < 1e-9);
      }
  }
}

TEST_CASE("two blocks glued on a face are one") {
  for (unsigned seed = 0; seed < motions; ++seed) {
    Welded domain(seed);
    const auto one = domain.add(block({0, 0, 0}, {1, 1, 1}, 3));
    const auto other = domain.add(block({1, 0, 0}, {2, 1, 1}, 3));
    CHECK(domain.weld(one, other) == 16);
    CHECK(domain.complex.summary().hinges == std::array<std::size_t, 3>{0, 0, 18});
    for (const Index source : {one.vertex(0), one.vertex(21), other.vertex(63), other.vertex(5)})
      CHECK(domain.worst(source, [&](Index v) {
        return distance(domain.positions[source], domain.positions[v]);
      }) < 1e-9);
  }
}

TEST_CASE("blocks that share an edge are joined by it whichever comes first") {
  Welded domain(0);
  const auto one = domain.add(block({0, 0, 0}, {1, 1, 1}, 3));
  const auto other = domain.add(block({1, 0, 1}, {2, 1, 2}, 3));
  CHECK(domain.weld(one, other) == 4);
  CHECK(domain.complex.summary().hinges == std::array<std::size_t, 3>{0, 3, 0});
  const auto off_edge = [&](Index v) {
    const Position& p = domain.positions[v];
    return std::hypot(p[0] - 1, p[2] - 1);
  };
  for (const Index source : {one.vertex(0), one.vertex(22), other.vertex(63), other.vertex(40)})
    CHECK(domain.worst(source, [&](Index v) {
      const bool same = Welded::of(one, v) == Welded::of(one, source);
      const Position &p = domain.positions[source], &q = domain.positions[v];
      return same ? distance(p, q) : around(p[1], off_edge(source), q[1], off_edge(v));
    }) < 1e-9);
}

TEST_CASE("welding by nearness is the same from both sides, and refuses too much") {
  const Sheet big = sheet({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 1, 1);
  Sheet twice = big;  // a second sheet whose vertices lie where those of the first do
  for (const auto& f : big.faces) twice.faces.push_back({f[0] + 4, f[1] + 4, f[2] + 4});
  twice.positions.insert(twice.positions.end(), big.positions.begin(), big.positions.end());
  for (const bool turned : {false, true}) {
    Welded domain(0);
    const auto a = domain.add(turned ? twice : big), b = domain.add(turned ? big : twice);
    CHECK(domain.weld(a, b) == 8);
    CHECK(domain.worst(a.vertex(0), [&](Index v) {
      return distance(domain.positions[v], {0, 0, 0});
    }) < 1e-9);
  }
  Welded domain(0);
  const auto fine = domain.add(sheet({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 12, 12));
  const auto coarse = domain.add(big);
  CHECK_THROWS_AS(domain.complex.weld(fine, coarse, {.tolerance = .6}), UsageError);
  CHECK(domain.complex.weld(fine, coarse, {.tolerance = .01}) == 4);
}

TEST_CASE("parts that are not welded are not reached") {
  Welded domain(0);
  const auto plate = domain.add(sheet({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 2, 2));
  const auto solid = domain.add(block({0, 0, 1}, {1, 1, 2}, 2));
  const auto wire = domain.add(rod({{0, 0, 0}, {0, 0, -1}}));
  CHECK(domain.weld(plate, solid) == 0);
  CHECK(domain.weld(plate, wire) == 1);
  CHECK(domain.worst(wire.vertex(1), [&](Index v) {
    const Position& p = domain.positions[v];
    if (Welded::of(solid, v)) return infinity;
    return Welded::of(wire, v) ? p[2] + 1 : 1 + std::hypot(p[0], p[1]);
  }) < 1e-12);
}

TEST_CASE("several sources, offsets, radius and points of simplices in a mixed domain") {
  Welded domain(0);
  const auto plate = domain.add(sheet({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 2, 2));
  const auto wire = domain.add(rod({{1, 1, 0}, {2, 1, 0}, {4, 1, 0}}));
  domain.weld(plate, wire);
  const PointSource sources[] = {PointSource::in(wire.simplex(1), {.5, .5}),
                                 {.vertex = plate.vertex(0), .offset = .25}};
  const auto field = plexway::solve(Serial{}, domain.complex, sources, {});
  REQUIRE(field.label.size() == field.distance.size());
  for (Index v = 0; v < domain.positions.size(); ++v) {
    const Position& p = domain.positions[v];
    const bool on_wire = Welded::of(wire, v);
    const double first = on_wire ? std::abs(p[0] - 3) : 2 + std::hypot(p[0] - 1, p[1] - 1);
    const double second = .25 + (on_wire ? std::sqrt(2.) + p[0] - 1 : std::hypot(p[0], p[1]));
    CHECK(field.distance[v] == Approx(std::min(first, second)));
    CHECK(field.label[v] == (first < second ? 0u : 1u));
  }
  PropagateOptions near;
  near.radius = 1.5;
  const auto part = plexway::solve(Serial{}, domain.complex, PointSource::at(wire.vertex(1)), near);
  CHECK(part.distance[wire.vertex(0)] == Approx(1));
  CHECK(part.distance[plate.vertex(7)] == Approx(1.5));
  CHECK(part.distance[plate.vertex(0)] == infinity);
  CHECK(part.label.empty());
}

TEST_CASE("solving a mixed domain again gives the same bits") {
  Welded domain(3);
  const auto plate = domain.add(sheet({-1, 0, 1}, {1, 0, 0}, {0, 1, 0}, 4, 4));
  const auto solid = domain.add(block({0, 0, 0}, {1, 1, 1}, 4));
  domain.weld(plate, solid);
  Workspace<double> workspace;
  const PointSource source[] = {PointSource::at(plate.vertex(1))}, other[] = {PointSource::at(0)};
  plexway::testing::check_again(workspace, domain.complex, source, other);
}

TEST_CASE("what a mixed domain refuses") {
  MixedComplex<double> domain;
  const Sheet s = sheet({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 1, 1);
  const auto a = domain.add(TriangleMesh<double>(s.positions, s.faces), s.positions);
  const auto b = domain.add(TriangleMesh<double>(s.positions, s.faces));
  const auto too_few = std::span(s.positions).first(3);
  CHECK_THROWS_AS(domain.add(TriangleMesh<double>(s.positions, s.faces), too_few), UsageError);
  CHECK_THROWS_AS(domain.weld(a, b), UsageError);  // no positions
  CHECK_THROWS_AS(domain.weld(a, a), UsageError);
  WeldOptions negative;
  negative.tolerance = -1;
  CHECK_THROWS_AS(domain.weld(a, b, negative), UsageError);
  const std::array<Index, 2> wrong[] = {{0, 9}};
  CHECK_THROWS_AS(domain.weld(a, b, wrong), UsageError);
  CHECK_THROWS_AS(a.vertex(4), UsageError);
  CHECK_THROWS_AS(a.simplex(2), UsageError);
  CHECK_THROWS_AS(plexway::solve(Serial{}, domain, PointSource::at(8)), UsageError);
  CHECK_THROWS_AS(plexway::solve(Serial{}, domain, PointSource::in(0, {.5, .6, 0})), UsageError);
  PropagateOptions options;
  options.schedule = Schedule::priority;
  CHECK_THROWS_AS(plexway::solve(Serial{}, domain, PointSource::at(0), options), UsageError);
  const std::array<std::array<Index, 4>, 1> tet = {{{0, 1, 2, 3}}};
  const std::array<std::array<double, 6>, 1> lengths = {{{1, 1, 1, 1, 1, 1}}};
  CHECK_THROWS_AS(domain.add(TetMesh<double>(4, tet, lengths)), UsageError);
  const std::array<Index, 2> right[] = {{0, 0}, {3, 3}};
  CHECK(domain.weld(a, b, right) == 2);
  CHECK(plexway::solve(Serial{}, domain, PointSource::at(0)).distance[7] == Approx(std::sqrt(2.)));
}

// Many wires in a solid.

namespace {

/// Wires along lines of vertices of a block, whose inner vertices are moved at random.
struct Wired {
  Wired(std::size_t n, std::size_t wires, double speed, unsigned seed) : domain(seed), c(speed) {
    std::mt19937 random(seed + 1);
    std::uniform_real_distribution<double> uniform(-.15 / double(n), .15 / double(n));
    Block all = block({0, 0, 0}, {1, 1, 1}, n);
    for (Position& p : all.positions)
      for (double& x : p)
        if (x > 1e-9 && x < 1 - 1e-9) x += uniform(random);
    solid = domain.add(all);
    for (std::size_t w = 0; w < wires; ++w) {
      const std::size_t m = n + 1, i = random() % m, j = random() % m, axis = random() % 3;
      std::vector<Position> line;
      for (std::size_t k = 0; k < m; ++k) {
        const std::array<std::size_t, 3> at[3] = {{i, j, k}, {k, i, j}, {j, k, i}};
        line.push_back(all.positions[(at[axis][0] * m + at[axis][1]) * m + at[axis][2]]);
      }
      rods.push_back(domain.add(rod(line), speed));
      domain.weld(solid, rods.back());
    }
  }

  /// Legs are straight in the block or along wires, which they come to and leave at vertices and at
  /// `parts` - 1 points of each edge: as many as are needed.
  [[nodiscard]] std::vector<double> times(Index source, std::size_t parts) const {
    std::vector<Position> at(domain.positions.begin(), domain.positions.end());
    const std::size_t vertices = at.size();
    std::vector<std::array<Index, 2>> edges;  // along wires
    for (const auto& rod : rods)
      for (Index v = rod.first_vertex + 1; v < rod.first_vertex + rod.vertices; ++v) {
        Index last = v - 1;
        for (std::size_t k = 1; k < parts; ++k) {
          const double share = double(k) / double(parts);
          Position p;
          for (std::size_t i = 0; i < 3; ++i)
            p[i] = at[v - 1][i] + share * (at[v][i] - at[v - 1][i]);
          at.push_back(p);
          edges.push_back({last, Index(at.size() - 1)});
          last = Index(at.size() - 1);
        }
        edges.push_back({last, v});
      }
    std::vector<std::vector<Index>> beside(at.size());
    for (const auto& [v, w] : edges) beside[v].push_back(w), beside[w].push_back(v);
    std::vector<double> time(at.size(), infinity);
    std::vector<Index> open = {source};
    for (Index v = solid.vertices; v < at.size(); ++v) open.push_back(v);
    time[source] = 0;
    while (!open.empty()) {
      const auto next = std::min_element(open.begin(), open.end(),
                                         [&](Index v, Index w) { return time[v] < time[w]; });
      const Index u = *next;
      *next = open.back();
      open.pop_back();
      for (Index v = 0; v < solid.vertices; ++v)
        time[v] = std::min(time[v], time[u] + distance(at[u], at[v]));
      for (const Index v : open) time[v] = std::min(time[v], time[u] + distance(at[u], at[v]));
      for (const Index v : beside[u])
        time[v] = std::min(time[v], time[u] + distance(at[u], at[v]) / c);
    }
    time.resize(vertices);
    return time;
  }

  Welded domain;
  double c;
  Welded::Piece solid{};
  std::vector<Welded::Piece> rods;
};

}  // namespace

TEST_CASE("wires of any speed in a block") {
  for (const double c : {.5, 1., 2., 5.})
    for (unsigned seed = 0; seed < 3; ++seed) {
      const Wired wired(8, 20, c, seed);
      const Index source = static_cast<Index>(wired.solid.vertices / 2 + 3 + seed);
      const std::vector<double> times = wired.times(source, c > 1 ? 8 : 1);
      const Errors e = errors(wired.domain, source, [&](Index v) { return times[v]; });
      CAPTURE(c, seed, e.mean, e.worst, e.low);
      // Where wires cross, strings of single vertices are lost; and the truth is coarse.
      CHECK(e.mean < (c > 1 ? 5e-4 : 1e-14));
      CHECK(e.worst < (c > 1 ? 2e-2 : 1e-12));
      CHECK(e.low > (c > 1 ? -2e-3 : -1e-12));
    }
}

TEST_CASE("wires hear of each other at a vertex of a solid that nothing else gains by") {
  // Three wires meet in the corner of a block; one of them reaches it long before the block does.
  Welded domain(5);
  const auto solid = domain.add(block({0, 0, 0}, {1, 1, 1}, 4));
  const auto to = domain.add(rod({{1, 0, 0}, {.75, 0, 0}, {.5, 0, 0}, {.25, 0, 0}, {0, 0, 0}}), 8);
  const auto up = domain.add(rod({{0, 0, 0}, {0, 0, .25}, {0, 0, .5}, {0, 0, .75}, {0, 0, 1}}), 8);
  const auto out = domain.add(rod({{0, 0, 0}, {0, -1, 0}, {0, -2, 0}}), 2);
  for (const auto& wire : {to, up, out}) domain.weld(solid, wire);
  const auto field = solve(Serial{}, domain.complex, PointSource::at(to.vertex(0)));
  const auto time = [&](Index v) { return field.distance[v] / domain.move.scale; };
  CHECK(time(to.vertex(4)) == Approx(1 / 8.).epsilon(1e-12));
  CHECK(time(up.vertex(4)) == Approx(2 / 8.).epsilon(1e-12));
  CHECK(time(out.vertex(2)) == Approx(1 / 8. + 1).epsilon(1e-12));
}

}  // namespace mixed_test
