#include <plexway/surface/intrinsic_delaunay.hpp>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include <plexway/error.hpp>

#include "complexes/surface/intrinsic/intrinsic_triangulation.hpp"
#include "complexes/surface/triangulation_testing.hpp"

namespace plexway::testing::intrinsic_delaunay_test {
using namespace detail;

namespace {

using Double = TriangleMesh<double>;

// Whatever it is made of, these hold afterwards.
void check_kept(const Double& input, double angle_tolerance = 1e-10) {
  const IntrinsicDelaunay delaunay(input);
  const Double mesh = delaunay.mesh<double>();
  CHECK(delaunay.summary().stuck_edges == 0);
  CHECK(worst_excess(mesh) < 1e-10);

  const SurfaceSummary &before = input.summary(), &after = mesh.summary();
  CHECK(after.vertices == before.vertices);
  CHECK(after.faces == before.faces);
  CHECK(after.edges == before.edges);
  CHECK(after.boundary_edges == before.boundary_edges);
  CHECK(after.non_manifold_edges == before.non_manifold_edges);
  CHECK(after.pinched_vertices == before.pinched_vertices);
  CHECK(after.unreferenced_vertices == before.unreferenced_vertices);
  CHECK(after.components == before.components);
  CHECK(after.orientable == before.orientable);
  const auto fixed = fixed_edges(input), still = fixed_edges(mesh);
  REQUIRE(fixed.size() == still.size());
  for (std::size_t e = 0; e < fixed.size(); ++e)
    for (std::size_t k = 0; k < 4; ++k)
      CHECK(std::abs(fixed[e][k] - still[e][k]) <= 1e-12 * std::abs(fixed[e][k]));

  const Plain p = plain(input), q = plain(mesh);
  const auto angles = cone_angles(p, input.vertex_count());
  const auto kept = cone_angles(q, input.vertex_count());
  double drift = 0;
  for (std::size_t v = 0; v < angles.size(); ++v)
    drift = std::max(drift, std::abs(angles[v] - kept[v]) / std::max(angles[v], 1.));
  CHECK(drift <= angle_tolerance);
  CHECK(std::abs(total_area(p) - total_area(q)) <= 1e-10 * total_area(p));
  // Both sides of an edge have one length.
  for (std::size_t f = 0; f < q.faces.size(); ++f)
    for (const double l : q.length[f]) CHECK(std::isfinite(l));

  const IntrinsicDelaunay again(mesh);
  CHECK(again.summary().flips == 0);
}

long double in_circle(const Surface& s, const Face& f, Index v) {
  long double m[3][3];
  const long double turn = area2(s, f[0], f[1], f[2]) > 0 ? 1 : -1;
  for (int i = 0; i < 3; ++i) {
    m[i][0] = static_cast<long double>(s.positions[f[static_cast<std::size_t>(i)]][0]) -
              static_cast<long double>(s.positions[v][0]);
    m[i][1] = static_cast<long double>(s.positions[f[static_cast<std::size_t>(i)]][1]) -
              static_cast<long double>(s.positions[v][1]);
    m[i][2] = m[i][0] * m[i][0] + m[i][1] * m[i][1];
  }
  return turn * (m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                 m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                 m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]));
}

// All triangles whose circle has no point in it, by looking at all.
std::vector<Face> empty_circles(const Surface& s) {
  std::vector<Face> found;
  const Index n = static_cast<Index>(s.positions.size());
  for (Index a = 0; a < n; ++a)
    for (Index b = a + 1; b < n; ++b)
      for (Index c = b + 1; c < n; ++c) {
        const Face f = {a, b, c};
        if (std::abs(area2(s, a, b, c)) < 1e-9) continue;
        bool empty = true;
        for (Index v = 0; v < n && empty; ++v)
          empty = v == a || v == b || v == c || in_circle(s, f, v) < 0;
        if (empty) found.push_back(f);
      }
  return found;
}

Surface noisy_sphere(int levels, unsigned seed) { return noisy(sphere(levels), 0.02, seed); }

