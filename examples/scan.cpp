// From the file of a depth camera to distances along what it saw: a PCD is read, thinned where
// asked to, and written back with the distance from the point nearest to the camera as its
// intensity.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include <plexway/error.hpp>
#include <plexway/flann/neighbours.hpp>
#include <plexway/pcl/files.hpp>
#include <plexway/pcl/filters.hpp>
#include <plexway/solve.hpp>

int main(int argc, char** argv) try {
  if (argc < 3) return std::puts("usage: scan IN.pcd OUT.pcd [VOXEL]"), 2;
  const auto scan = plexway::pcl::read_points(argv[1]);
  const auto points =
      argc > 3 ? plexway::pcl::voxel_grid(scan.positions, std::atof(argv[3])) : scan.positions;
  const plexway::PointCloud<double> cloud(points, plexway::flann::surface_neighbours(points));

  const auto nearer = [](const auto& a, const auto& b) { return a[2] > b[2]; };  // z is up
  const auto nearest = std::min_element(points.begin(), points.end(), nearer) - points.begin();
  const auto field = solve(plexway::Serial{}, cloud,
                           plexway::PointSource::at(static_cast<plexway::Index>(nearest)));

  double farthest = 0;
  for (const double d : field.distance)
    if (std::isfinite(d)) farthest = std::max(farthest, d);
  std::printf("%zu points, %zu of them not finite and dropped; %zu in %zu components\n",
              scan.positions.size() + scan.dropped, scan.dropped, points.size(),
              cloud.summary().components);
  std::printf("The farthest is %.4f away from the top.\n", farthest);
  plexway::pcl::write_field(argv[2], points, field.distance);
  return 0;
} catch (const plexway::Error& error) {
  return std::fprintf(stderr, "scan: %s\n", error.what()), 1;
}
