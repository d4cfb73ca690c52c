#ifdef PLEXWAY_HAS_FLANN
#include <pcl/common/io.h>
#include <pcl/io/pcd_io.h>
#include <pcl/point_types.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include <plexway/flann/neighbours.hpp>
#include <plexway/pcl/cloud.hpp>
#include <plexway/solve.hpp>

#include "pcl/pcl_testing.hpp"

TEST_CASE("a program with a cloud of PCL: distances on a scanned ball are angles") {
  pcl::PointCloud<pcl::PointXYZ> scan;
  const std::string file = std::string(PLEXWAY_SOURCE_DIR) + "/data/scan.pcd";
  REQUIRE(pcl::io::loadPCDFile(file, scan) == 0);
  CHECK_FALSE(scan.is_dense);
  CHECK(scan.height == 48);

  const auto points = plexway::pcl::finite_points(scan);
  const plexway::PointCloud<float> cloud(points.positions,
                                         plexway::flann::neighbours(points.positions));
  const plexway::Index source = 700;
  const auto field = solve(plexway::Serial{}, cloud, plexway::PointSource::at(source));
  pcl::PointCloud<pcl::PointXYZI> coloured;
  pcl::copyPointCloud(scan, coloured);
  plexway::pcl::set_intensity(coloured, points, field.distance);

  const auto& centre = scan[points.place[source]];
  double mean = 0, most = 0, count = 0;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const auto& p = scan[i];
    if (!std::isfinite(p.x)) {
      CHECK(std::isinf(coloured[i].intensity));
      continue;
    }
    const double cosine = static_cast<double>(p.x * centre.x + p.y * centre.y + p.z * centre.z);
    const double angle = std::acos(std::clamp(cosine, -1.0, 1.0));
    if (angle < 0.12) continue;
    const double error = std::abs(static_cast<double>(coloured[i].intensity) - angle) / angle;
    mean += error;
    most = std::max(most, error);
    ++count;
  }
  CHECK(count > 1500);
  CHECK(mean / count < 2e-3);
  CHECK(most < 2e-2);
}
#endif

namespace scan_test {}  // namespace scan_test
