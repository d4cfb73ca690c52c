#include <plexway/pcl/filters.hpp>

#include <pcl/common/io.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <limits>
#include <map>

#include <plexway/error.hpp>
#include <plexway/pcl/cloud.hpp>

#include "pcl/pcl_testing.hpp"

namespace filters_test {

using namespace pcl_testing;
using Catch::Contains;
using plexway::pcl::finite_points;
using plexway::pcl::set_intensity;
using plexway::pcl::voxel_grid;
using plexway::pcl::without_outliers;

namespace {

const double inf = std::numeric_limits<double>::infinity();

double apart(const Row& a, const Row& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

}  // namespace

TEST_CASE("voxel grid: one point a cube, their mean") {
  // Two by two cubes of side 1, three points in the first of them.
  const Rows points = {{0.25, 0.25, 0}, {0.5, 0.25, 0}, {0.75, 0.25, 0}, {2.5, 0.25, 0},
                       {0.25, 2.5, 0},  {2.5, 2.5, 0},  {2.75, 2.75, 0}};
  for (const double offset : {0.0, 1e6, -3e7}) {
    Rows moved = points;
    for (Row& p : moved) p[0] += offset;
    const Rows kept = voxel_grid(moved, 2.0);
    REQUIRE(kept.size() == 4);
    const auto has = [&](const Row& wanted) {
      for (const Row& p : kept)
        if (apart(p, {wanted[0] + offset, wanted[1], wanted[2]}) < 1e-6) return true;
      return false;
    };
    CHECK(has({0.5, 0.25, 0}));
    CHECK(has({2.5, 0.25, 0}));
    CHECK(has({0.25, 2.5, 0}));
    CHECK(has({2.625, 2.625, 0}));
  }
}

TEST_CASE("voxel grid: as many points as there are cubes with any, by another count") {
  const Rows points = sphere(20000);
  const double size = 0.1;
  const Rows kept = voxel_grid(points, size);
  // Cubes start somewhere, so the count is compared over all starts.
  std::size_t least = points.size(), most = 0;
  for (int shift = 0; shift < 8; ++shift) {
    std::map<std::array<long, 3>, int> cubes;
    for (const Row& p : points) {
      std::array<long, 3> cube{};
      for (std::size_t k = 0; k < 3; ++k) cube[k] = std::lround(p[k] / size + shift / 8.0);
      ++cubes[cube];
    }
    least = std::min(least, cubes.size());
    most = std::max(most, cubes.size());
  }
  CHECK(10 * kept.size() > 9 * least);
  CHECK(10 * kept.size() < 11 * most);
  for (const Row& p : kept) CHECK(std::abs(std::hypot(p[0], p[1], p[2]) - 1) < size * size);
  CHECK(voxel_grid(points, 1e9).size() == 1);
  CHECK(voxel_grid(Rows{{1, 2, 3}}, 1e-300) == Rows{{1, 2, 3}});
  CHECK(voxel_grid({}, 1).empty());
}

TEST_CASE("voxel grid: sizes that cannot be say which could") {
  const Rows points = sphere(100);
  for (const double size : {0.0, -1.0, inf, std::nan("")})
    CHECK_THROWS_AS(voxel_grid(points, size), plexway::UsageError);
  CHECK_THROWS_WITH(voxel_grid(points, 1e-6), Contains("2^31 - 1; try 0.00"));
  CHECK_THROWS_AS(voxel_grid(Rows{{0, 0, 0}, {inf, 0, 0}}, 1), plexway::InputError);
}

TEST_CASE("outliers far from a sphere go, the sphere stays") {
  Rows points = sphere(5000);
  for (int i = 0; i < 25; ++i) points.push_back({2.0 + i, 0.5 * i, -1.0});
  const auto kept = without_outliers(points);
  CHECK(std::is_sorted(kept.begin(), kept.end()));
  CHECK(kept.back() < 5000);
  CHECK(kept.size() > 4900);
}

TEST_CASE("outliers: small clouds, equal points, bad options") {
  CHECK(without_outliers({}).empty());
  CHECK(without_outliers(Rows{{1, 1, 1}}).size() == 1);
  CHECK(without_outliers(Rows(50, {1, 1, 1})).size() == 50);
  CHECK(without_outliers(Rows{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {.neighbours = 100}).size() == 3);
  CHECK_THROWS_AS(without_outliers(sphere(10), {.neighbours = 0}), plexway::UsageError);
  CHECK_THROWS_AS(without_outliers(sphere(10), {.deviations = -1}), plexway::UsageError);
  CHECK_THROWS_AS(without_outliers(Rows{{0, 0, std::nan("")}}), plexway::InputError);
}

TEST_CASE("a cloud of PCL in, distances back as its intensity") {
  pcl::PointCloud<pcl::PointXYZRGB> scan(2, 2);
  scan[0].x = 1;
  scan[1].x = std::numeric_limits<float>::quiet_NaN();
  scan[2].y = 2;
  scan[3].z = 3;
  scan.is_dense = false;
  const auto points = finite_points(scan);
  CHECK(points.positions == Rows{{1, 0, 0}, {0, 2, 0}, {0, 0, 3}});
  CHECK(points.place == std::vector<plexway::Index>{0, 2, 3});

  pcl::PointCloud<pcl::PointXYZI> coloured;
  pcl::copyPointCloud(scan, coloured);
  set_intensity(coloured, points, std::vector<float>{0, 2.5, 4});
  CHECK(coloured[0].intensity == 0.0f);
  CHECK(std::isinf(coloured[1].intensity));
  CHECK(coloured[2].intensity == 2.5f);
  CHECK(coloured[3].intensity == 4.0f);
  CHECK(coloured[3].z == 3.0f);

  CHECK_THROWS_AS(set_intensity(coloured, points, std::vector<double>{0, 1}), plexway::UsageError);
  coloured.resize(3);
  CHECK_THROWS_AS(set_intensity(coloured, points, std::vector<double>{0, 1, 2}),
                  plexway::UsageError);
  CHECK_THROWS_AS(finite_points(pcl::PointCloud<pcl::PointXYZ>{}), plexway::InputError);
}

}  // namespace filters_test
