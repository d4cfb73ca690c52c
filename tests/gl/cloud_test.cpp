// Clouds on a GL device and on several threads: their sheets are surfaces, so what is tested is
// that they arrive there and come back, against great circles.

#include <catch2/catch.hpp>
#include <cmath>

#include <plexway/executors/gl.hpp>
#include <plexway/solve.hpp>

#include "complexes/test_clouds.hpp"
#include "gl/device.hpp"

namespace plexway::cloud_test {

TEST_CASE("points of a sphere, two of them twins, on several threads and on a GL device") {
  auto cloud = samples::sphere_cloud(2500);
  cloud.points.push_back(cloud.points[17]);
  const PointCloud<float> domain(cloud.points, test_clouds::near_pairs(cloud.points));
  const std::size_t twin = cloud.points.size() - 1;
  const auto check = [&](const DistanceField<float>& field) {
    REQUIRE(field.distance.size() == cloud.points.size());
    double mean = 0;
    for (std::size_t i = 1; i < twin; ++i)
      mean += std::abs(double(field.distance[i]) / cloud.distance(0, i) - 1) / double(twin);
    CHECK(mean < 1.5e-3);
    CHECK(field.distance[twin] == field.distance[17]);
    CHECK(field.distance[0] == 0);
  };
  check(solve(Serial{}, domain, PointSource::at(0)));
  if (openmp_built()) check(solve(OpenMP{2}, domain, PointSource::at(0)));
  if (testing::device()) check(solve(GL{}, domain, PointSource::at(0)));
  const auto from_twin = solve(Serial{}, domain, PointSource::at(static_cast<Index>(twin)));
  CHECK(from_twin.distance[17] == 0);
}

}  // namespace plexway::cloud_test
