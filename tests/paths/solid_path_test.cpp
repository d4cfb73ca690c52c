#include <cmath>
#include <filesystem>
#include <limits>
#include <string>

#include <plexway/io/tets.hpp>

#include "complexes/test_solids.hpp"
#include "complexes/test_wires.hpp"
#include "exact_data.hpp"
#include "labels/cracked_solid.hpp"
#include "paths/path_testing.hpp"

namespace plexway::testing::solid_path_test {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

double flat(const Position& p, double x, double y) { return std::hypot(p[0] - x, p[1] - y); }

// Paths to vertices and to points inside, against a closed form; `free` says what is in the solid.
template <class Real, class Exact, class Free>
void check_exact(const Solid& s, Index source, Exact exact, Free free, double tolerance) {
  const auto mesh = s.mesh<Real>();
  PathField field(mesh, s.positions);
  field.solve(Serial{}, PointSource::at(source));
  std::mt19937 random(2);
  for (int k = 0; k < 60; ++k) {
    const PointSource target =
        k % 2 ? PointSource::at(below(random, s.positions.size())) : anywhere(s.tets, random);
    const Position at = target.vertex != none
                            ? s.positions[target.vertex]
                            : place(s.positions, s.tets[target.simplex], target.barycentric);
    const Path path = field.trace(target);
    CAPTURE(k, at[0], at[1], at[2]);
    check_path(path, s.positions, s.tets);
    CHECK(apart(path.positions.front(), at) <= 1e-12);
    CHECK(apart(path.positions.back(), s.positions[source]) <= 1e-12);
    CHECK(path.length == Approx(exact(at)).epsilon(tolerance).margin(1e-12));
    bool inside = true;
    for (std::size_t i = 0; i + 1 < path.positions.size(); ++i)
      for (double share = 0; share <= 1; share += 0.125) {
        Position p;
        for (std::size_t x = 0; x < 3; ++x)
          p[x] = (1 - share) * path.positions[i][x] + share * path.positions[i + 1][x];
        inside = inside && free(p);
      }
    CHECK(inside);
  }
}

constexpr double rim = 1e-8;
bool in_cube(const Position& p) {
  bool in = true;
  for (const double x : p) in = in && x >= -rim && x <= 1 + rim;
  return in;
}

}  // namespace

TEMPLATE_TEST_CASE("paths in a convex solid are straight", "", float, double) {
  const Solid s = solid_cube(6);
  const Index source = s.nearest(0.3, 0.4, 0.5);
  const Position from = s.positions[source];
  check_exact<TestType>(
      s, source, [&](const Position& p) { return apart(p, from); }, in_cube, 1e-9);
}

TEMPLATE_TEST_CASE("paths in an L turn around its edge", "", float, double) {
  const Solid s = l_shape(8);
  const Index source = s.nearest(0.25, 1, 0.125);
  const Position from = s.positions[source];
  const auto exact = [&](const Position& p) {
    // Does the line in the plane pass the corner (1/2, 1/2) on the side of the solid?
    const double turn = (0.5 - from[0]) * (p[1] - from[1]) - (0.5 - from[1]) * (p[0] - from[0]);
    const bool seen = turn <= 0 || p[0] <= 0.5;
    const double ground =
        seen ? flat(p, from[0], from[1]) : flat(p, 0.5, 0.5) + flat(from, 0.5, 0.5);
    return std::hypot(ground, p[2] - from[2]);
  };
  check_exact<TestType>(
      s, source, exact,
      [](const Position& p) { return in_cube(p) && (p[0] <= 0.5 + rim || p[1] <= 0.5 + rim); },
      1e-8);
}

TEST_CASE("paths over a wall turn around both of its edges") {
  const Solid s = walled(8);
  const Index source = s.nearest(0.125, 0.25, 0.25);
  const Position from = s.positions[source];
  const auto exact = [&](const Position& p) {
    const Position a = {0.375, 0.75, 0}, b = {0.625, 0.75, 0};
    // The tight string over the wall, in the plane.
    const auto height = [&](double x) {
      return from[1] + (p[1] - from[1]) * (x - from[0]) / (p[0] - from[0]);
    };
    double ground = flat(p, from[0], from[1]);
    if (p[0] > 0.375 && (height(0.375) < 0.75 || (p[0] > 0.625 && height(0.625) < 0.75))) {
      const double by_a = flat(from, a[0], a[1]) + flat(p, a[0], a[1]);
      const double by_both = flat(from, a[0], a[1]) + 0.25 + flat(p, b[0], b[1]);
      const double at_b = 0.75 + (p[1] - 0.75) * 0.25 / (p[0] - 0.375);
      ground = p[0] <= 0.625 || at_b >= 0.75 ? by_a : by_both;
    }
    return std::hypot(ground, p[2] - from[2]);
  };
  check_exact<double>(
      s, source, exact,
      [](const Position& p) {
        return in_cube(p) && (p[0] <= 0.375 + rim || p[0] >= 0.625 - rim || p[1] >= 0.75 - rim);
      },
      1e-7);
}

