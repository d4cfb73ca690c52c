#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/simplicial/simplicial_complex.hpp>
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
#include "message_of.hpp"

namespace plexway::testing::building_test {
using namespace detail;

// How meshes are built fast, beside the slow ways of saying the same.

namespace {

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

namespace {

using Lengths = std::vector<std::array<double, 3>>;
using Gluing = std::vector<std::array<Index, 3>>;
const double diagonal = std::sqrt(2.);

}  // namespace

TEMPLATE_TEST_CASE("a torus of two triangles and one vertex", "", float, double) {
  const std::vector<Face> faces = {{0, 0, 0}, {0, 0, 0}};
  const TriangleMesh<TestType> mesh(1, faces, Lengths{{1, 1, diagonal}, {diagonal, 1, 1}},
                                    Gluing{{4, 5, 3}, {2, 0, 1}});
  const SurfaceSummary& s = mesh.summary();
  CHECK(s.vertices == 1);
  CHECK(s.edges == 3);
  CHECK(s.boundary_edges == 0);
  CHECK(s.non_manifold_edges == 0);
  CHECK(s.pinched_vertices == 0);
  CHECK(s.components == 1);
  CHECK(s.orientable);
  std::vector<Index> corners;
  mesh.corners_at(0, corners);
  std::sort(corners.begin(), corners.end());
  CHECK(corners == std::vector<Index>{0, 1, 2, 3, 4, 5});
  for (const auto& t : mesh.triangles())
    for (std::size_t i = 0; i < 3; ++i) CHECK_FALSE(t.saddle(i));  // flat
}

TEST_CASE("a triangle glued to itself is a cone") {
  const std::vector<Face> faces = {{0, 1, 1}};
  const TriangleMesh<double> mesh(2, faces, Lengths{{2, 1, 2}}, Gluing{{2, none, 0}});
  CHECK(mesh.summary().edges == 2);
  CHECK(mesh.summary().boundary_edges == 1);
  CHECK(mesh.summary().components == 1);
  std::vector<Index> corners;
  mesh.corners_at(mesh.inside_vertex(0), corners);
  CHECK(corners == std::vector<Index>{0});
  mesh.corners_at(mesh.inside_vertex(1), corners);
  std::sort(corners.begin(), corners.end());
  CHECK(corners == std::vector<Index>{1, 2});
}

TEST_CASE("two vertices may share several edges") {
  // A cylinder of two triangles: side and diagonal both join 0 and 1.
  const std::vector<Face> faces = {{0, 0, 1}, {0, 1, 1}};
  const TriangleMesh<float> mesh(2, faces, Lengths{{1, 1, diagonal}, {diagonal, 1, 1}},
                                 Gluing{{none, 5, 3}, {2, none, 1}});
  CHECK(mesh.summary().edges == 4);
  CHECK(mesh.summary().boundary_edges == 2);
  CHECK(mesh.summary().components == 1);
}

TEST_CASE("an explicit gluing need not glue what shares vertices") {
  const std::vector<Face> faces = {{0, 1, 2}, {2, 1, 3}};
  const TriangleMesh<float> open(4, faces, Lengths{{1, 1, 1}, {1, 1, 1}},
                                 Gluing{{none, none, none}, {none, none, none}});
  CHECK(open.summary().boundary_edges == 6);
  CHECK(open.summary().pinched_vertices == 2);
  const TriangleMesh<float> closed(4, faces, Lengths{{1, 1, 1}, {1, 1, 1}});
  CHECK(closed.summary().boundary_edges == 4);
}

TEST_CASE("a cycle of three is a fan") {
  const std::vector<Face> faces = {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}};
  const TriangleMesh<float> mesh(5, faces, Lengths{{1, 1, 1}, {1, 1, 1}, {1, 1, 1}},
                                 Gluing{{3, none, none}, {6, none, none}, {0, none, none}});
  CHECK(mesh.summary().non_manifold_edges == 1);
  CHECK(mesh.summary().edges == 7);
}

TEST_CASE("gluings that are no cycles are refused") {
  const std::vector<Face> faces = {{0, 1, 2}, {2, 1, 3}};
  const Lengths lengths = {{1, 1, 1}, {1, 1, 1}};
  const auto glue = [&](const Gluing& across) {
    return TriangleMesh<float>(4, faces, lengths, across);
  };
  CHECK_NOTHROW(glue({{none, 3, none}, {1, none, none}}));
  using Catch::Matchers::Contains;
  CHECK_THROWS_WITH(glue({{none, 3, none}, {none, none, none}}),
                    Contains("face 0, edge 1") || Contains("face 1, edge 0"));
  CHECK_THROWS_WITH(glue({{none, 77, none}, {1, none, none}}), Contains("face 0, edge 1"));
  CHECK_THROWS_WITH(glue({{none, 1, none}, {none, none, none}}), Contains("face 0, edge 1"));
  CHECK_THROWS_WITH(glue({{none, 4, none}, {none, 1, none}}), Contains("face 0, edge 1"));
  CHECK_THROWS_AS(glue({{none, 3, 3}, {1, none, none}}), InputError);
  CHECK_THROWS_AS(glue({{none, 3, none}}), InputError);
}

using Catch::Matchers::Contains;

namespace {

const double infinity = std::numeric_limits<double>::infinity();
const double not_a_number = std::numeric_limits<double>::quiet_NaN();

}  // namespace

TEMPLATE_TEST_CASE("bad coordinates name their vertex", "", float, double) {
  for (const double bad : {infinity, -infinity, not_a_number})
    for (std::size_t d = 0; d < 3; ++d) {
      Surface s = grid(3, 3);
      s.positions[7][d] = bad;
      CHECK_THAT(message_of([&] { return s.mesh<TestType>(); }), Contains("vertex 7"));
    }
}

TEMPLATE_TEST_CASE("bad faces name themselves", "", float, double) {
  Surface s = grid(3, 3);
  s.faces[5][1] = 16;
  const std::string out_of_range = message_of([&] { return s.mesh<TestType>(); });
  CHECK_THAT(out_of_range, Contains("face 5") && Contains("vertex 16"));
  s.faces[5][1] = none;
  CHECK_THAT(message_of([&] { return s.mesh<TestType>(); }), Contains("face 5"));
  s.faces[5] = {3, 4, 3};
  CHECK_THAT(message_of([&] { return s.mesh<TestType>(); }),
             Contains("face 5") && Contains("vertex 3"));
  s.faces.clear();
  CHECK_THAT(message_of([&] { return s.mesh<TestType>(); }), Contains("no faces"));
}

TEST_CASE("nothing at all is refused") {
  CHECK_THROWS_AS(Surface().mesh<float>(), InputError);
  CHECK_THROWS_AS(TriangleMesh<float>(0, std::vector<Face>{}, Lengths{}), InputError);
}

TEMPLATE_TEST_CASE("bad lengths name their face", "", float, double) {
  const Surface s = grid(3, 3);
  for (const double bad : {infinity, not_a_number, -1.0, -1e-300}) {
    Lengths lengths = lengths_of(s);
    lengths[11][2] = bad;
    CHECK_THAT(
        message_of([&] { return TriangleMesh<TestType>(s.positions.size(), s.faces, lengths); }),
        Contains("face 11"));
  }
  Lengths lengths = lengths_of(s);
  lengths.pop_back();
  CHECK_THROWS_AS(TriangleMesh<TestType>(s.positions.size(), s.faces, lengths), InputError);
  Surface t = s;
  t.faces[2] = {0, 1, 99};
  CHECK_THAT(message_of([&] {
               return TriangleMesh<TestType>(s.positions.size(), t.faces, lengths_of(s));
             }),
             Contains("face 2") && Contains("vertex 99"));
}

TEST_CASE("an extent beyond the largest number is refused") {
  Surface s;
  s.add(-1.7e308, 0), s.add(1.7e308, 0), s.add(0, 1.7e308);
  s.triangle(0, 1, 2);
  CHECK_THAT(message_of([&] { return s.mesh<double>(); }), Contains("face 0"));
}

TEMPLATE_TEST_CASE("two lengths of one edge are refused by its name", "", float, double) {
  const std::vector<Face> faces = {{0, 1, 2}, {1, 3, 2}, {2, 3, 4}};
  for (const double second : {1.5, 1 + 1e-7}) {
    const Lengths lengths = {{1, 1, 1}, {1, 1, second}, {1, 1, 1}};
    const std::string error = message_of([&] { TriangleMesh<TestType>(5, faces, lengths); });
    if (second < 1.1) {
      CHECK(error.empty());
    } else {
      CHECK_THAT(error, Contains("edge 1 - 2") && Contains("1.5"));
      CHECK_THAT(
          message_of([&] {
            SimplicialComplex<TestType, 2>(5, faces, Lengths{{1, 1, 1}, {1, second, 1}, {1, 1, 1}});
          }),
          Contains("edge 1 - 2"));
    }
    const std::vector<std::array<Index, 4>> tets = {{0, 1, 2, 3}, {4, 3, 2, 1}};
    const std::vector<std::array<double, 6>> six = {{1, 1, 1, 1, 1, 1}, {1, 1, second, 1, 1, 1}};
    CHECK((message_of([&] { TetMesh<TestType>(5, tets, six); }).find("edge 2 - 3") !=
           std::string::npos) == (second > 1.1));
  }
  // Where paths are refracted an edge has two.
  SurfaceHints hints;
  hints.refracts = true;
  CHECK_NOTHROW(
      TriangleMesh<TestType>(5, faces, Lengths{{1, 1, 1}, {1, 1, 1.5}, {1, 1, 1}}, hints));
}

}  // namespace plexway::testing::building_test
