#include <algorithm>
#include <catch2/catch.hpp>
#include <limits>
#include <map>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/pairs/distance_matrix.hpp>
#include <plexway/sampling/centroidal_voronoi.hpp>
#include <plexway/sampling/farthest_points.hpp>
#include <plexway/sampling/poisson_disk.hpp>
#include <plexway/solid/tet_mesh.hpp>

#include "data/solid_shapes.hpp"
#include "labels/cracked_solid.hpp"
#include "sampling/sampling_testing.hpp"

namespace plexway::centroidal_voronoi_test {

using namespace sampling_testing;

namespace {

double spread(const std::vector<double>& contents) {
  double mean = 0, square = 0;
  for (const double c : contents) mean += c / static_cast<double>(contents.size());
  for (const double c : contents) square += (c - mean) * (c - mean);
  return std::sqrt(square / static_cast<double>(contents.size())) / mean;
}

// The unit cube, six tetrahedra a cell.
void cube(Index n, std::vector<Point>& points, std::vector<std::array<Index, 4>>& tets) {
  for (Index i = 0; i <= n; ++i)
    for (Index j = 0; j <= n; ++j)
      for (Index k = 0; k <= n; ++k)
        points.push_back(
            {static_cast<double>(i) / n, static_cast<double>(j) / n, static_cast<double>(k) / n});
  const auto at = [&](Index i, Index j, Index k) { return (i * (n + 1) + j) * (n + 1) + k; };
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j)
      for (Index k = 0; k < n; ++k) {
        const Index a = at(i, j, k), h = at(i + 1, j + 1, k + 1);
        const Index ring[6] = {at(i + 1, j, k),     at(i + 1, j + 1, k), at(i, j + 1, k),
                               at(i, j + 1, k + 1), at(i, j, k + 1),     at(i + 1, j, k + 1)};
        for (std::size_t r = 0; r < 6; ++r) tets.push_back({a, ring[r], ring[(r + 1) % 6], h});
      }
}

}  // namespace

TEST_CASE("the energy falls at every iteration and the areas on a sphere become even") {
  const samples::Shape sphere = samples::geodesic_sphere(60);
  const TriangleMesh<float> mesh(sphere.points, sphere.faces);
  const PoissonDisks start = poisson_disks(Serial{}, mesh, {.count = 200});
  const auto before = centroidal_voronoi(Serial{}, mesh, start.darts, {.max_iterations = 0});
  const auto after =
      centroidal_voronoi(Serial{}, mesh, start.darts, {.max_iterations = 20, .tolerance = 0});
  REQUIRE(after.steps.size() == 20);
  for (std::size_t n = 1; n < after.steps.size(); ++n)
    CHECK(after.steps[n].energy < after.steps[n - 1].energy);
  CHECK(after.energy < after.steps.back().energy);
  CHECK(after.steps.back().movement < 0.2 * after.steps.front().movement);
  CHECK(spread(after.cell_content) < spread(before.cell_content) / 2);

  // By great circles, independent of the solver.
  const auto energy = [&](const std::vector<PointSource>& seeds) {
    const auto at = positions(seeds, sphere.points, sphere.faces);
    double sum = 0;
    samples::Noise noise(3);
    for (int n = 0; n < 20000; ++n) {
      const Point p = samples::unit({noise(), noise(), noise()});
      const double d = nearest(p, at, great_circle);
      sum += d * d;
    }
    return sum;
  };
  CHECK(energy(after.seeds) < 0.96 * energy(start.darts));
}

TEST_CASE("one seed on a square goes to the middle") {
  const samples::Shape shape = square(30);
  const TriangleMesh<double> mesh(shape.points, shape.faces);
  const std::vector<PointSource> seed = {PointSource::at(0)};
  const auto cells = centroidal_voronoi(Serial{}, mesh, seed, {.tolerance = 1e-6});
  CHECK(cells.converged);
  const Point at = position(cells.seeds[0], shape.points, shape.faces);
  CHECK(at[0] == Approx(0.5).margin(1e-3));
  CHECK(at[1] == Approx(0.5).margin(1e-3));
  CHECK(cells.cell_content[0] == Approx(1));
  CHECK(cells.energy == Approx(1. / 6).epsilon(1e-3));  // of |p|^2 over the square
}

