#include <set>

#include <plexway/error.hpp>
#include <plexway/pairs/distance_matrix.hpp>
#include <plexway/paths/cloud_path_field.hpp>
#include <plexway/sampling/centroidal_voronoi.hpp>
#include <plexway/sampling/farthest_points.hpp>
#include <plexway/sampling/poisson_disk.hpp>

#include "complexes/test_clouds.hpp"
#include "paths/path_testing.hpp"

namespace plexway::testing::cloud_test {

namespace {

template <class Real>
PointCloud<Real> cloud_of(std::span<const Position> points) {
  return PointCloud<Real>(points, test_clouds::near_pairs(points));
}

template <class Real>
std::vector<std::array<Index, 3>> faces_of(const PointCloud<Real>& cloud,
                                           const PathField<PointCloud<Real>>& field) {
  std::vector<std::array<Index, 3>> faces(cloud.surface().face_count());
  for (Index f = 0; f < faces.size(); ++f) faces[f] = field.corners(f);
  return faces;
}

struct Off {
  double mean = 0, most = 0, least = 0;  // of length over exact distance, less 1
};

// Paths between points a few spacings apart at least, and what they promise.
template <class Real>
Off paths_on(const samples::Cloud& shape, int sources, int targets) {
  const auto cloud = cloud_of<Real>(shape.points);
  PathField field(cloud, shape.points);
  const auto faces = faces_of(cloud, field);
  std::mt19937 random(3);
  Off off;
  for (int k = 0; k < sources; ++k) {
    const Index source = below(random, shape.points.size());
    field.solve(Serial{}, PointSource::at(source));
    for (int i = 0; i < targets;) {
      const Index target = below(random, shape.points.size());
      const double exact = shape.distance(source, target);
      if (exact < 5 * shape.spacing()) continue;
      ++i;
      const Path path = field.trace(target);
      CAPTURE(source, target);
      check_path(path, shape.points, faces, exact);
      CHECK(apart(path.positions.front(), shape.points[target]) <= 1e-12 * exact);
      CHECK(apart(path.positions.back(), shape.points[source]) <= 1e-12 * exact);
      const double share = path.length / exact - 1;
      off.mean += share / (sources * targets);
      off.most = std::max(off.most, share);
      off.least = std::min(off.least, share);
    }
  }
  return off;
}

constexpr auto euclid = apart;

}  // namespace

TEMPLATE_TEST_CASE("paths on a flat cloud are straight", "", float, double) {
  const Off off = paths_on<TestType>(samples::plane_cloud(1500), 4, 25);
  CAPTURE(off.mean, off.most, off.least);
  CHECK(off.least >= -1e-12);
  CHECK(off.mean <= 1e-9);
  CHECK(off.most <= 1e-9);
}

TEST_CASE("paths on clouds of a sphere and a swiss roll are as long as the geodesics") {
  for (const samples::Cloud& shape : {samples::sphere_cloud(2000), samples::swiss_cloud(3000)}) {
    const Off off = paths_on<double>(shape, 4, 25);
    CAPTURE(shape.name, off.mean, off.most, off.least);
    CHECK(std::abs(off.mean) <= 3e-3);  // chords cut corners
    CHECK(off.most <= 2e-2);            // along the rim of the roll
    CHECK(off.least >= -1.5e-2);
  }
}

TEST_CASE("paths on a noisy cloud have the cloud's own lengths") {
  const samples::Cloud shape = samples::sphere_cloud(2000, 1, 0.004);
  const auto cloud = cloud_of<float>(shape.points);
  REQUIRE(cloud.summary().noise > 0);
  PathField field(cloud, shape.points);
  field.solve(Serial{}, PointSource::at(0));
  double mean = 0;
  int count = 0;
  for (Index target = 10; target < shape.points.size(); target += 40) {
    const double exact = shape.distance(0, target);
    if (exact < 0.3) continue;
    const Path path = field.trace(target);
    REQUIRE(path.positions.size() == path.points.size());
    CHECK(path.positions.front() == shape.points[target]);
    mean += path.length / exact - 1, ++count;
  }
  CHECK(std::abs(mean / count) <= 4e-3);
}

TEST_CASE("paths over points at one place and points in a row") {
  // A row holds no sheet: points hang together by single edges.
  std::vector<Position> row;
  for (int i = 0; i < 12; ++i) row.push_back({0.1 * i, 0, 0});
  row.push_back(row[3]);
  const auto cloud = cloud_of<double>(row);
  PathField field(cloud, row);
  CHECK_THROWS_AS(field.trace(1), UsageError);
  field.solve(Serial{}, PointSource::at(12));  // a twin of point 3
  const auto faces = faces_of(cloud, field);
  std::vector<Position> places = row;
  places.insert(places.end(), cloud.more_places().begin(), cloud.more_places().end());
  for (const Index target : {0u, 7u, 11u}) {
    const Path path = field.trace(target);
    CAPTURE(target);
    check_path(path, places, faces);
    CHECK(path.length == Approx(apart(row[3], row[target])).epsilon(1e-9));
  }
  CHECK(field.trace(3).length == Approx(0).margin(1e-12));
  CHECK(field.trace(12).length == Approx(0).margin(1e-12));
  CHECK_THROWS_AS(field.trace(13), UsageError);
  CHECK_THROWS_AS(field.trace(PointSource::in(0, {.3, .3, .4})), UsageError);
  CHECK_THROWS_AS((PathField(cloud, std::span(row).first(4))), UsageError);
  CHECK(field.bytes() > 0);
}

TEST_CASE("darts on clouds are points and keep their distance") {
  for (const samples::Cloud& shape : {samples::sphere_cloud(4000), samples::swiss_cloud(4000)}) {
    std::vector<Position> points = shape.points;
    points.push_back(points[7]);  // a twin
    const auto cloud = cloud_of<float>(points);
    const double radius = 6 * shape.spacing();
    const PoissonDisks disks = poisson_disks(Serial{}, cloud, {.radius = radius, .seed = 3});
    CHECK(disks.maximal);
    REQUIRE(disks.darts.size() > 20);
    // Where scattered points leave a gap at the roll's rim, the sheet has a dent: a way along the
    // rim goes round it.
    const double rim = 2 * shape.spacing();
    const auto at_rim = [&](Index p) {
      const double along = shape.points[p][1];
      return shape.name != "sphere" && (along < rim || along > 20 - rim);
    };
    double least = 1e9, farthest = 0;
    for (std::size_t i = 0; i < disks.darts.size(); ++i) {
      const Index a = disks.darts[i].vertex;
      REQUIRE(a < shape.points.size());
      for (std::size_t j = 0; j < i; ++j) {
        const Index b = disks.darts[j].vertex;
        if (!at_rim(a) && !at_rim(b)) least = std::min(least, shape.distance(a, b));
      }
    }
    for (std::size_t p = 0; p < shape.points.size(); ++p) {
      double nearest = 1e9;
      for (const PointSource& dart : disks.darts)
        nearest = std::min(nearest, shape.distance(p, dart.vertex));
      farthest = std::max(farthest, nearest);
    }
    CAPTURE(shape.name, least / radius, farthest / radius, disks.darts.size());
    CHECK(least >= radius * (1 - 1e-2));  // the sheet is off the surface by so much
    CHECK(farthest <= radius * (1 + 1e-2));
  }
}

TEST_CASE("sampling on clouds refuses what has no sense there") {
  const samples::Cloud shape = samples::plane_cloud(300);
  const auto cloud = cloud_of<float>(shape.points);
  const PointSource inside = PointSource::in(0, {.3, .3, .4}), far = PointSource::at(300);
  CHECK_THROWS_WITH(poisson_disks(Serial{}, cloud, {.radius = 0.1, .order = DartOrder::simplices}),
                    Catch::Contains("uniform"));
  CHECK_THROWS_AS(poisson_disks(Serial{}, cloud, {.count = 301}), UsageError);
  for (const PointSource& p : {inside, far}) {
    CHECK_THROWS_AS(farthest_points(Serial{}, cloud, std::span(&p, 1), {.count = 3}), UsageError);
    CHECK_THROWS_AS(distance_matrix(Serial{}, cloud, std::span(&p, 1)), UsageError);
    CHECK_THROWS_AS(centroidal_voronoi(Serial{}, cloud, std::span(&p, 1)), UsageError);
  }
  CHECK(poisson_disks(Serial{}, cloud, {.count = 25}).darts.size() == 25);
  std::vector<double> spacing(300, 1);
  CHECK_FALSE(poisson_disks(Serial{}, cloud, {.radius = 0.1, .spacing = spacing}).darts.empty());
}

TEST_CASE("farthest points and pairs on a cloud of a sphere") {
  samples::Cloud shape = samples::sphere_cloud(3000);
  const auto cloud = cloud_of<double>(shape.points);
  const PointSource start = PointSource::at(0);
  const FarthestPoints found =
      farthest_points(Serial{}, cloud, std::span(&start, 1), {.count = 12});
  REQUIRE(found.points.size() == 12);
  CHECK(found.distance[1] == Approx(std::numbers::pi).epsilon(1e-2));
  for (const PointSource& p : found.points) CHECK(p.vertex < shape.points.size());
  for (std::size_t i = 2; i < 12; ++i) CHECK(found.distance[i] <= found.distance[i - 1]);
  double farthest = 0;
  for (std::size_t p = 0; p < shape.points.size(); ++p) {
    double nearest = 1e9;
    for (const PointSource& q : found.points)
      nearest = std::min(nearest, shape.distance(p, q.vertex));
    farthest = std::max(farthest, nearest);
  }
  CHECK(found.covering == Approx(farthest).epsilon(1e-2));

  const DistanceMatrix matrix = distance_matrix(Serial{}, cloud, found.points);
  for (std::size_t i = 0; i < 12; ++i)
    for (std::size_t j = 0; j < i; ++j)
      CHECK(matrix(i, j) ==
            Approx(shape.distance(found.points[i].vertex, found.points[j].vertex)).epsilon(1e-2));
}

TEST_CASE("seeds on a flat cloud end at points in the middle of their cells") {
  const samples::Cloud shape = samples::plane_cloud(3000);
  const auto cloud = cloud_of<double>(shape.points);
  const PoissonDisks start = poisson_disks(Serial{}, cloud, {.count = 30});
  const CentroidalVoronoi cells = centroidal_voronoi(Serial{}, cloud, start.darts);
  std::set<Index> chosen;
  for (const PointSource& seed : cells.seeds) chosen.insert(seed.vertex);
  REQUIRE(chosen.size() == 30);
  CHECK(*chosen.rbegin() < shape.points.size());
  REQUIRE(cells.label.size() == shape.points.size());
  for (std::size_t n = 1; n < cells.steps.size(); ++n)
    CHECK(cells.steps[n].energy <= cells.steps[n - 1].energy * (1 + 1e-12));
  CHECK(cells.energy <= cells.steps[0].energy);
  // The points of a cell lie about its seed.
  std::vector<Position> sum(30, {0, 0, 0});
  std::vector<double> count(30, 0);
  double wrong = 0;
  for (std::size_t p = 0; p < shape.points.size(); ++p) {
    REQUIRE(cells.label[p] < 30);
    double nearest = 1e9;
    for (const PointSource& seed : cells.seeds)
      nearest = std::min(nearest, euclid(shape.points[p], shape.points[seed.vertex]));
    wrong += euclid(shape.points[p], shape.points[cells.seeds[cells.label[p]].vertex]) >
             nearest * (1 + 1e-3) + 1e-9;
    for (std::size_t k = 0; k < 2; ++k) sum[cells.label[p]][k] += shape.points[p][k];
    count[cells.label[p]] += 1;
  }
  CHECK(wrong / 3000 <= 1e-3);
  const double cell = std::sqrt(1. / 30);
  double off = 0;
  for (std::size_t i = 0; i < 30; ++i) {
    const Position middle = {sum[i][0] / count[i], sum[i][1] / count[i], 0};
    off += euclid(middle, shape.points[cells.seeds[i].vertex]) / 30;
  }
  CHECK(off <= 0.12 * cell);
}

TEST_CASE("as many darts as a cloud has points, or a reason why not") {
  // Two points in 40 are so near to each other that they are one place.
  std::mt19937 random(5);
  std::vector<Position> points;
  for (int i = 0; i < 39; ++i)
    points.push_back({uniform(random), uniform(random), 0.01 * uniform(random)});
  points.push_back(points[20]);
  points[39][0] += 1e-9;
  const auto cloud = cloud_of<double>(points);
  for (const std::size_t count : {std::size_t{20}, std::size_t{39}, std::size_t{40}}) {
    try {
      const PoissonDisks disks = poisson_disks(Serial{}, cloud, {.count = count});
      CHECK(disks.darts.size() == count);
      CHECK(count < 40);
    } catch (const UsageError& error) {
      CHECK(count > 20);
      CAPTURE(count, error.what());
      const char* reason = count == 40 ? "only 39 points at different places" : "found no radius";
      CHECK(std::string(error.what()).find(reason) != std::string::npos);
    }
  }
}

}  // namespace plexway::testing::cloud_test