// The same metric in other triangles: random flips of edges that allow it.
Double shuffled(const Double& mesh, int flips, unsigned seed) {
  IntrinsicTriangulation t(mesh);
  std::mt19937 random(seed);
  for (int n = 0; n < flips; ++n) {
    const Index f = below(random, t.triangles().size()), i = below(random, 3);
    const Index o = t.triangles()[f].across[i];
    if (o == none || (o & Across::fan) != 0 || o >> Across::face_shift == f) continue;
    const IntrinsicTriangle &one = t.triangles()[f], &two = t.triangles()[o >> Across::face_shift];
    const auto angle = [](const IntrinsicTriangle& x, std::size_t c) {
      return std::atan2(x.angle[c].s, x.angle[c].c);
    };
    const std::size_t j = o & Across::edge_mask, i2 = edge_after(i), j2 = edge_after(j);
    if (angle(one, i) + angle(two, j2) < 3 && angle(one, i2) + angle(two, j) < 3)
      t.flip(f << Across::face_shift | i);
  }
  std::vector<Face> faces;
  std::vector<std::array<double, 3>> lengths;
  std::vector<std::array<Index, 3>> across;
  for (const IntrinsicTriangle& x : t.triangles()) {
    faces.push_back(x.corner);
    lengths.push_back(
        {x.length[0] * mesh.unit(), x.length[1] * mesh.unit(), x.length[2] * mesh.unit()});
    std::array<Index, 3> row{};
    for (std::size_t i = 0; i < 3; ++i)
      row[i] = x.across[i] == none
                   ? none
                   : 3 * (x.across[i] >> Across::face_shift) + (x.across[i] & Across::edge_mask);
    across.push_back(row);
  }
  return Double(mesh.vertex_count(), faces, lengths, across);
}

}  // namespace

TEST_CASE("intrinsic Delaunay of planar points is that of empty circles") {
  for (unsigned seed = 1; seed <= 8; ++seed) {
    const Surface s = random_polygon(5 + seed % 3, 25, 400, seed);
    const IntrinsicDelaunay delaunay(s.mesh<double>());
    CHECK(delaunay.summary().flips > 0);
    const auto found = vertex_sets(plain(delaunay.mesh<double>()));
    CHECK(found == empty_circles(s));
  }
}

TEST_CASE("intrinsic Delaunay does not depend on the triangles it starts from") {
  const Double mesh = noisy_sphere(3, 7).mesh<double>();
  const IntrinsicDelaunay direct(mesh);
  const auto wanted = vertex_sets(plain(direct.mesh<double>()));
  for (unsigned seed = 1; seed <= 4; ++seed) {
    const Double other = shuffled(mesh, 4000, seed);
    CHECK(worst_excess(other) > 1);
    const IntrinsicDelaunay delaunay(other);
    CHECK(delaunay.summary().flips > 200);
    CHECK(vertex_sets(plain(delaunay.mesh<double>())) == wanted);
  }
}

TEST_CASE("intrinsic Delaunay keeps metric, borders and topology") {
  check_kept(grid(7, 5, 20, 1).mesh<double>());
  check_kept(random_polygon(6, 200, 3000, 3).mesh<double>());
  check_kept(slit_square(10).mesh<double>());
  check_kept(cube(5).mesh<double>());
  check_kept(tetrahedron().mesh<double>());
  check_kept(prism(12, 3, 30).mesh<double>());
  check_kept(moebius(24, 3).mesh<double>());
  check_kept(moebius(60, 1).mesh<double>());
  check_kept(sheets(3, 6).mesh<double>());
  check_kept(bow_tie(4).mesh<double>());
  check_kept(renamed(sphere(3), 5, true, true).surface.mesh<double>());
  for (unsigned seed = 1; seed <= 6; ++seed) {
    check_kept(shuffled(noisy_sphere(3, seed).mesh<double>(), 4000, seed), 1e-9);
    check_kept(soup(12, 40, seed).mesh<double>());
  }
}

TEST_CASE("intrinsic Delaunay of surfaces that turn over") {
  // Flips across the seam of a band that has one side only.
  Surface s = moebius(40, 4);
  std::mt19937 random(4);
  for (Position& p : s.positions)
    for (double& x : p) x += 0.08 * (uniform(random) - 0.5);
  check_kept(s.mesh<double>());
  check_kept(renamed(s, 3, true, true).surface.mesh<double>());
  for (unsigned seed = 1; seed <= 3; ++seed)
    check_kept(shuffled(s.mesh<double>(), 3000, seed), 1e-9);
}