TEST_CASE("paths in solids do not depend on where the solid lies") {
  const Solid s = moved(walled(8), 30, {1e3, -2e3, 5e2});
  const Solid there = walled(8);
  const auto mesh = s.mesh<double>(), same = there.mesh<double>();
  PathField field(mesh, s.positions), other(same, there.positions);
  field.solve(Serial{}, PointSource::at(5));
  other.solve(Serial{}, PointSource::at(5));
  for (Index v = 0; v < s.positions.size(); v += 9) {
    const Path path = field.trace(v);
    check_path(path, s.positions, s.tets, 1e4);
    CHECK(path.length == Approx(30 * other.trace(v).length).epsilon(1e-6).margin(1e-9));
  }
}

TEST_CASE("paths in solids are as long as distances say, to vertices and to points") {
  const samples::CornerDomain plans[] = {
      one_slit,
      two_slits,
      {"", {{.25, .375, .25, .375}, {.25, .375, .75, .875}, {.625, .875, .625, .875}}, {.25, 1}},
      {"", {{.125, .375, .25, .375}, {.125, .375, .75, .875}, {.625, .875, .25, .375}}, {0, .25}}};
  std::mt19937 random(7);
  for (const auto& plan : plans) {
    const Cracked cracked(plan, .16, 3, .3);
    const TetMesh<double> mesh(cracked.places, cracked.tets);
    PathField field(mesh, cracked.places);
    for (int k = 0; k < 4; ++k) {
      Index source = 0;
      do source = below(random, cracked.floor());
      while (mesh.corners_at(mesh.inside_vertex(source)).empty());
      const auto& found = field.solve(Serial{}, PointSource::at(source));
      CHECK(found.accuracy == Accuracy::accurate());
      for (Index v = 0; v < cracked.places.size(); ++v) {
        if (!(found.distance[v] < infinity)) continue;
        const Path path = field.trace(v);
        CAPTURE(plan.blocks.size(), source, v);
        check_path(path, cracked.places, cracked.tets);
        CHECK(path.length == Approx(found.distance[v]).epsilon(1e-12).margin(1e-14));
      }
      for (int n = 0; n < 100; ++n) {
        const PointSource target = anywhere(cracked.tets, random);
        const Position at = place(cracked.places, cracked.tets[target.simplex], target.barycentric);
        const double exact = cracked.exact({at[0], at[1], at[2]})[source];
        CAPTURE(plan.blocks.size(), source, n);
        CHECK(field.at(target) == Approx(exact).epsilon(1e-6));
        const Path path = field.trace(target);
        check_path(path, cracked.places, cracked.tets);
        CHECK(path.length == Approx(field.at(target)).epsilon(1e-12));
      }
    }
  }
}

TEST_CASE("after labels paths in solids are still the shortest") {
  const Solid s = walled(8);
  const auto mesh = s.mesh<double>();
  PathField by_strings(mesh, s.positions), by_labels(mesh, s.positions);
  const PointSource sources[] = {PointSource::at(5), PointSource::in(200, {.1, .2, .3, .4})};
  by_strings.solve(Serial{}, sources);
  PropagateOptions options;
  options.accuracy = Accuracy::fast();
  by_labels.solve(OpenMP{2}, sources, options);
  CHECK(by_labels.distances().accuracy == Accuracy::fast());
  for (Index v = 0; v < s.positions.size(); v += 7) {
    const Path path = by_labels.trace(v);
    CHECK(path.length == by_strings.trace(v).length);
    CHECK(path.source == by_strings.distances().label[v]);
  }
  CHECK(by_labels.gradient() == by_strings.gradient());
  CHECK(by_labels.simplex_labels() == by_strings.simplex_labels());
}

TEST_CASE("paths in solids pass where parts touch") {
  const Solid s = vertex_touch(4);
  const auto mesh = s.mesh<double>();
  PathField field(mesh, s.positions);
  const Index source = s.nearest(0, 0.25, 0.25);
  field.solve(Serial{}, PointSource::at(source));
  const Position joint = {0.5, 0.5, 0.5};
  for (Index v = 0; v < s.positions.size(); ++v) {
    const Position& p = s.positions[v];
    const Path path = field.trace(v);
    const bool beyond = std::max({p[0], p[1], p[2]}) > 0.5 + 1e-9;
    const double exact = beyond ? apart(p, joint) + apart(joint, s.positions[source])
                                : apart(p, s.positions[source]);
    CAPTURE(v, p[0], p[1], p[2]);
    check_path(path, s.positions, s.tets);
    CHECK(path.length == Approx(exact).epsilon(1e-9).margin(1e-12));
  }
  // Over an edge: a way exists and is inside.
  const Solid e = edge_touch(4);
  const auto touching = e.mesh<double>();
  PathField over(touching, e.positions);
  over.solve(Serial{}, PointSource::at(0));
  for (Index v = 0; v < e.positions.size(); ++v) check_path(over.trace(v), e.positions, e.tets);
}