TEST_CASE("borders of cells run through triangles and tetrahedra") {
  samples::Noise noise(5);
  const auto any_of = [&](std::size_t count) {
    return static_cast<Index>((0.5 + 0.5 * noise()) * static_cast<double>(count - 1));
  };
  const auto share_of_samples = [&](const std::vector<Point>& seeds, int n, int layers) {
    std::vector<double> share(seeds.size(), 0);
    for (int x = 0; x < n; ++x)
      for (int y = 0; y < n; ++y)
        for (int z = 0; z < layers; ++z) {
          // Somewhere in its cube: seeds of a lattice have their borders on planes of another one.
          const auto in = [&](int k, int count) { return (k + 0.5 + 0.5 * noise()) / count; };
          const Point p = {in(x, n), in(y, n), layers == 1 ? 0 : in(z, layers)};
          std::size_t best = 0;
          for (std::size_t i = 1; i < seeds.size(); ++i)
            if (euclid(p, seeds[i]) < euclid(p, seeds[best])) best = i;
          share[best] += 1. / n / n / layers;
        }
    return share;
  };
  const auto check_cells = [&](const std::vector<double>& found, const std::vector<double>& truth,
                               double bound) {
    double sum = 0, worst = 0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
      sum += found[i];
      worst = std::max(worst, std::abs(found[i] - truth[i]));
    }
    CHECK(sum == Approx(1).epsilon(1e-5));
    CHECK(worst < bound);
  };
  {
    const samples::Shape shape = square(20);
    const TriangleMesh<double> mesh(shape.points, shape.faces);
    std::vector<PointSource> seeds;
    for (int i = 0; i < 12; ++i) seeds.push_back(PointSource::at(any_of(shape.points.size())));
    const auto cells = centroidal_voronoi(Serial{}, mesh, seeds, {.max_iterations = 0});
    // Cells are 0.08 large and triangles 0.00125; whole triangles are off by up to 4e-3 here.
    check_cells(cells.cell_content,
                share_of_samples(positions(cells.seeds, shape.points, shape.faces), 500, 1), 2e-4);
  }
  {
    std::vector<Point> points;
    std::vector<std::array<Index, 4>> tets;
    cube(8, points, tets);
    const TetMesh<double> mesh(points, tets);
    std::vector<PointSource> seeds;
    for (int i = 0; i < 6; ++i) seeds.push_back(PointSource::at(any_of(points.size())));
    const auto cells = centroidal_voronoi(Serial{}, mesh, seeds, {.max_iterations = 0});
    check_cells(cells.cell_content, share_of_samples(positions(cells.seeds, points, tets), 60, 60),
                2e-3);
  }
}

TEST_CASE("one seed in a cube goes to the middle") {
  std::vector<Point> points;
  std::vector<std::array<Index, 4>> tets;
  cube(6, points, tets);
  const TetMesh<float> mesh(points, tets);
  const std::vector<PointSource> seed = {PointSource::at(0)};
  const auto cells = centroidal_voronoi(Serial{}, mesh, seed, {.tolerance = 1e-5});
  const Point middle = position(cells.seeds[0], points, tets);
  for (const double x : middle) CHECK(x == Approx(0.5).margin(1e-3));
  CHECK(cells.energy == Approx(0.25).epsilon(1e-3));

  const PoissonDisks start = poisson_disks(Serial{}, mesh, {.count = 8});
  const auto eight = centroidal_voronoi(Serial{}, mesh, start.darts, {.max_iterations = 15});
  for (std::size_t s = 1; s < eight.steps.size(); ++s)
    CHECK(eight.steps[s].energy < eight.steps[s - 1].energy * (1 + 1e-9));
}

