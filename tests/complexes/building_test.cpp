#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <random>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/solid/tet_mesh.hpp>
#include <plexway/surface/intrinsic_delaunay.hpp>
#include <plexway/surface/triangle_mesh.hpp>

#include "complexes/common/simplex_order.hpp"
#include "complexes/solid/tet_gluing.hpp"
#include "complexes/surface/gluing.hpp"
#include "complexes/surface/shape_blocks.hpp"
#include "complexes/surface/triangle_shape.hpp"
#include "complexes/test_meshes.hpp"
#include "complexes/test_solids.hpp"

namespace plexway::testing::building_test {

// How meshes are built fast, beside the slow ways of saying the same.

namespace {

Gluing glued_by_map(const Surface& s) {
  std::map<std::pair<Index, Index>, std::vector<Index>> sides;
  for (Index f = 0; f < s.faces.size(); ++f)
    for (Index i = 0; i < 3; ++i)
      sides[std::minmax(s.faces[f][i], s.faces[f][(i + 1) % 3])].push_back(3 * f + i);
  Gluing across(s.faces.size(), {none, none, none});
  for (const auto& [ends, list] : sides)
    for (std::size_t k = 0; list.size() > 1 && k < list.size(); ++k)
      across[list[k] / 3][list[k] % 3] = list[(k + 1) % list.size()];
  return across;
}

struct GluedByMap {
  std::vector<std::array<Index, 4>> across;
  bool fit = true;     // two lie on two sides of what they share
  bool third = false;  // more than two share a face
};
GluedByMap glued_by_map(std::span<const Tet> tets) {
  constexpr Index seen[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};  // from inside
  struct Side {
    Index corner;
    bool even;
  };
  std::map<std::array<Index, 3>, std::vector<Side>> sides;
  for (Index t = 0; t < tets.size(); ++t)
    for (Index i = 0; i < 4; ++i) {
      std::array<Index, 3> face;
      for (std::size_t k = 0; k < 3; ++k) face[k] = tets[t][seen[i][k]];
      const bool even = ((face[0] < face[1]) + (face[1] < face[2]) + (face[0] < face[2])) % 2 == 1;
      std::sort(face.begin(), face.end());
      sides[face].push_back({4 * t + i, even});
    }
  GluedByMap glued;
  glued.across.assign(tets.size(), {none, none, none, none});
  for (const auto& [face, list] : sides) {
    glued.third |= list.size() > 2;
    if (list.size() != 2) continue;
    glued.fit &= list[0].even != list[1].even;
    for (std::size_t k = 0; k < 2; ++k)
      glued.across[list[k].corner / 4][list[k].corner % 4] = list[1 - k].corner;
  }
  return glued;
}

// `count` triangles around vertex 0, some of them several times.
Surface wheel(Index count, Index every) {
  Surface s;
  s.add(0, 0, 0.3);
  for (Index k = 0; k < count; ++k) {
    const double a = 2 * std::numbers::pi * k / count;
    s.add(std::cos(a), std::sin(a));
  }
  for (Index k = 0; k < count; ++k) s.triangle(0, 1 + k, 1 + (k + 1) % count);
  for (Index k = 0; k < count; k += every) s.triangle(0, 1 + (k + 1) % count, 1 + k);
  return s;
}

template <class Real>
void check_same(const TriangleMesh<Real>& a, const TriangleMesh<Real>& b) {
  REQUIRE(a.face_count() == b.face_count());
  CHECK(std::ranges::equal(a.vertices_inside(), b.vertices_inside()));
  CHECK(std::ranges::equal(a.pinched(), b.pinched()));
  CHECK(a.summary().edges == b.summary().edges);
  CHECK(a.summary().components == b.summary().components);
  CHECK(a.summary().boundary_edges == b.summary().boundary_edges);
  CHECK(a.unit() == Approx(b.unit()).epsilon(1e-14));
  CHECK(a.faces_are_in_space() == b.faces_are_in_space());
  CHECK(a.has_chords() == b.has_chords());
  REQUIRE(a.positions().size() == b.positions().size());
  std::size_t others = 0;
  double farthest = 0;
  for (Index v = 0; v < a.vertex_count(); ++v) {
    const auto c = a.chords_at(v), d = b.chords_at(v);
    REQUIRE(c.size() == d.size());
    for (std::size_t k = 0; k < c.size(); ++k) {
      others += c[k].vertex != d[k].vertex;
      farthest = std::max(farthest, std::abs(static_cast<double>(c[k].length - d[k].length)));
    }
    for (std::size_t i = 0; i < 3 && !a.positions().empty(); ++i)
      CHECK(a.positions()[v][i] == Approx(b.positions()[v][i]).margin(1e-12));
  }
  for (Index f = 0; f <= a.face_count(); ++f) {
    const auto &t = a.triangles()[f], &u = b.triangles()[f];
    others += t.face != u.face;
    for (std::size_t i = 0; i < 3; ++i) {
      others +=
          t.across[i] != u.across[i] || t.corner[i] != u.corner[i] || t.saddle(i) != u.saddle(i);
      for (const Real gap :
           {t.length[i] - u.length[i], t.cosine[i] - u.cosine[i], t.sine(i) - u.sine(i)})
        farthest = std::max(farthest, std::abs(static_cast<double>(gap)));
    }
  }
  CHECK(others == 0);
  // In double rounding differs by the formula, and flips add to it.
  const double roundings = sizeof(Real) == 4 ? 2 : 100;
  CHECK(farthest <= roundings * static_cast<double>(std::numeric_limits<Real>::epsilon()));
}

}  // namespace

TEST_CASE("triangles are glued by scanning as by a map") {
  std::vector<Surface> all = {grid(7, 5), cube(4), moebius(12), sheets(5, 3), bow_tie(3)};
  for (unsigned seed = 1; seed <= 6; ++seed) all.push_back(soup(9, 40 * seed, seed));
  for (const Index count : {5u, 31u, 33u, 700u})
    for (const Index every : {1u, 3u, 1000u}) all.push_back(wheel(count, every));
  for (const Surface& s : all) {
    const Gluing across = glued_by_map(s);
    CHECK(glue_by_vertices(s.positions.size(), s.faces) == across);
    // The constructor that glues inside makes what the one with an explicit gluing does.
    const TriangleMesh<double> direct(s.positions.size(), s.faces, lengths_of(s));
    const TriangleMesh<double> given(s.positions.size(), s.faces, lengths_of(s), across);
    check_same(direct, given);
    const TriangleMesh<double> in_space(s.positions, s.faces);
    CHECK(in_space.summary().edges == given.summary().edges);
    CHECK(in_space.summary().non_manifold_edges == given.summary().non_manifold_edges);
    CHECK(in_space.summary().boundary_edges == given.summary().boundary_edges);
    CHECK(in_space.summary().pinched_vertices == given.summary().pinched_vertices);
    CHECK(in_space.summary().components == given.summary().components);
    CHECK(in_space.summary().orientable == given.summary().orientable);
    for (Index f = 0; f < s.faces.size(); ++f)
      for (Index i = 0; i < 3; ++i) {
        const auto neighbour = [&](const TriangleMesh<double>& mesh) -> Index {
          const auto [inside, turned] = mesh.inside_face(f);
          const Index o = mesh.triangles()[inside].across[turned ? 2 - i : i];
          const Index g = o >> Across::face_shift;
          return g == mesh.face_count() ? none : mesh.triangles()[g].face & ~reversed;
        };
        const Index h = across[f][i];
        REQUIRE(neighbour(in_space) == (h == none ? none : h / 3));
        REQUIRE(neighbour(given) == (h == none ? none : h / 3));
      }
  }
}

TEST_CASE("the order along the curve is that of whole keys") {
  std::mt19937 random(4);
  std::vector<std::array<double, 3>> points;
  std::vector<std::array<Index, 1>> each;
  for (Index i = 0; i < 5000; ++i) {
    const double scale = std::pow(10, -7.0 * static_cast<double>(i % 4) / 3);  // crowds at 0
    points.push_back({scale * uniform(random), scale * uniform(random), scale * uniform(random)});
    if (i % 50 == 1) points.back() = points[i - 1];
    each.push_back({i});
  }
  double low[3], high[3], width = 0;
  for (std::size_t d = 0; d < 3; ++d) {
    const auto less = [d](const auto& a, const auto& b) { return a[d] < b[d]; };
    low[d] = (*std::min_element(points.begin(), points.end(), less))[d];
    high[d] = (*std::max_element(points.begin(), points.end(), less))[d];
    width = std::max(width, high[d] - low[d]);
  }
  std::vector<std::pair<std::uint64_t, Index>> keyed;
  for (Index i = 0; i < points.size(); ++i) {
    std::uint64_t key = 0;
    for (std::size_t d = 0; d < 3; ++d) {
      const auto cell = static_cast<std::uint64_t>((points[i][d] - low[d]) / width * 2097151);
      for (int bit = 0; bit < 21; ++bit)
        key |= (cell >> bit & 1) << (3 * bit + static_cast<int>(d));
    }
    keyed.emplace_back(key, i);
  }
  std::sort(keyed.begin(), keyed.end());
  const std::vector<Index> order = along_curve<1>(points, each);
  REQUIRE(order.size() == keyed.size());
  std::size_t other = 0;  // rounding puts a point into the next cell now and then
  for (std::size_t i = 0; i < order.size(); ++i) other += order[i] != keyed[i].second;
  CHECK(other < 10);
  CHECK(std::set<Index>(order.begin(), order.end()).size() == order.size());
}

TEST_CASE("shapes in blocks are those one by one") {
  std::mt19937 random(8);
  Surface s;
  for (int n = 0; n < 500; ++n) {
    const double thin = std::pow(10, -9 * uniform(random));
    const double far = n % 7 == 0 ? 1e150 : n % 7 == 1 ? 1e-150 : 1;
    const Index first = s.add(far * uniform(random), far * uniform(random), far * thin);
    s.add(far * uniform(random), far * uniform(random), 0);
    s.add(s.positions[first][0] + far * thin * uniform(random), far * thin * uniform(random),
          far * thin * uniform(random));
    s.triangle(first, first + 1, first + 2);
  }
  s.triangle(0, 1, 4), s.positions[4] = s.positions[1];
  std::vector<Index> listed;
  for (Index f = 0; f < s.faces.size(); f += 3) listed.push_back(f);
  const ShapesInSpace shapes(s.positions, s.faces);
  ShapeBlock block{};
  std::array<ShapeBlock::Row, 3> angle;
  RoundedAngles<float> rounded;
  for (std::size_t first = 0; first < listed.size(); first += ShapeBlock::size) {
    const std::size_t count = std::min(ShapeBlock::size, listed.size() - first);
    shapes.look_up(std::span(listed).subspan(first, count), block);
    angles_of(block, angle);
    round_angles(block, rounded);
    for (std::size_t k = 0; k < count; ++k) {
      const Face& f = s.faces[listed[first + k]];
      const TriangleShape one =
          shape_from_positions({&s.positions[f[0]], &s.positions[f[1]], &s.positions[f[2]]});
      CHECK(block.degenerate[k] == one.degenerate);
      for (std::size_t i = 0; i < 3; ++i) {
        CHECK(block.length[i][k] == one.length[i]);
        CHECK(std::abs(block.cosine[i][k] - one.cosine[i]) < 1e-14);
        CHECK(std::abs(block.sine[i][k] - one.sine[i]) < 1e-14);
        CHECK(std::abs(angle[i][k] - std::atan2(one.sine[i], one.cosine[i])) < 2e-14);
        // Of all numbers next to both the ones that keep lengths best.
        const float c = static_cast<float>(block.cosine[i][k]),
                    sn = static_cast<float>(block.sine[i][k]);
        const auto miss = [](float x, float y) {
          const double p = static_cast<double>(x), q = static_cast<double>(y);
          return std::abs((p - 1) * (p + 1) + q * q);
        };
        double least = 1;
        for (const float x : {std::nextafter(c, -2.f), c, std::nextafter(c, 2.f)})
          for (const float y : {std::nextafter(sn, -2.f), sn, std::nextafter(sn, 2.f)})
            least = std::min(least, miss(x, y));
        CHECK(miss(rounded.cosine[i][k], rounded.sine[i][k]) <= least + 2e-17);
      }
    }
  }
}

TEST_CASE("shapes from lengths are those of positions") {
  std::mt19937 random(9);
  for (int n = 0; n < 1000; ++n) {
    const double scale = n % 3 == 0 ? 1 : n % 3 == 1 ? 1e-200 : 1e200;
    std::array<std::array<double, 3>, 3> p{};
    for (auto& q : p)
      for (double& x : q) x = scale * uniform(random);
    const TriangleShape a = shape_from_positions({&p[0], &p[1], &p[2]});
    const TriangleShape b = shape_from_lengths(a.length);
    CHECK_FALSE(b.violated);
    for (std::size_t i = 0; i < 3; ++i) {
      CHECK(b.length[i] == a.length[i]);
      CHECK(std::abs(b.cosine[i] - a.cosine[i]) < 1e-11);
      CHECK(std::abs(b.sine[i] - a.sine[i]) < 1e-11);
      CHECK(std::abs(b.sine[i] * b.sine[i] + b.cosine[i] * b.cosine[i] - 1) < 1e-15);
    }
  }
}

TEMPLATE_TEST_CASE("a surface triangulated at once is the one that takes three builds", "", float,
                   double) {
  std::vector<Surface> all = {grid(9, 4),       random_polygon(6, 150, 900, 3),
                              cube(4),          sphere(3),
                              moebius(25),      sheets(4, 4),
                              bow_tie(4),       renamed(moebius(18), 3, true, true).surface,
                              soup(12, 90, 5),  renamed(cube(3), 2, true, true).surface,
                              prism(9, 4, 0.5), wheel(80, 9)};
  for (const Surface& s : all) {
    const TriangleMesh<TestType> plain(s.positions, s.faces);
    const Retriangulation pays = what_pays(measure_triangulation(plain));
    const auto left_open = triangulate<TestType>(s.positions, s.faces);
    CHECK(left_open.done == pays);
    CHECK(left_open.delaunay.has_value() == (pays != Retriangulation::keep));
    const auto kept = triangulate<TestType>(s.positions, s.faces, Retriangulation::keep);
    CHECK_FALSE(kept.delaunay);
    check_same(kept.mesh, plain);

    const auto flipped = triangulate<TestType>(s.positions, s.faces, Retriangulation::flips);
    const IntrinsicDelaunay delaunay(TriangleMesh<double>(s.positions, s.faces));
    REQUIRE(flipped.delaunay);
    CHECK(flipped.delaunay->summary().flips == delaunay.summary().flips);
    CHECK(flipped.delaunay->summary().stuck_edges == delaunay.summary().stuck_edges);
    check_same(flipped.mesh,
               delaunay.summary().flips > 0 ? delaunay.template mesh<TestType>() : plain);
    CHECK_THROWS_AS(flipped.delaunay->template mesh<TestType>(), UsageError);
    CHECK(flipped.delaunay->bytes() < delaunay.bytes());
    for (Index f = 0; f < s.faces.size(); ++f) {
      const PointSource point = PointSource::in(f, {0.2, 0.5, 0.3});
      const PointSource a = flipped.delaunay->to_intrinsic(point), b = delaunay.to_intrinsic(point);
      CHECK(a.simplex == b.simplex);
      const PointSource back = flipped.delaunay->to_input(a);
      CHECK(back.simplex == f);
      for (std::size_t i = 0; i < 3; ++i)
        CHECK(back.barycentric[i] == Approx(point.barycentric[i]).margin(1e-7));
    }
  }
}

TEST_CASE("what is refused is refused on every way to a surface") {
  const auto refused = [](const Surface& s, const char* why) {
    CHECK_THROWS_WITH(TriangleMesh<float>(s.positions, s.faces), why);
    CHECK_THROWS_WITH(triangulate<float>(s.positions, s.faces), why);
    CHECK_THROWS_WITH(triangulate<double>(s.positions, s.faces, Retriangulation::flips), why);
  };
  Surface s = grid(2, 2);
  s.faces[3][1] = 99;
  refused(s, "face 3: vertex 99 is out of range, there are 9");
  s = grid(2, 2);
  s.faces[3][1] = s.faces[3][2];
  refused(s, "face 3: vertex 4 occurs twice");
  s = grid(2, 2);
  s.positions[4][2] = std::numeric_limits<double>::quiet_NaN();
  refused(s, "vertex 4: a coordinate is not finite");
  s = grid(1, 1);
  for (auto& p : s.positions)
    for (double& x : p) x = x > 0.5 ? 1.7e308 : -1.7e308;
  refused(s, "face 0: too long for a number");
  s.faces.clear();
  refused(s, "the surface has no faces");
}

TEST_CASE("what solids are like is the same seen from their boundary and from all angles") {
  std::vector<Solid> all = {solid_cube(4), l_shape(3, 0),   walled(4),
                            edge_touch(3), vertex_touch(3), pipe(7, 2, 4)};
  for (unsigned seed = 1; seed <= 12; ++seed) {
    Solid holes = solid_cube(4, seed % 2 ? 0.15 : 0);
    std::mt19937 random(seed);
    std::erase_if(holes.tets, [&](const Tet&) { return uniform(random) < 0.08 * seed; });
    all.push_back(holes);
  }
  for (const Solid& s : all) {
    const SolidSummary a = s.mesh<double>().summary();
    const SolidSummary b = TetMesh<double>(s.positions.size(), s.tets, s.lengths()).summary();
    CHECK(a.reflex_edges == b.reflex_edges);
    CHECK(a.reflex_vertices == b.reflex_vertices);
    CHECK(a.pinched_edges == b.pinched_edges);
    CHECK(a.pinched_vertices == b.pinched_vertices);
    CHECK(a.components == b.components);
    std::set<std::pair<Index, Index>> edges;
    for (const Tet& t : s.tets)
      for (const auto& [i, j] : tet_edge_ends) edges.insert(std::minmax(t[i], t[j]));
    CHECK(a.edges == edges.size());
    CHECK(b.edges == edges.size());
  }
}

TEST_CASE("many tetrahedra at one vertex are glued like few") {
  // A ball of tetrahedra about one vertex: each has one face on a sphere of triangles.
  const Surface skin = sphere(3);
  Solid ball;
  ball.positions = skin.positions;
  ball.positions.insert(ball.positions.begin(), {0, 0, 0});
  for (const Face& f : skin.faces) ball.tets.push_back({0, f[0] + 1, f[1] + 1, f[2] + 1});
  const auto mesh = ball.mesh<double>();
  CHECK(mesh.summary().boundary_faces == skin.faces.size());
  CHECK(mesh.summary().components == 1);
  CHECK(mesh.summary().reflex_edges == 0);
  CHECK(mesh.summary().edges == skin.positions.size() + skin.faces.size() * 3 / 2);
  ball.tets.push_back(ball.tets[17]);
  const std::string last = std::to_string(ball.tets.size() - 1);
  CHECK_THROWS_WITH(ball.mesh<double>(), Catch::Contains("17") && Catch::Contains(last) &&
                                             Catch::Contains("at most two can"));
}

TEST_CASE("tetrahedra are glued at their vertices as by a map") {
  std::mt19937 random(5);
  std::vector<std::vector<Tet>> all;
  for (const double kept : {0.1, 0.5, 0.9, 1.0})
    for (const bool mixed : {false, true}) {
      Solid solid = solid_cube(5);
      std::erase_if(solid.tets, [&](const Tet&) { return uniform(random) > kept; });
      // Vertices in any order, and corners too, or all in positive order.
      std::vector<Index> name(solid.positions.size());
      for (Index v = 0; v < name.size(); ++v) name[v] = v;
      std::shuffle(name.begin(), name.end(), random);
      for (Tet& t : solid.tets) {
        for (Index& v : t) v = name[v];
        if (mixed) std::shuffle(t.begin(), t.end(), random);
      }
      all.push_back(solid.tets);
    }
  // A ball about vertex 0: at the last more faces than a table can tell of.
  for (const unsigned fineness : {0u, 2u, 6u}) {
    std::vector<Tet>& ball = all.emplace_back();
    for (const Face& f : sphere(fineness).faces) ball.push_back({0, f[0] + 1, f[1] + 1, f[2] + 1});
  }
  // Two and three on one face, on one side and on both.
  all.push_back({{0, 1, 2, 3}, {0, 1, 2, 4}});
  all.push_back({{0, 1, 2, 3}, {1, 0, 2, 4}});
  all.push_back({{0, 1, 2, 3}, {1, 0, 2, 4}, {0, 1, 2, 5}});
  all.push_back({{0, 1, 2, 3}, {1, 0, 2, 4}, {0, 1, 2, 5}, {1, 0, 2, 6}});
  std::size_t unfit = 0, refused = 0;
  for (const std::vector<Tet>& tets : all) {
    Index vertices = 0;
    for (const Tet& t : tets)
      for (const Index v : t) vertices = std::max(vertices, v + 1);
    const GluedByMap expected = glued_by_map(tets);
    const TetCorners rows = corners_of_vertices(vertices, tets, {}, 1);
    CAPTURE(tets.size(), vertices);
    for (const int threads : {1, 3}) {
      const auto glue = [&] { return glue_tets(tets, rows, threads); };
      if (expected.third) {
        CHECK_THROWS_WITH(glue(), Catch::Contains("at most two can"));
        continue;
      }
      const GluedTets glued = glue();
      REQUIRE(std::ranges::equal(glued.across, expected.across));
      CHECK(glued.fit == expected.fit);
    }
    unfit += !expected.third && !expected.fit;
    refused += expected.third;
  }
  CHECK(unfit >= 4);
  CHECK(refused == 2);
}

}  // namespace plexway::testing::building_test
