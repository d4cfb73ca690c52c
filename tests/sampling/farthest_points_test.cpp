#include <plexway/sampling/farthest_points.hpp>

#include <algorithm>
#include <catch2/catch.hpp>
#include <limits>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/pairs/distance_matrix.hpp>
#include <plexway/sampling/centroidal_voronoi.hpp>
#include <plexway/sampling/poisson_disk.hpp>
#include <plexway/solid/tet_mesh.hpp>

#include "data/solid_shapes.hpp"
#include "labels/cracked_solid.hpp"
#include "sampling/sampling_testing.hpp"

namespace plexway::farthest_points_test {

using namespace sampling_testing;

TEST_CASE("each further point of a square is the farthest from those before") {
  const samples::Shape shape = square(30);
  const TriangleMesh<double> mesh(shape.points, shape.faces);
  const std::vector<PointSource> start = {PointSource::at(0)};
  const FarthestPoints found = farthest_points(Serial{}, mesh, start, {.count = 40});
  REQUIRE(found.points.size() == 40);
  std::vector<Point> chosen = {shape.points[0]};
  for (std::size_t n = 1; n < 40; ++n) {
    // Flat and convex: as the crow flies.
    double farthest = 0;
    for (const Point& p : shape.points) farthest = std::max(farthest, nearest(p, chosen, euclid));
    const Point& at = shape.points[found.points[n].vertex];
    CHECK(found.distance[n] == Approx(farthest).epsilon(2e-3));
    CHECK(nearest(at, chosen, euclid) >= farthest * (1 - 2e-3));
    chosen.push_back(at);
  }
  CHECK(found.distance[1] == Approx(std::sqrt(2.)));
  double covering = 0;
  for (const Point& p : shape.points) covering = std::max(covering, nearest(p, chosen, euclid));
  CHECK(found.covering == Approx(covering).epsilon(2e-3));
  const auto coarse = farthest_points(Serial{}, mesh, start, {.count = 1000, .radius = 0.3});
  CHECK(coarse.covering <= 0.3);
  CHECK(coarse.points.size() < 40);
}

TEST_CASE("each further point of a bent solid is the farthest around the bend, exactly") {
  const samples::Shape elbow = samples::elbow_solid();
  const TetMesh<double> mesh(elbow.points, elbow.tets);
  const std::vector<PointSource> start = {PointSource::at(0)};
  const std::size_t count = std::min<std::size_t>(60, elbow.points.size());
  const FarthestPoints found = farthest_points(Serial{}, mesh, start, {.count = count});
  REQUIRE(found.points.size() == count);
  std::vector<Point> chosen = {elbow.points[0]};
  for (std::size_t n = 1; n < count; ++n) {
    double farthest = 0;
    for (const Point& p : elbow.points)
      farthest = std::max(farthest, nearest(p, chosen, inside_elbow));
    CHECK(found.distance[n] == Approx(farthest).epsilon(1e-9));
    const Point& at = elbow.points[found.points[n].vertex];
    CHECK(nearest(at, chosen, inside_elbow) == Approx(farthest).epsilon(1e-9));
    chosen.push_back(at);
  }
}

TEST_CASE("farthest points cost far less than a propagation each") {
  const samples::Shape sphere = samples::geodesic_sphere(40);
  const TriangleMesh<float> mesh(sphere.points, sphere.faces);
  const std::vector<PointSource> start = {PointSource::at(0)};
  const FarthestPoints found = farthest_points(Serial{}, mesh, start, {.count = 500});
  CHECK(found.points.size() == 500);
  CHECK(found.statistics.expansions < 14 * mesh.face_count());
}

TEST_CASE("parts apart get a point each before anything else") {
  const samples::Shape shape = samples::two_parts();
  const TriangleMesh<float> mesh(shape.points, shape.faces);
  const std::vector<PointSource> start = {PointSource::at(0)};
  const FarthestPoints found = farthest_points(Serial{}, mesh, start, {.count = 2});
  CHECK(found.distance[1] == std::numeric_limits<double>::infinity());
  CHECK(found.covering < std::numeric_limits<double>::infinity());
}

TEST_CASE("a matrix of a square has the distances of the plane") {
  const samples::Shape shape = square(30);
  const TriangleMesh<float> mesh(shape.points, shape.faces);
  std::vector<PointSource> points;
  for (Index i = 0; i < 20; ++i) points.push_back(PointSource::at(i * 47));
  for (Index i = 0; i < 10; ++i) points.push_back(PointSource::in(i * 150, {0.2, 0.3, 0.5}));
  const auto at = positions(points, shape.points, shape.faces);
  const DistanceMatrix matrix = distance_matrix(Serial{}, mesh, points);
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t j = 0; j < points.size(); ++j) {
      CHECK(matrix(i, j) == matrix(j, i));
      CHECK(matrix(i, j) == Approx(euclid(at[i], at[j])).epsilon(2e-3).margin(1e-6));
    }
  CHECK(matrix.asymmetry < 5e-3);
}