TEST_CASE("intrinsic Delaunay may glue a triangle to itself") {
  // Two copies of a triangle with 120 degrees at vertex 2: the long edge becomes a loop there.
  const double side = 1, base = std::sqrt(3.0);
  const Double input = double_cover(base, side, side);
  check_kept(input);
  const IntrinsicDelaunay delaunay(input);
  CHECK(delaunay.summary().flips == 1);
  const Plain p = plain(delaunay.mesh<double>());
  for (std::size_t f = 0; f < 2; ++f) {
    CHECK(std::count(p.faces[f].begin(), p.faces[f].end(), 2u) == 2);
    // The loop is twice the height: there and back over the other side.
    CHECK(*std::min_element(p.length[f].begin(), p.length[f].end()) == Approx(1).epsilon(1e-12));
  }
  check_kept(double_cover(1.9999, 1, 1));
  check_kept(double_cover(2 - 1e-9, 1, 1), 1e-7);  // angles from lengths alone
  check_kept(double_cover(3, 4, 5));               // a tie: 90 and 90 degrees
  CHECK(IntrinsicDelaunay(double_cover(3, 4, 5)).summary().flips == 0);
}

TEST_CASE("intrinsic Delaunay of hostile triangles") {
  SECTION("a vertex on the edge of others") {
    Surface s;
    s.add(0, 0), s.add(2, 0), s.add(1, 0), s.add(1, -1), s.add(1, 1);
    s.triangle(0, 1, 2), s.triangle(1, 0, 3), s.triangle(0, 2, 4), s.triangle(2, 1, 4);
    check_kept(s.mesh<double>());
    CHECK(IntrinsicDelaunay(s.mesh<double>()).summary().flips == 1);
  }
  SECTION("needles and caps down to rounding") {
    for (const double thin : {1e-3, 1e-6, 1e-9, 1e-12, 1e-15, 1e-200, 0.0}) {
      Surface s = grid(12, 12, 1, thin);
      check_kept(s.mesh<double>());
      std::mt19937 random(9);
      for (Position& p : s.positions) p[2] = 0.1 * thin * uniform(random);
      check_kept(s.mesh<double>());
    }
  }
  SECTION("vertices in one place") {
    Surface s = grid(6, 6);
    for (Index v : {8u, 9u, 16u, 24u, 25u, 32u}) s.positions[v] = s.positions[v + 1];
    const IntrinsicDelaunay delaunay(s.mesh<double>());
    CHECK(worst_excess(delaunay.mesh<double>()) < 1e-10);
    CHECK(total_area(plain(delaunay.mesh<double>())) == Approx(1).epsilon(1e-10));
    for (Position& p : s.positions) p = {1, 2, 3};
    check_kept(s.mesh<double>());
  }
  SECTION("lengths that make no triangles") {
    const Surface s = sphere(2);
    auto lengths = lengths_of(s);
    std::mt19937 random(5);
    std::map<std::pair<Index, Index>, double> of;
    for (std::size_t f = 0; f < s.faces.size(); ++f)
      for (std::size_t i = 0; i < 3; ++i) {
        const std::pair<Index, Index> edge = std::minmax(s.faces[f][i], s.faces[f][(i + 1) % 3]);
        const auto [place, fresh] = of.try_emplace(edge, 0);
        if (fresh) place->second = std::pow(10, 6 * uniform(random) - 3);
        lengths[f][i] = place->second;
      }
    const IntrinsicDelaunay delaunay(Double(s.positions.size(), s.faces, lengths));
    CHECK(delaunay.mesh<double>().summary().faces == s.faces.size());
  }
}

TEST_CASE("intrinsic Delaunay of float lengths") {
  const Surface s = random_polygon(6, 100, 1500, 11);
  const IntrinsicDelaunay delaunay(s.mesh<float>());
  CHECK(worst_excess(delaunay.mesh<float>()) < 2e-5);
  const Plain p = plain(delaunay.mesh<float>());
  CHECK(total_area(p) == Approx(total_area(plain(s.mesh<double>()))).epsilon(1e-5));
}

