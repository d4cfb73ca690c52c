#include <catch2/catch.hpp>

#include <plexway/error.hpp>

#include "complexes/test_meshes.hpp"

namespace plexway::testing::gluing_test {

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

}  // namespace plexway::testing::gluing_test