TEST_CASE("a matrix of a sphere has great circles and needs no whole propagations") {
  const samples::Shape sphere = samples::geodesic_sphere(40);
  const TriangleMesh<float> mesh(sphere.points, sphere.faces);
  std::vector<PointSource> points;
  for (Index v = 0; v < sphere.points.size() && points.size() < 20; ++v)
    if (sphere.points[v][2] > 0.9) points.push_back(PointSource::at(v));
  const DistanceMatrix matrix = distance_matrix(Serial{}, mesh, points);
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      CHECK(matrix(i, j) ==
            Approx(great_circle(sphere.points[points[i].vertex], sphere.points[points[j].vertex]))
                .epsilon(2e-3));
  CHECK(matrix.statistics.expansions < 7 * mesh.face_count());
}

TEST_CASE("a matrix of parts apart says inf and never nan") {
  const samples::Shape shape = samples::two_parts();
  const TriangleMesh<float> mesh(shape.points, shape.faces);
  const Index last = static_cast<Index>(shape.points.size() - 1);
  const std::vector<PointSource> points = {PointSource::at(0), PointSource::at(last)};
  const DistanceMatrix matrix = distance_matrix(Serial{}, mesh, points);
  CHECK(matrix(0, 1) == std::numeric_limits<double>::infinity());
  CHECK(matrix(0, 0) == 0);
  CHECK_THROWS_AS(distance_matrix(Serial{}, mesh, {}), UsageError);
}

TEST_CASE("points in a solid with a crack keep apart around it") {
  const testing::Cracked cracked(testing::one_slit, 0.16, 3, 0.3);
  const TetMesh<double> solid(cracked.places, cracked.tets);
  REQUIRE(solid.has_crack());
  std::vector<PointSource> start;
  for (Index v = 0; v < cracked.floor(); ++v)
    if (cracked.on_lip[v] != 0) start.push_back(PointSource::at(v));
  std::vector<std::vector<double>> exact;  // from each of these
  for (const PointSource& s : start) exact.push_back(cracked.exact(cracked.beside[s.vertex]));
  const auto check = [&](const DistanceMatrix& matrix) {
    CHECK(matrix.accuracy == Accuracy::accurate());
    std::size_t behind = 0;
    for (std::size_t i = 0; i < start.size(); ++i)
      for (std::size_t j = 0; j < start.size(); ++j) {
        CHECK(matrix(i, j) ==
              Approx(i == j ? 0 : exact[i][start[j].vertex]).epsilon(1e-6).margin(1e-8));
        behind += i != j && cracked.places[start[i].vertex] == cracked.places[start[j].vertex];
      }
    CHECK(behind > 4);
  };
  check(distance_matrix(Serial{}, solid, start));
  check(distance_matrix(Serial{}, solid, start, {}, Accuracy::fast()));

  const std::vector<PointSource> one = {start[0]};
  const FarthestPoints found = farthest_points(Serial{}, solid, one, {.count = 2});
  CHECK(found.distance[1] ==
        Approx(*std::max_element(exact[0].begin(), exact[0].end())).epsilon(1e-9));

  const auto cells = centroidal_voronoi(Serial{}, solid, start, {.max_iterations = 0});
  double content = 0;
  for (const double part : cells.cell_content) content += part;
  CHECK(content == Approx(.3).epsilon(1e-9));  // of the unit square, so high

  const PoissonDisks disks = poisson_disks(Serial{}, solid, {.radius = .3});
  const DistanceMatrix apart = distance_matrix(Serial{}, solid, disks.darts);
  for (std::size_t i = 0; i < apart.size; ++i)
    for (std::size_t j = 0; j < i; ++j) CHECK(apart(i, j) >= .3 * (1 - 1e-3));
}

}  // namespace plexway::farthest_points_test