TEST_CASE("seeds by the published way go to the middle of a square and make areas even") {
  const samples::Shape shape = square(40);
  const TriangleMesh<float> mesh(shape.points, shape.faces);
  const std::vector<PointSource> corner = {PointSource::at(0)};
  const VoronoiOptions options = {
      .centre = CellCentre::farthest_from_border, .max_iterations = 20, .tolerance = 0};
  const auto one = centroidal_voronoi(Serial{}, mesh, corner, options);
  CHECK(euclid(position(one.seeds[0], shape.points, shape.faces), {0.5, 0.5, 0}) < 0.03);

  const samples::Shape sphere = samples::geodesic_sphere(60);
  const TriangleMesh<float> globe(sphere.points, sphere.faces);
  const PoissonDisks start = poisson_disks(Serial{}, globe, {.count = 200});
  const auto before = centroidal_voronoi(Serial{}, globe, start.darts, {.max_iterations = 0});
  const auto after = centroidal_voronoi(Serial{}, globe, start.darts, options);
  CHECK(spread(after.cell_content) < 0.8 * spread(before.cell_content));
}

TEST_CASE("the dual of cells on a sphere is a sphere of triangles") {
  const samples::Shape sphere = samples::geodesic_sphere(40);
  const TriangleMesh<float> mesh(sphere.points, sphere.faces);
  const PoissonDisks start = poisson_disks(Serial{}, mesh, {.count = 100});
  const auto cells = centroidal_voronoi(Serial{}, mesh, start.darts, {.max_iterations = 10});
  const auto field = solve(Serial{}, mesh, std::span<const PointSource>(cells.seeds));
  const DualTriangulation dual = dual_triangulation(sphere.faces, field.label, 100);
  CHECK(dual.manifold);
  CHECK(dual.triangles.size() == 2 * 100 - 4);  // Euler
  std::map<std::pair<Index, Index>, int> halfedges;
  for (const auto& t : dual.triangles)
    for (std::size_t i = 0; i < 3; ++i) ++halfedges[{t[i], t[(i + 1) % 3]}];
  for (const auto& [edge, count] : halfedges) {
    CHECK(count == 1);  // turned alike
    CHECK(halfedges.count({edge.second, edge.first}) == 1);
  }
}

TEST_CASE("where cells are too few the dual says so") {
  const samples::Shape sphere = samples::geodesic_sphere(10);
  const TriangleMesh<float> mesh(sphere.points, sphere.faces);
  const std::vector<PointSource> seeds = {PointSource::at(0), PointSource::at(7)};
  const auto field = solve(Serial{}, mesh, std::span<const PointSource>(seeds));
  const DualTriangulation dual = dual_triangulation(sphere.faces, field.label, 2);
  CHECK_FALSE(dual.manifold);
  CHECK(dual.irregular == std::vector<Index>{0, 1});
}

TEST_CASE("cells are refused where options make no sense") {
  const samples::Shape shape = square(4);
  const TriangleMesh<float> mesh(shape.points, shape.faces);
  CHECK_THROWS_AS(centroidal_voronoi(Serial{}, mesh, {}), UsageError);
  const std::vector<PointSource> outside = {PointSource::at(9999)};
  CHECK_THROWS_AS(centroidal_voronoi(Serial{}, mesh, outside), UsageError);
  const std::vector<PointSource> seed = {PointSource::at(0)};
  CHECK_THROWS_AS(centroidal_voronoi(Serial{}, mesh, seed, {.tolerance = -1}), UsageError);
  VoronoiOptions cancelled;
  cancelled.progress = [](const VoronoiStep&) { return false; };
  CHECK_THROWS_AS(centroidal_voronoi(Serial{}, mesh, seed, cancelled), Cancelled);
}

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
  REQUIRE(!solid.cracks().empty());
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

}  // namespace plexway::centroidal_voronoi_test