TEST_CASE("paths in a solid of lengths alone are those in space") {
  for (const Solid& s : {solid_cube(3), l_shape(4), walled(8)}) {
    const TetMesh<double> mesh(s.positions.size(), s.tets, s.lengths()), placed = s.mesh<double>();
    PathField field(mesh), in_space(placed, s.positions);
    const Index source = s.nearest(0.9, 0.1, 0.3);
    field.solve(Serial{}, PointSource::at(source));
    in_space.solve(Serial{}, PointSource::at(source));
    double worst = 0, inside = 0;
    for (Index v = 0; v < s.positions.size(); v += 5) {
      const Path path = field.trace(v), known = in_space.trace(v);
      CAPTURE(v, path.length, known.length);
      CHECK(path.positions.empty());
      CHECK(path.length >= apart(s.positions[v], s.positions[source]) * (1 - 1e-12));
      CHECK(path.length >= known.length * (1 - 1e-6) - 1e-12);
      if (known.length > 0) worst = std::max(worst, path.length / known.length - 1);
      PointSource at{.simplex = static_cast<Index>(v % s.tets.size()),
                     .barycentric = {0.1, 0.2, 0.3, 0.4}};
      inside = std::max(inside, field.at(at) / in_space.trace(at).length - 1);
    }
    CAPTURE(s.positions.size(), worst, inside);
    CHECK(worst < 1e-4);
    CHECK(inside < 1e-4);
    CHECK_THROWS_WITH(field.gradient(), Catch::Contains("need their coordinates"));
  }
}

TEST_CASE("path lengths against exact distances in real solids") {
  struct Case {
    const char* name;
    Index source;
  };
  for (const auto& [name, source] : {Case{"cube_10k", 8}, {"notch_10k", 14}, {"maze_10k", 32}}) {
    const std::filesystem::path file = exact_file("solids", std::string(name) + ".node");
    if (file.empty()) {
      WARN("not measured: no " << name);
      continue;
    }
    const io::Tets t = io::read_tets(file);
    const TetMesh<float> mesh(t.positions, t.tets);
    PathField field(mesh, t.positions);
    field.solve(Serial{}, PointSource::at(source));
    const std::vector<double> exact =
        exact_values(exact_file("solids", name + (".v" + std::to_string(source)) + ".txt"));
    REQUIRE(exact.size() == t.positions.size());
    std::mt19937 random(1);
    double sum = 0, below_exact = 0;
    int count = 0;
    for (int k = 0; k < 60; ++k) {
      const Index v = below(random, exact.size());
      if (!(exact[v] > 0)) continue;
      const Path path = field.trace(v);
      CAPTURE(name, v);
      check_path(path, t.positions, t.tets);
      sum += path.length / exact[v] - 1;
      below_exact = std::min(below_exact, path.length / exact[v] - 1);
      ++count;
    }
    CAPTURE(name, sum / count, below_exact);
    CHECK(sum <= 5e-4 * count);
    CHECK(below_exact >= -1e-6);
  }
}

TEMPLATE_TEST_CASE("paths on wireframes are as long as distances say", "", float, double) {
  for (unsigned seed = 0; seed < 12; ++seed) {
    const Wires w = random_wires(seed, 50, 90);
    const auto wireframe = w.template wireframe<TestType>();
    PathField field(wireframe);
    const std::vector<PointSource> sources = {PointSource::in(4, {0.25, 0.75}), PointSource::at(9)};
    const auto& found = field.solve(Serial{}, std::span<const PointSource>(sources));
    for (Index v = 0; v < 50; ++v) {
      const Path path = field.trace(v);
      CAPTURE(seed, v);
      const double d = static_cast<double>(found.distance[v]);
      REQUIRE(std::isinf(path.length) == std::isinf(d));
      if (std::isinf(d)) continue;
      CHECK(path.length == Approx(d).epsilon(1e-5).margin(1e-9));
      // Point by point: each line in its edge, and all of them add up.
      double sum = 0;
      const auto vertex_of = [&](const PathPoint& p) {
        return p.barycentric[0] == 1   ? w.edges[p.simplex][0]
               : p.barycentric[1] == 1 ? w.edges[p.simplex][1]
                                       : none;
      };
      for (std::size_t i = 0; i + 1 < path.points.size(); ++i) {
        const PathPoint &p = path.points[i], &q = path.points[i + 1];
        double at = q.barycentric[1];
        if (q.simplex != p.simplex) {
          const Index shared = vertex_of(q);
          REQUIRE(shared != none);
          REQUIRE((w.edges[p.simplex][0] == shared || w.edges[p.simplex][1] == shared));
          at = w.edges[p.simplex][0] == shared ? 0 : 1;
          if (w.edges[p.simplex][0] == w.edges[p.simplex][1]) at = p.barycentric[1];
        }
        sum += std::abs(p.barycentric[1] - at) * w.lengths[p.simplex];
      }
      CHECK(path.length == Approx(sum).epsilon(1e-6).margin(1e-9));
    }
    // From inside an edge, to a source on it as well.
    const Path along = field.trace(PointSource::in(4, {0.5, 0.5}));
    CHECK(along.length <= 0.25 * w.lengths[4] * (1 + 1e-6) + 1e-12);
  }
}

}  // namespace plexway::testing::solid_path_test