TEST_CASE("a Delaunay triangulation stays as it is") {
  const Surface s = sphere(3);
  const Double mesh = s.mesh<double>();
  const IntrinsicDelaunay delaunay(mesh);
  CHECK(delaunay.summary().flips == 0);
  CHECK(plain(delaunay.mesh<double>()).faces == plain(mesh).faces);
}

TEST_CASE("measured shape of a triangulation") {
  // 20 : 1 right triangles, cut along one diagonal: a tie at each, so all of them are Delaunay.
  const TriangulationShape ties = measure_triangulation(grid(10, 10, 200, 10).mesh<double>());
  CHECK(ties.non_delaunay_edges == 0);
  CHECK(ties.inner_edges == 280);
  CHECK(ties.largest_angle == Approx(90));
  CHECK(ties.smallest_angle == Approx(std::atan(1. / 20) * 180 / std::numbers::pi));
  // A rhombus cut along its long diagonal.
  Surface s;
  s.add(-3, 0), s.add(3, 0), s.add(0, 1), s.add(0, -1);
  s.triangle(0, 1, 2), s.triangle(1, 0, 3);
  const TriangulationShape one = measure_triangulation(s.mesh<float>());
  CHECK(one.non_delaunay_share() == 1);
  CHECK(one.largest_angle == Approx(2 * std::atan(3.) * 180 / std::numbers::pi));
}

namespace {

// The shortest edge between each two vertices, by the caller's numbers.
using ShortestEdges = std::map<std::pair<Index, Index>, double>;

ShortestEdges shortest_edges(const Double& mesh) {
  const Plain p = plain(mesh);
  ShortestEdges found;
  for (std::size_t f = 0; f < p.faces.size(); ++f)
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [v, w] = std::minmax(p.faces[f][i], p.faces[f][(i + 1) % 3]);
      if (v == w) continue;
      const auto [at, fresh] = found.try_emplace({v, w}, p.length[f][i]);
      if (!fresh) at->second = std::min(at->second, p.length[f][i]);
    }
  return found;
}

// Chords are the edges of the input that are gone, and both their ends know of them.
void check_lost(const Double& input, const Double& now) {
  ShortestEdges lost;
  const ShortestEdges there = shortest_edges(now);
  for (const auto& [ends, length] : shortest_edges(input)) {
    const auto at = there.find(ends);
    if (at == there.end() || at->second > length * (1 + 1e-9)) lost.emplace(ends, length);
  }
  REQUIRE(!lost.empty());
  std::vector<Index> outer(now.vertex_count());
  for (Index v = 0; v < outer.size(); ++v) outer[now.inside_vertex(v)] = v;
  std::size_t ends = 0;
  for (Index v = 0; v < outer.size(); ++v)
    for (const auto& chord : now.chords_at(v)) {
      ++ends;
      const auto [a, b] = std::minmax(outer[v], outer[chord.vertex]);
      const auto at = lost.find({a, b});
      REQUIRE(at != lost.end());
      CHECK(chord.length * now.unit() == Approx(at->second).epsilon(1e-9));
    }
  CHECK(ends == 2 * lost.size());
}

}  // namespace

TEST_CASE("edges that flips took are chords, and no others") {
  const std::size_t which = GENERATE(range(0, 6));
  const Surface made[] = {random_polygon(6, 100, 1500, 11),
                          random_polygon(30, 400, 9000, 5),
                          prism(3, 4, 40),
                          grid(20, 20, 300, 10),
                          soup(40, 120, 3),
                          moebius(12, 4)};
  Surface s = made[which];
  std::mt19937 random(static_cast<unsigned>(which));
  for (auto& p : s.positions)  // no ties
    for (double& x : p) x += 0.05 * uniform(random);
  const Double input = s.mesh<double>();
  const IntrinsicDelaunay flipped(input);
  REQUIRE(flipped.summary().flips > 0);
  check_lost(input, flipped.mesh<double>());
  check_lost(input, triangulate<double>(s.positions, s.faces, Retriangulation::flips).mesh);
  check_lost(input, triangulate<double>(s.positions, s.faces, Retriangulation::refined).mesh);
}

}  // namespace plexway::testing::intrinsic_delaunay_test
